// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "files/PngRows.h"

#include <algorithm>
#include <cstdlib>

namespace sensornoise
{
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

PngRows::PngRows(std::size_t width,
                 std::size_t height,
                 std::size_t bytesPerPixel,
                 bool        interlaced,
                 unsigned    significantBits)
  : m_BytesPerPixel(bytesPerPixel)
  , m_SignificantBits(significantBits)
{
  struct Grid
  {
    std::size_t x, y, stepX, stepY;
  };
  static constexpr Grid whole{ 0, 0, 1, 1 };
  static constexpr Grid adam7[]{ { 0, 0, 8, 8 }, { 4, 0, 8, 8 }, { 0, 4, 4, 8 }, { 2, 0, 4, 4 },
                                 { 0, 2, 2, 4 }, { 1, 0, 2, 2 }, { 0, 1, 1, 2 } };
  const std::size_t     passes = interlaced ? 7 : 1;
  for (std::size_t i = 0; i < passes; ++i)
  {
    const Grid &      grid = interlaced ? adam7[i] : whole;
    const std::size_t columns = (width + grid.stepX - 1 - std::min(grid.x, width + grid.stepX - 1)) / grid.stepX;
    const std::size_t rows = (height + grid.stepY - 1 - std::min(grid.y, height + grid.stepY - 1)) / grid.stepY;
    if (columns > 0 && rows > 0)
    {
      m_Passes.push_back({ columns * bytesPerPixel, rows });
      m_Bytes += std::uint64_t{ rows } * (columns * bytesPerPixel + 1);
    }
  }
  if (significantBits > 0)
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
    const std::size_t have = m_Filled - 1;
    const std::size_t used = std::min(count, m_Passes[m_Pass].rowBytes - have);
    if (m_SignificantBits > 0)
    {
      std::copy(bytes, bytes + used, m_Current.begin() + static_cast<std::ptrdiff_t>(have));
    }
    bytes += used;
    count -= used;
    m_Filled += used;
    if (m_Filled == m_Passes[m_Pass].rowBytes + 1)
    {
      EndRow();
    }
  }
}

void
PngRows::EndRow()
{
  if (m_SignificantBits > 0)
  {
    const std::size_t count = m_Passes[m_Pass].rowBytes;
    Unfilter(m_Filter, m_BytesPerPixel, count, m_Current, m_Previous);
    const unsigned lower = 8 * static_cast<unsigned>(m_BytesPerPixel) - m_SignificantBits;
    for (std::size_t i = 0; i < count; i += m_BytesPerPixel)
    {
      const unsigned code = m_BytesPerPixel == 2 ? m_Current[i] * 256U + m_Current[i + 1] : m_Current[i];
      m_HasLowerBits = m_HasLowerBits || (code & ((1U << lower) - 1)) != 0;
    }
    m_Current.swap(m_Previous);
  }
  m_Filled = 0;
  if (++m_Row == m_Passes[m_Pass].rows)
  {
    m_Row = 0;
    ++m_Pass;
    std::fill(m_Previous.begin(), m_Previous.end(), static_cast<unsigned char>(0));
  }
}

} // namespace sensornoise
