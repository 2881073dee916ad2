// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_test_DngTestHelper_h
#define sensornoise_test_DngTestHelper_h

#include "helpers/BurstFilesTestHelper.h"
#include "helpers/TiffTestHelper.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

/** \file
 * Raw files of cameras, made byte by byte without the library that reads them. */

namespace sensornoise::test
{

/** Returns a DNG file without pixels: DNGVersion 1.4, BlackLevel and WhiteLevel. */
inline std::string
DngOfLevels(unsigned black, unsigned white)
{
  std::string file("II*\0\x08\0\0\0\x03\0", 10);
  for (const auto & [tag, type, count, value] :
       std::vector<std::array<unsigned, 4>>{ { 50706, 1, 4, 0x401 }, { 50714, 4, 1, black }, { 50717, 4, 1, white } })
  {
    AppendNumber(file, tag, 2, false);
    AppendNumber(file, type, 2, false);
    AppendNumber(file, count, 4, false);
    AppendNumber(file, value, 4, false);
  }
  return file + std::string(4, '\0');
}

/** A stream of bits, the highest of each byte first. */
class JpegBits
{
public:
  void
  Add(unsigned value, unsigned bits)
  {
    while (bits-- > 0)
    {
      m_Byte = m_Byte << 1 | ((value >> bits) & 1U);
      if (++m_Count == 8)
      {
        // a byte of ones is followed by one of zeros, so that it is no marker
        m_Bytes += m_Byte == 255 ? std::string("\xFF\0", 2) : std::string(1, static_cast<char>(m_Byte));
        m_Byte = 0;
        m_Count = 0;
      }
    }
  }

  std::string
  Bytes()
  {
    while (m_Count != 0)
    {
      Add(1, 1);
    }
    return m_Bytes;
  }

private:
  std::string m_Bytes{};
  unsigned    m_Byte{ 0 };
  unsigned    m_Count{ 0 };
};

/** Returns JPEG without loss (ITU-T T.81, Annex H): each grey value by its left neighbour of the same component, with
 * one Huffman table in which the 17 lengths of a difference have codes of 5 bits. \a frame: the marker of its frame. */
inline std::string
LosslessJpeg(const GreyValues & greyValues,
             unsigned           width,
             unsigned           height,
             unsigned           bits,
             unsigned           components,
             int                frame = 0xC3)
{
  const auto segment = [](int marker, const std::string & content) {
    std::string text = { '\xFF', static_cast<char>(marker) };
    AppendNumber(text, content.size() + 2, 2, true);
    return text + content;
  };
  std::string size(1, static_cast<char>(bits));
  AppendNumber(size, height, 2, true);
  AppendNumber(size, width / components, 2, true);
  size += static_cast<char>(components);
  std::string scan(1, static_cast<char>(components));
  for (unsigned c = 0; c < components; ++c)
  {
    size += std::string{ static_cast<char>(c), '\x11', '\0' };
    scan += std::string{ static_cast<char>(c), '\0' };
  }
  std::string table(17, '\0');
  table[5] = 17;
  for (int length = 0; length <= 16; ++length)
  {
    table += static_cast<char>(length);
  }
  JpegBits pixels;
  for (std::size_t i = 0; i < greyValues.size(); ++i)
  {
    const std::size_t column = i % width;
    const unsigned    first = i < width ? 1U << (bits - 1) : greyValues[i - width];
    const auto        guess = static_cast<int>(column < components ? first : greyValues[i - components]);
    const auto        difference = static_cast<std::int16_t>(static_cast<int>(greyValues[i]) - guess);
    unsigned          length = 0;
    while ((difference < 0 ? -static_cast<int>(difference) : difference) >> length != 0)
    {
      ++length;
    }
    pixels.Add(length, 5);
    pixels.Add(static_cast<unsigned>(difference < 0 ? difference - 1 : difference), length == 16 ? 0 : length);
  }
  return "\xFF\xD8" + segment(0xC4, table) + segment(frame, size) + segment(0xDA, scan + std::string("\1\0\0", 3)) +
         pixels.Bytes() + "\xFF\xD9";
}

/** A DNG file. A test may change each of its members. Its directory comes after its pixels. */
struct DngOf
{
  unsigned   width{ 48 };
  unsigned   height{ 32 };
  unsigned   bits{ 16 };
  bool       isJpeg{ false };
  unsigned   components{ 1 }; // components of the JPEG
  unsigned   tile{ 0 };       // its width and height; 0: a strip
  bool       isBigEndian{ false };
  bool       isBelow{ false };  // below a first directory, of a preview
  GreyValues greyValues{};      // grey values of the whole image
  TiffTags   tags{};            // what it says beyond that or otherwise; without values: not
  int        jpegFrame{ 0xC3 }; // the marker
  unsigned   iso{ 400 };

  /** Returns a noisy ramp. */
  static DngOf
  Sound(unsigned bits = 16)
  {
    DngOf dng;
    dng.bits = bits;
    for (unsigned i = 0; i < dng.width * dng.height; ++i)
    {
      dng.greyValues.push_back((300 + i + 7 * i * i % 101) & ((1U << bits) - 1));
    }
    return dng;
  }

  std::string
  Chunk(const GreyValues & part, unsigned across, unsigned down) const
  {
    if (isJpeg)
    {
      return LosslessJpeg(part, across, down, bits, components, jpegFrame);
    }
    if (bits == 16)
    {
      return BytesOfGreyValues(part, 2, isBigEndian);
    }
    std::string text;
    for (std::size_t y = 0; y < down; ++y)
    {
      const auto first = part.begin() + static_cast<std::ptrdiff_t>(y * across);
      text += BitStream(GreyValues(first, first + across), bits, true);
    }
    return text;
  }

  /** Returns the digital numbers of a tile; beyond the image, zeros. */
  GreyValues
  Tile(unsigned left, unsigned top) const
  {
    GreyValues part;
    for (unsigned y = top; y < top + tile; ++y)
    {
      for (unsigned x = left; x < left + tile; ++x)
      {
        part.push_back(x < width && y < height ? greyValues[y * width + x] : 0);
      }
    }
    return part;
  }

  std::string
  Bytes() const
  {
    const TiffOf      tiff{ false, isBigEndian };
    const std::string magic = std::string(isBigEndian ? "MM" : "II") + tiff.Number(42, 2);
    std::string       pixels;
    TiffTag           offsets{ 4, {} };
    TiffTag           counts{ 4, {} };
    const auto        add = [&](const std::string & chunk) {
      offsets.values.push_back(8 + pixels.size());
      counts.values.push_back(chunk.size());
      pixels += chunk;
    };
    for (unsigned y = 0; tile != 0 && y < height; y += tile)
    {
      for (unsigned x = 0; x < width; x += tile)
      {
        add(Chunk(Tile(x, y), tile, tile));
      }
    }
    if (tile == 0)
    {
      add(Chunk(greyValues, width, height));
    }
    pixels.append(pixels.size() % 2, '\0');
    const std::size_t preview = 8 + pixels.size();
    pixels += "colour"; // a preview of two pixels
    const std::size_t exif = 8 + pixels.size();
    pixels += tiff.Directory(
      { { 33434, { 5, { isBigEndian ? (1ULL << 32) + 50 : 1 + (50ULL << 32) } } }, { 34855, { 3, { iso } } } }, exif);
    pixels.append(pixels.size() % 2, '\0');
    const TiffTags about{ { 271, Text(std::string("Maker\0", 6)) },
                          { 272, Text(std::string("Model 1\0", 8)) },
                          { 34665, { 4, { exif } } },
                          { 50706, { 1, { 1, 4, 0, 0 } } },
                          { 50708, Text(std::string("Maker Model 1\0", 14)) } };
    TiffTags       image{ { 254, { 4, { 0 } } },
                          { 256, { 4, { width } } },
                          { 257, { 4, { height } } },
                          { 258, { 3, { bits } } },
                          { 259, { 3, { isJpeg ? 7U : 1U } } },
                          { 262, { 3, { 32803 } } },
                          { tile != 0 ? 324 : 273, offsets },
                          { 277, { 3, { 1 } } },
                          { tile != 0 ? 325 : 279, counts },
                          { 33421, { 3, { 2, 2 } } },
                          { 33422, { 1, { 0, 1, 1, 2 } } },
                          { 50714, { 4, { 64 } } },
                          { 50717, { 4, { bits == 16 ? 16383U : (1U << bits) - 1 } } } };
    if (tile != 0)
    {
      image[322] = { 4, { tile } };
      image[323] = { 4, { tile } };
    }
    else
    {
      image[278] = { 4, { height } };
    }
    for (const auto & [tag, content] : tags)
    {
      image[tag] = content;
      if (content.values.empty())
      {
        image.erase(tag);
      }
    }
    const std::size_t end = 8 + pixels.size();
    if (!isBelow)
    {
      image.insert(about.begin(), about.end());
      return magic + tiff.Number(end, 4) + pixels + tiff.Directory(image, end);
    }
    const std::string below = tiff.Directory(image, end);
    TiffTags          first = about;
    first.insert({ { 254, { 4, { 1 } } },
                   { 256, { 4, { 2 } } },
                   { 257, { 4, { 1 } } },
                   { 258, { 3, { 8, 8, 8 } } },
                   { 259, { 3, { 1 } } },
                   { 262, { 3, { 2 } } },
                   { 273, { 4, { preview } } },
                   { 277, { 3, { 3 } } },
                   { 278, { 4, { 1 } } },
                   { 279, { 4, { 6 } } },
                   { 330, { 4, { end } } } });
    const std::size_t at = end + below.size() + below.size() % 2;
    return magic + tiff.Number(at, 4) + pixels + below + std::string(below.size() % 2, '\0') +
           tiff.Directory(first, at);
  }
};

} // namespace sensornoise::test

#endif
