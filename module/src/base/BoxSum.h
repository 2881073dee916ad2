// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_base_BoxSum_h
#define sensornoise_base_BoxSum_h

#include "sensornoise/Parallel.h"
#include "base/Simd.h"
#include "SensorNoiseExport.h"

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace sensornoise
{

/** \class BoxRows
 * \brief Sums of a map over a square of 2 radius + 1 pixels about each pixel, cut at the border of the frame, row by
 * row.
 *
 * Running sums are computed along the columns, then along the rows: the cost does not depend on the radius. No map is
 * stored: source(y) returns the address of the values of row y, which are valid until the next call, and each row is
 * read twice.
 *
 * Running sums accumulate rounding errors. Rows are therefore summed in bands (ForBoxBands()), so that the result is
 * the same for any number of threads. */
template <typename TSource>
class BoxRows
{
public:
  /** Prepares the sums of the rows [first, last). */
  BoxRows(TSource     source,
          std::size_t width,
          std::size_t height,
          std::size_t radius,
          std::size_t first,
          std::size_t last)
    : m_Source(std::move(source))
    , m_Width(width)
    , m_Height(height)
    , m_Radius(radius)
    , m_First(first)
    , m_Last(last)
    , m_Next(first)
    , m_Columns(width, 0.0)
    , m_Columns4(Together * width)
    , m_Sums(Together * width)
  {
    for (std::size_t y = first - std::min(first, radius); y < std::min(height, first + radius); ++y)
    {
      this->Add(y, 1.0);
    }
  }

  /** Returns the sums of the next row, which are valid until the next call. */
  const double *
  Next()
  {
    const std::size_t row = (m_Next - m_First) % Together;
    if (row == 0)
    {
      this->SumRows(std::min(Together, m_Last - m_Next));
    }
    ++m_Next;
    return m_Sums.data() + row * m_Width;
  }

private:
  static constexpr std::size_t Together = 4; // number of rows that are summed along at once

  void
  Add(std::size_t y, double sign)
  {
    const auto * const row = m_Source(y);
    for (std::size_t x = 0; x < m_Width; ++x)
    {
      m_Columns[x] += sign * static_cast<double>(row[x]);
    }
  }

  void
  SumRows(std::size_t rows)
  {
    for (std::size_t k = 0; k < rows; ++k)
    {
      const std::size_t y = m_Next + k;
      if (y + m_Radius < m_Height)
      {
        this->Add(y + m_Radius, 1.0);
      }
      if (y > m_First && y > m_Radius)
      {
        this->Add(y - m_Radius - 1, -1.0);
      }
      std::copy(m_Columns.begin(), m_Columns.end(), m_Columns4.begin() + static_cast<std::ptrdiff_t>(k * m_Width));
    }
    if (rows == Together)
    {
      this->SumAlong<Together>(0);
    }
    for (std::size_t k = 0; k < rows && rows < Together; ++k)
    {
      this->SumAlong<1>(k);
    }
  }

  /** Computes running sums of neighbours along \a VRows rows, cut at their ends. Each sum depends on the previous one,
   * so that several rows are processed at the same time. */
  template <std::size_t VRows>
  void
  SumAlong(std::size_t first)
  {
    const double * const in = m_Columns4.data() + first * m_Width;
    double * const       out = m_Sums.data() + first * m_Width;
    double               sum[VRows] = {};
    for (std::size_t x = 0; x < std::min(m_Width, m_Radius); ++x)
    {
      for (std::size_t row = 0; row < VRows; ++row)
      {
        sum[row] += in[row * m_Width + x];
      }
    }
    for (std::size_t x = 0; x < m_Width; ++x)
    {
      const bool hasNext = x + m_Radius < m_Width;
      const bool hasLast = x > m_Radius;
      for (std::size_t row = 0; row < VRows; ++row)
      {
        const double * const here = in + row * m_Width + x;
        sum[row] += (hasNext ? here[m_Radius] : 0.0) - (hasLast ? *(here - m_Radius - 1) : 0.0);
        out[row * m_Width + x] = sum[row];
      }
    }
  }

  TSource             m_Source;
  std::size_t         m_Width;
  std::size_t         m_Height;
  std::size_t         m_Radius;
  std::size_t         m_First;
  std::size_t         m_Last;
  std::size_t         m_Next;
  std::vector<double> m_Columns;  // sums along the columns, about the current row
  std::vector<double> m_Columns4; // these sums for the last few rows
  std::vector<double> m_Sums;
};

template <typename TSource>
BoxRows(TSource, std::size_t, std::size_t, std::size_t, std::size_t, std::size_t) -> BoxRows<TSource>;

/** Calls function(first, last) for the bands of rows whose box sums are computed together, compiled for SIMD (AVX2). */
template <typename TFunction>
void
ForBoxBands(std::size_t height, const ParallelFor & parallelFor, TFunction function)
{
  constexpr std::size_t band = 64; // number of rows
  parallelFor((height + band - 1) / band,
              [&](std::size_t b) { CallWithAvx2([&] { function(b * band, std::min(height, (b + 1) * band)); }); });
}

/** Calls use(y, sums) with the box sums of every row; \a makeSource() returns the source of a BoxRows. */
template <typename TMakeSource, typename TUse>
void
ForBoxRows(TMakeSource         makeSource,
           std::size_t         width,
           std::size_t         height,
           std::size_t         radius,
           const ParallelFor & parallelFor,
           TUse                use)
{
  ForBoxBands(height, parallelFor, [&](std::size_t first, std::size_t last) {
    BoxRows<decltype(makeSource())> sums(makeSource(), width, height, radius, first, last);
    for (std::size_t y = first; y < last; ++y)
    {
      use(y, sums.Next());
    }
  });
}

/** Returns a source of the rows of \a map, which have \a width values. */
template <typename TValue>
auto
RowsOf(const std::vector<TValue> & map, std::size_t width)
{
  return [map = map.data(), width](std::size_t y) { return map + y * width; };
}

} // namespace sensornoise

#endif
