// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "files/PngChunks.h"

#include "sensornoise/FrameFile.h"
#include "files/Zlib.h"

#include <algorithm>
#include <array>
#include <cstdlib>

namespace sensornoise
{
namespace
{
bool
IsLetter(unsigned char c)
{
  return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z');
}
} // namespace

std::uint32_t
PngNumber(const unsigned char * bytes)
{
  return (std::uint32_t{ bytes[0] } << 24) | (std::uint32_t{ bytes[1] } << 16) | (std::uint32_t{ bytes[2] } << 8) |
         bytes[3];
}

PngChunks::PngChunks(const std::string & file, FileBytes & bytes)
  : m_File(file)
  , m_Bytes(bytes)
  , m_Buffer(65536)
{}

PngChunk
PngChunks::Next()
{
  const std::string            size = std::to_string(m_Bytes.Size()) + " bytes";
  std::array<unsigned char, 8> head{};
  if (!m_Bytes.Holds(m_Offset, head.size()))
  {
    throw FileError(m_File, "truncated: " + size + " without the IEND chunk that ends a PNG file");
  }
  m_Bytes.Read(m_Offset, head.data(), head.size());
  PngChunk chunk{ std::string(head.begin() + 4, head.end()), m_Offset + 8, PngNumber(head.data()) };
  if (!std::all_of(head.begin() + 4, head.end(), IsLetter))
  {
    throw FileError(m_File,
                    "damaged: no chunk of PNG at byte " + std::to_string(m_Offset) +
                      "; expected a name of four letters there");
  }
  if (!m_Bytes.Holds(chunk.data, chunk.length + 4))
  {
    throw FileError(m_File,
                    "truncated: its chunk " + chunk.type + " of " + std::to_string(chunk.length) + " bytes from byte " +
                      std::to_string(chunk.data) + " on does not end in the file of " + size);
  }
  m_Offset = chunk.data + chunk.length + 4;
  return chunk;
}

void
PngChunks::Read(const PngChunk & chunk, const Sink & sink)
{
  uLong sum = crc32(0, reinterpret_cast<const unsigned char *>(chunk.type.data()), 4);
  for (std::uint64_t done = 0; done < chunk.length;)
  {
    const std::size_t count = static_cast<std::size_t>(std::min<std::uint64_t>(chunk.length - done, m_Buffer.size()));
    m_Bytes.Read(chunk.data + done, m_Buffer.data(), count);
    sum = crc32(sum, m_Buffer.data(), static_cast<uInt>(count));
    if (sink)
    {
      sink(m_Buffer.data(), count);
    }
    done += count;
  }
  std::array<unsigned char, 4> stored{};
  m_Bytes.Read(chunk.data + chunk.length, stored.data(), stored.size());
  if (PngNumber(stored.data()) != sum)
  {
    throw FileError(m_File,
                    "damaged: the checksum of its chunk " + chunk.type + " at byte " + std::to_string(chunk.data - 8) +
                      " is wrong");
  }
}

namespace
{
unsigned char
PaethPredictor(int left, int above, int aboveLeft)
{
  const int estimate = left + above - aboveLeft;
  const int toLeft = std::abs(estimate - left);
  const int toAbove = std::abs(estimate - above);
  const int toAboveLeft = std::abs(estimate - aboveLeft);
  return static_cast<unsigned char>(toLeft <= toAbove && toLeft <= toAboveLeft ? left
                                    : toAbove <= toAboveLeft                   ? above
                                                                               : aboveLeft);
}

void
Unfilter(unsigned char                      filter,
         std::size_t                        bytesPerPixel,
         std::size_t                        count,
         std::vector<unsigned char> &       row,
         const std::vector<unsigned char> & previous)
{
  for (std::size_t i = 0; i < count; ++i)
  {
    const int left = i >= bytesPerPixel ? row[i - bytesPerPixel] : 0;
    const int above = previous[i];
    const int aboveLeft = i >= bytesPerPixel ? previous[i - bytesPerPixel] : 0;
    const int prediction = filter == 1   ? left
                           : filter == 2 ? above
                           : filter == 3 ? (left + above) / 2
                           : filter == 4 ? PaethPredictor(left, above, aboveLeft)
                                         : 0;
    row[i] = static_cast<unsigned char>(row[i] + prediction);
  }
}
} // namespace

PngRows::PngRows(std::size_t     width,
                 std::size_t     height,
                 std::size_t     bytesPerPixel,
                 bool            interlaced,
                 unsigned char * pixels)
  : m_Width(width)
  , m_BytesPerPixel(bytesPerPixel)
  , m_Pixels(pixels)
{
  static constexpr Pass whole{ 0, 0, 1, 1, 0, 0 };
  static constexpr Pass adam7[]{ { 0, 0, 8, 8, 0, 0 }, { 4, 0, 8, 8, 0, 0 }, { 0, 4, 4, 8, 0, 0 }, { 2, 0, 4, 4, 0, 0 },
                                 { 0, 2, 2, 4, 0, 0 }, { 1, 0, 2, 2, 0, 0 }, { 0, 1, 1, 2, 0, 0 } };
  const std::size_t     passes = interlaced ? 7 : 1;
  for (std::size_t i = 0; i < passes; ++i)
  {
    Pass pass = interlaced ? adam7[i] : whole;
    pass.columns = (width + pass.stepX - 1 - std::min(pass.x, width + pass.stepX - 1)) / pass.stepX;
    pass.rows = (height + pass.stepY - 1 - std::min(pass.y, height + pass.stepY - 1)) / pass.stepY;
    if (pass.columns > 0 && pass.rows > 0)
    {
      m_Passes.push_back(pass);
      m_Bytes += std::uint64_t{ pass.rows } * (pass.columns * bytesPerPixel + 1);
    }
  }
  if (pixels != nullptr)
  {
    m_Current.resize(width * bytesPerPixel);
    m_Previous.resize(width * bytesPerPixel);
  }
}

void
PngRows::Add(const unsigned char * bytes, std::size_t count)
{
  while (count > 0 && m_Pass < m_Passes.size() && m_Error.empty())
  {
    if (m_Filled == 0)
    {
      m_Filter = *bytes;
      if (m_Filter > 4)
      {
        m_Error = "a row with the filter " + std::to_string(m_Filter) + "; expected 0 to 4";
      }
      ++bytes;
      --count;
      ++m_Filled;
      continue;
    }
    const std::size_t rowBytes = m_Passes[m_Pass].columns * m_BytesPerPixel;
    const std::size_t have = m_Filled - 1;
    const std::size_t used = std::min(count, rowBytes - have);
    if (m_Pixels != nullptr)
    {
      std::copy(bytes, bytes + used, m_Current.begin() + static_cast<std::ptrdiff_t>(have));
    }
    bytes += used;
    count -= used;
    m_Filled += used;
    if (m_Filled == rowBytes + 1)
    {
      EndRow();
    }
  }
}

void
PngRows::EndRow()
{
  const Pass & pass = m_Passes[m_Pass];
  if (m_Pixels != nullptr)
  {
    Unfilter(m_Filter, m_BytesPerPixel, pass.columns * m_BytesPerPixel, m_Current, m_Previous);
    PlaceRow(pass);
    m_Current.swap(m_Previous);
  }
  m_Filled = 0;
  if (++m_Row == pass.rows)
  {
    m_Row = 0;
    ++m_Pass;
    std::fill(m_Previous.begin(), m_Previous.end(), static_cast<unsigned char>(0));
  }
}

void
PngRows::PlaceRow(const Pass & pass)
{
  unsigned char * to = m_Pixels + ((pass.y + m_Row * pass.stepY) * m_Width + pass.x) * m_BytesPerPixel;
  if (pass.stepX == 1)
  {
    std::copy_n(m_Current.begin(), pass.columns * m_BytesPerPixel, to);
    return;
  }
  for (std::size_t i = 0; i < pass.columns; ++i, to += pass.stepX * m_BytesPerPixel)
  {
    std::copy_n(m_Current.begin() + static_cast<std::ptrdiff_t>(i * m_BytesPerPixel), m_BytesPerPixel, to);
  }
}

} // namespace sensornoise
