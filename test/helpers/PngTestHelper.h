// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_test_PngTestHelper_h
#define sensornoise_test_PngTestHelper_h

#include "helpers/CompressedBytesTestHelper.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>

namespace sensornoise::test
{

inline std::string
PngChunkOf(const std::string & type, const std::string & data)
{
  std::string chunk;
  AppendNumber(chunk, data.size(), 4, true);
  chunk += type + data;
  AppendNumber(chunk, Crc32(type + data), 4, true);
  return chunk;
}

/** A PNG file. A test may change each of its members. */
struct PngOf
{
  std::size_t width{ 13 };
  std::size_t height{ 9 };
  unsigned    depth{ 16 };
  unsigned    colour{ 0 };
  unsigned    interlacing{ 0 };
  std::string before{};   // chunks between IHDR and IDAT
  std::string after{};    // chunks between IDAT and IEND
  std::string rows{};     // filters and pixels; empty: of the right number
  unsigned    shift{ 0 }; // bits by which made grey values are shifted
  std::size_t piece{ 0 }; // bytes of an IDAT chunk; 0: one chunk
  std::string end{ PngChunkOf("IEND", "") };

  std::string
  Header() const
  {
    std::string header;
    AppendNumber(header, width, 4, true);
    AppendNumber(header, height, 4, true);
    return header + static_cast<char>(depth) + static_cast<char>(colour) + std::string(2, '\0') +
           static_cast<char>(interlacing);
  }

  /** A row of filter `filter`; of the filters above 0, as if all bytes of the pixels were 0. */
  std::string
  Row(std::size_t columns, unsigned filter) const
  {
    std::string row(1, static_cast<char>(filter));
    for (std::size_t x = 0; x < columns; ++x)
    {
      AppendNumber(row, filter == 0 ? (7 * x + 100) << shift : 0, depth / 8, true);
    }
    return row;
  }

  std::string
  Rows() const
  {
    static constexpr std::size_t adam7[7][4]{ { 0, 0, 8, 8 }, { 4, 0, 8, 8 }, { 0, 4, 4, 8 }, { 2, 0, 4, 4 },
                                              { 0, 2, 2, 4 }, { 1, 0, 2, 2 }, { 0, 1, 1, 2 } };
    static constexpr std::size_t whole[1][4]{ { 0, 0, 1, 1 } };
    std::string                  made;
    for (std::size_t pass = 0; pass < (interlacing == 1 ? 7u : 1u); ++pass)
    {
      const std::size_t * const grid = interlacing == 1 ? adam7[pass] : whole[pass];
      const std::size_t         columns = width > grid[0] ? (width - grid[0] - 1) / grid[2] + 1 : 0;
      for (std::size_t y = grid[1]; y < height && columns > 0; y += grid[3])
      {
        made += Row(columns, 0);
      }
    }
    return made;
  }

  std::string
  Bytes() const
  {
    std::string       png = "\x89PNG\r\n\x1A\n" + PngChunkOf("IHDR", Header()) + before;
    const std::string stream = ZlibStream(rows.empty() ? Rows() : rows);
    const std::size_t each = piece == 0 ? stream.size() : piece;
    for (std::size_t at = 0; at < stream.size(); at += each)
    {
      png += PngChunkOf("IDAT", stream.substr(at, each));
    }
    return png + after + end;
  }
};

} // namespace sensornoise::test

#endif
