// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "page/PngData.h"

#include "files/ByteOrder.h"
#include "files/Zlib.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

namespace sensornoise
{
namespace
{
std::string
BigEndian(std::size_t number)
{
  return BytesOfNumber(number, 4, true);
}

const Bytef *
BytesOf(const std::string & text)
{
  return reinterpret_cast<const Bytef *>(text.data());
}

std::string
PngChunk(const std::string & name, const std::string & content)
{
  const std::string checked = name + content;
  return BigEndian(content.size()) + checked +
         BigEndian(crc32(crc32(0, nullptr, 0), BytesOf(checked), static_cast<uInt>(checked.size())));
}

std::string
Deflated(const std::string & text)
{
  uLongf      size = compressBound(static_cast<uLong>(text.size()));
  std::string packed(size, '\0');
  if (compress2(reinterpret_cast<Bytef *>(packed.data()),
                &size,
                BytesOf(text),
                static_cast<uLong>(text.size()),
                Z_DEFAULT_COMPRESSION) != Z_OK)
  {
    throw std::runtime_error("zlib cannot compress a picture of " + std::to_string(text.size()) + " bytes");
  }
  packed.resize(size);
  return packed;
}

std::string
Base64(const std::string & bytes)
{
  static const char * const digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string               text;
  for (std::size_t i = 0; i < bytes.size(); i += 3)
  {
    std::uint32_t three = 0;
    for (std::size_t k = 0; k < 3; ++k)
    {
      three = three << 8U | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0U);
    }
    for (std::size_t k = 0; k < 4; ++k)
    {
      text += i + k > bytes.size() ? '=' : digits[three >> (18 - 6 * k) & 63U];
    }
  }
  return text;
}
} // namespace

std::string
PngAsDataAddress(std::size_t                                      width,
                 std::size_t                                      height,
                 const std::vector<std::uint8_t> &                pixels,
                 const std::vector<std::array<std::uint8_t, 3>> & palette)
{
  if (width == 0 || height == 0 || pixels.size() != width * height || palette.empty() || palette.size() > 256)
  {
    throw std::invalid_argument("a picture of " + std::to_string(width) + " x " + std::to_string(height) + " has " +
                                std::to_string(pixels.size()) + " pixels and " + std::to_string(palette.size()) +
                                " colours; expected width x height pixels, and 1 to 256 colours");
  }
  const std::string kind = { 8, 3, 0, 0, 0 }; // bits, palette, deflate, rows as they are filtered, not interlaced
  std::string       colours;
  for (const auto & colour : palette)
  {
    colours.append(colour.begin(), colour.end());
  }
  std::string rows;
  for (std::size_t y = 0; y < height; ++y)
  {
    rows += '\0'; // not filtered
    rows.append(reinterpret_cast<const char *>(&pixels[y * width]), width);
  }
  const std::string png = "\x89PNG\r\n\x1a\n" + PngChunk("IHDR", BigEndian(width) + BigEndian(height) + kind) +
                          PngChunk("PLTE", colours) + PngChunk("IDAT", Deflated(rows)) + PngChunk("IEND", "");
  return "data:image/png;base64," + Base64(png);
}

} // namespace sensornoise
