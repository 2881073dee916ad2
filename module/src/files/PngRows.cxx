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
