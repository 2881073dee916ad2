// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "published/Flicker.h"

#include "base/BinaryStream.h"
#include "base/ParallelWork.h"
#include "sensornoise/FrameGeometry.h"
#include "base/Simd.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <istream>
#include <limits>
#include <ostream>
#include <utility>
#include <vector>

namespace sensornoise
{

namespace
{
/** Returns the power of 2 to whose multiples the centred flicker is rounded. Then 53 bits hold every sum of flicker
 * times pixels of 16 bits, because the sum is at most the product of both norms (Cauchy-Schwarz). \a norm is the
 * largest norm of a row's flicker [1]. */
double
StepOfSeries(double norm, std::size_t frames)
{
  constexpr int    bitsOfSums = 53;
  constexpr int    bitsOfPixels = 16;
  constexpr double rounded = 1.001; // rounding may increase the norm
  int              exponent = 0;
  std::frexp(rounded * norm * std::sqrt(static_cast<double>(frames)), &exponent); // the product is <= 2^exponent
  return std::ldexp(1.0, exponent - (bitsOfSums - bitsOfPixels));
}

/** Number of frames that are added while the sums are in registers. Chosen empirically: half and twice this number take
 * a tenth longer. */
constexpr std::size_t FramesInRegisters = 8;

/** Adds the factors of VFrames frames times every \a TStep-th of their pixels, frame by frame. The step is a constant
 * so that SIMD instructions are used. */
template <std::size_t TStep, typename TPixel, std::size_t... VFrames>
void
AddFramesTimes(const double * factors,
               const TPixel * pixels,
               std::size_t    stride,
               std::size_t    count,
               double *       sums,
               std::index_sequence<VFrames...>)
{
  const double own[] = { factors[VFrames]... };
  for (std::size_t x = 0; x < count; ++x)
  {
    double sum = sums[x];
    ((sum += own[VFrames] * static_cast<double>(pixels[VFrames * stride + TStep * x])), ...);
    sums[x] = sum;
  }
}

/** Adds as many frames as there are \a factors in the same way. */
template <std::size_t TStep, typename TPixel>
void
AddTimes(const std::vector<double> & factors,
         const TPixel *              pixels,
         std::size_t                 stride,
         std::size_t                 count,
         double *                    sums)
{
  std::size_t k = 0;
  for (; k + FramesInRegisters <= factors.size(); k += FramesInRegisters)
  {
    AddFramesTimes<TStep>(
      factors.data() + k, pixels + k * stride, stride, count, sums, std::make_index_sequence<FramesInRegisters>());
  }
  for (; k < factors.size(); ++k)
  {
    AddFramesTimes<TStep>(factors.data() + k, pixels + k * stride, stride, count, sums, std::index_sequence<0>());
  }
}
} // namespace

CorrectedVariance::CorrectedVariance(const FlickerEstimate & flicker,
                                     const FrameGeometry &   geometry,
                                     std::size_t             frames,
                                     const ParallelFor &     parallelFor)
  : m_Geometry(geometry)
  , m_Frames(frames)
  , m_OffsetDn(flicker.offsetDn)
  , m_Rows(flicker.gammaRows.empty() ? 1 : flicker.rows)
  , m_Cross(MakeMap<double>(geometry.Pixels(), parallelFor))
  , m_Series(frames * m_Rows)
  , m_SeriesSums(m_Rows, 0.0)
  , m_SeriesSquares(m_Rows, 0.0)
  , m_Known(flicker.rowKnown)
{
  double longest = 0.0; // square of the norm
  for (std::size_t row = 0; row < m_Rows; ++row)
  {
    double mean = 0.0;
    for (std::size_t t = 0; t < frames; ++t)
    {
      mean += flicker.Gamma(t, row);
    }
    mean /= static_cast<double>(frames);
    double square = 0.0;
    for (std::size_t t = 0; t < frames; ++t)
    {
      double & centred = m_Series[t * m_Rows + row];
      centred = flicker.Gamma(t, row) - mean;
      square += centred * centred;
    }
    longest = std::isfinite(square) ? std::max(longest, square) : longest; // NaN in rows whose flicker is not known
  }
  const double step = StepOfSeries(std::sqrt(longest), frames);
  for (std::size_t t = 0; t < frames; ++t)
  {
    for (std::size_t row = 0; row < m_Rows; ++row)
    {
      double & rounded = m_Series[t * m_Rows + row];
      rounded = std::round(rounded / step) * step;
      m_SeriesSums[row] += rounded;
      m_SeriesSquares[row] += rounded * rounded;
    }
  }
}

void
CorrectedVariance::Forget()
{
  std::fill(m_Cross.begin(), m_Cross.end(), 0.0);
}

void
CorrectedVariance::Save(std::ostream & out) const
{
  WriteNumbers(out, m_Cross);
}

void
CorrectedVariance::Merge(std::istream & in)
{
  std::vector<double> others(m_Cross.size());
  ReadNumbers(in, others);
  std::transform(m_Cross.begin(), m_Cross.end(), others.begin(), m_Cross.begin(), std::plus<double>());
}

template <typename TPixel>
void
CorrectedVariance::AddRow(const TPixel *      frames,
                          const PixelLayout & layout,
                          std::size_t         count,
                          std::size_t         t,
                          std::size_t         y)
{
  const std::size_t    width = m_Geometry.width;
  double * const       cross = m_Cross.data() + y * width;
  const TPixel * const row = frames + layout.At(0, y);
  if (m_Rows > 1 && m_Geometry.shutterAxis == 0) // each pixel of the row has a flicker of its own
  {
    for (std::size_t k = 0; k < count; ++k)
    {
      const TPixel * const values = row + k * layout.frame;
      const double * const series = m_Series.data() + (t + k) * m_Rows;
      for (std::size_t x = 0; x < width; ++x)
      {
        cross[x] += series[x] * static_cast<double>(values[layout.step * x]);
      }
    }
    return;
  }
  std::vector<double> factors(count);
  for (std::size_t k = 0; k < count; ++k)
  {
    factors[k] = m_Series[(t + k) * m_Rows + (m_Rows > 1 ? y : 0)];
  }
  CallWithAvx2([&] {
    layout.step == 1 ? AddTimes<1>(factors, row, layout.frame, width, cross)
                     : AddTimes<2>(factors, row, layout.frame, width, cross);
  });
}

double
CorrectedVariance::GetVariance(std::size_t p, double meanDn, double sumOfSquaredDeviationsDn2) const
{
  const std::size_t row = m_Rows > 1 ? m_Geometry.RowOf(p) : 0;
  if (!m_Known.empty() && m_Known[row] == 0)
  {
    return std::numeric_limits<double>::quiet_NaN();
  }
  const double fluxDn = meanDn - m_OffsetDn;
  const double cross = m_Cross[p] - m_SeriesSums[row] * meanDn;
  const double squaresOfSeries =
    m_SeriesSquares[row] - m_SeriesSums[row] * m_SeriesSums[row] / static_cast<double>(m_Frames);
  const double squares = sumOfSquaredDeviationsDn2 - 2.0 * fluxDn * cross + fluxDn * fluxDn * squaresOfSeries;
  return squares / static_cast<double>(m_Frames - 1);
}

#define SensorNoise_INSTANTIATE(TPixel)                               \
  template SensorNoise_EXPORT void CorrectedVariance::AddRow<TPixel>( \
    const TPixel *, const PixelLayout &, std::size_t, std::size_t, std::size_t)
SensorNoise_FOR_PIXEL_TYPES(SensorNoise_INSTANTIATE);
#undef SensorNoise_INSTANTIATE

} // namespace sensornoise
