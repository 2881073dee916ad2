// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_test_TiffTestHelper_h
#define sensornoise_test_TiffTestHelper_h

#include "helpers/CompressedBytesTestHelper.h"

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace sensornoise::test
{

/** The values of a tag, all of one type; of type ASCII, a character each. */
struct TiffTag
{
  unsigned                   type{ 4 };
  std::vector<std::uint64_t> values{};
};

/** Tags by their numbers. A tag without values is left out. */
using TiffTags = std::map<unsigned, TiffTag>;

/** A TIFF file. A test may change each of its members. */
struct TiffOf
{
  bool                  isBig{ false };
  bool                  isBigEndian{ false };
  std::size_t           width{ 13 };
  std::size_t           height{ 9 };
  std::size_t           rowsPerStrip{ 4 };
  std::size_t           tileWidth{ 0 }; // 0: strips
  std::size_t           tileLength{ 0 };
  unsigned              bits{ 16 };
  unsigned              compression{ 1 };
  unsigned              predictor{ 1 };                   // predictor of the pixels; its tag is one of `pages`
  std::vector<TiffTags> pages = std::vector<TiffTags>(3); // tags of each page that are added, or differ
  std::string           strip{};                          // instead of the first strip or tile
  std::size_t           fillUp{ 0 };                      // rows added to the last strip
  std::int64_t          moveStrip{ 0 };                   // the first strip or tile of the second page [bytes]
  std::string           between{};                        // bytes before each directory

  std::string
  Number(std::uint64_t number, std::size_t bytes) const
  {
    std::string text;
    AppendNumber(text, number, bytes, isBigEndian);
    return text;
  }

  /** Returns the differences that a predictor stores for a row: of its samples (2), or of the bytes of all samples, the
   * highest bytes first (3). */
  std::string
  Predicted(const std::vector<std::uint64_t> & samples) const
  {
    std::string row;
    if (predictor == 3)
    {
      std::string planes;
      for (std::size_t byte = 0; byte < bits / 8; ++byte)
      {
        for (const std::uint64_t sample : samples)
        {
          planes += static_cast<char>((sample >> (bits - 8 - 8 * byte)) & 255);
        }
      }
      for (std::size_t i = 0; i < planes.size(); ++i)
      {
        row += static_cast<char>(planes[i] - (i > 0 ? planes[i - 1] : 0));
      }
      return row;
    }
    for (std::size_t x = 0; x < samples.size(); ++x)
    {
      row += Number(samples[x] - (predictor == 2 && x > 0 ? samples[x - 1] : 0), bits / 8);
    }
    return row;
  }

  /** Returns the value of a pixel. Pixels beyond the image, which fill a tile up, have values, too. */
  static std::uint64_t
  Sample(std::size_t page, std::size_t x, std::size_t y)
  {
    return 100 + x * y + 3 * page;
  }

  std::string
  StripOf(std::size_t page, std::size_t firstRow, std::size_t rows) const
  {
    return PixelsOf(page, 0, firstRow, width, rows);
  }

  /** Returns the bytes of a strip or tile. */
  std::string
  PixelsOf(std::size_t page, std::size_t firstColumn, std::size_t firstRow, std::size_t columns, std::size_t rows) const
  {
    std::string packed;
    std::string plain;
    for (std::size_t y = firstRow; y < firstRow + rows; ++y)
    {
      std::vector<std::uint64_t> samples;
      for (std::size_t x = firstColumn; x < firstColumn + columns; ++x)
      {
        samples.push_back(Sample(page, x, y));
      }
      const std::string row = Predicted(samples);
      plain += row;
      packed += PackedBits(row);
    }
    return compression == 32773                       ? packed
           : compression == 5                         ? LzwStream(plain)
           : compression == 8 || compression == 32946 ? ZlibStream(plain)
                                                      : plain;
  }

  static std::size_t
  BytesOf(unsigned type)
  {
    return type == 3 ? 2 : type == 4 ? 4 : type == 5 || type == 16 ? 8 : 1;
  }

  std::string
  Directory(const TiffTags & tags, std::size_t offset) const
  {
    const std::size_t word = isBig ? 8 : 4;
    std::string       table = Number(tags.size(), isBig ? 8 : 2);
    std::string       values;
    const std::size_t end = offset + table.size() + tags.size() * (4 + 2 * word) + word;
    for (const auto & [tag, content] : tags)
    {
      std::string text;
      for (const std::uint64_t value : content.values)
      {
        text += Number(value, BytesOf(content.type));
      }
      table += Number(tag, 2) + Number(content.type, 2) + Number(content.values.size(), word);
      if (text.size() <= word)
      {
        table += text + std::string(word - text.size(), '\0');
      }
      else
      {
        table += Number(end + values.size(), word);
        values += text;
      }
    }
    return table + std::string(word, '\0') + values;
  }

  struct Piece
  {
    std::size_t column{ 0 };
    std::size_t row{ 0 };
    std::size_t columns{ 0 };
    std::size_t rows{ 0 };
  };

  /** Returns the strips or tiles of a page. */
  std::vector<Piece>
  Pieces() const
  {
    const bool         isTiled = tileWidth > 0;
    const std::size_t  down = isTiled ? tileLength : rowsPerStrip;
    const std::size_t  across = isTiled ? tileWidth : width;
    std::vector<Piece> pieces;
    for (std::size_t y = 0; y < height; y += down)
    {
      for (std::size_t x = 0; x < width; x += across)
      {
        pieces.push_back({ x, y, across, isTiled || y + down < height ? down : height - y + fillUp });
      }
    }
    return pieces;
  }

  std::string
  Bytes() const
  {
    const std::size_t word = isBig ? 8 : 4;
    std::string       tiff = std::string(isBigEndian ? "MM" : "II") + Number(isBig ? 43 : 42, 2);
    tiff += isBig ? Number(8, 2) + Number(0, 2) : "";
    std::size_t link = tiff.size();
    tiff += Number(0, word);
    for (std::size_t page = 0; page < pages.size(); ++page)
    {
      TiffTags       tags{ { 256, { 4, { width } } },       { 257, { 4, { height } } }, { 258, { 3, { bits } } },
                           { 259, { 3, { compression } } }, { 262, { 3, { 1 } } },      { 277, { 3, { 1 } } },
                           { 278, { 4, { rowsPerStrip } } } };
      const bool     isTiled = tileWidth > 0;
      const unsigned offsets = isTiled ? 324 : 273;
      const unsigned counts = isTiled ? 325 : 279;
      if (isTiled)
      {
        tags.erase(278);
        tags[322] = { 4, { tileWidth } };
        tags[323] = { 4, { tileLength } };
      }
      bool isFirst = true;
      for (const Piece & piece : Pieces())
      {
        const std::string bytes = page == 0 && isFirst && !strip.empty()
                                    ? strip
                                    : PixelsOf(page, piece.column, piece.row, piece.columns, piece.rows);
        tags[offsets].values.push_back(tiff.size() + static_cast<std::uint64_t>(page == 1 && isFirst ? moveStrip : 0));
        tags[counts].values.push_back(bytes.size());
        tiff += bytes;
        isFirst = false;
      }
      for (const auto & [tag, content] : pages[page])
      {
        tags[tag] = content;
        if (content.values.empty())
        {
          tags.erase(tag);
        }
      }
      tiff += between;
      tiff.replace(link, word, Number(tiff.size(), word));
      link = tiff.size() + (isBig ? 8 : 2) + tags.size() * (4 + 2 * word);
      tiff += Directory(tags, tiff.size());
    }
    return tiff;
  }
};

/** Returns a file with the same tags on all three pages. */
inline TiffOf
TiffWith(const TiffTags & tags)
{
  TiffOf tiff;
  tiff.pages.assign(3, tags);
  return tiff;
}

inline TiffTag
Text(const std::string & text)
{
  TiffTag tag{ 2, {} };
  for (const char c : text)
  {
    tag.values.push_back(static_cast<unsigned char>(c));
  }
  return tag;
}

} // namespace sensornoise::test

#endif
