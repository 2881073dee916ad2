// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/Emva1288.h"
#include "emva1288/HighpassFilter.h"
#include "emva1288/SpatialVariance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <string>
#include <utility>

namespace sensornoise
{

namespace
{
/** Sum over the pixels of a frame, its highest value, and the number of pixels that have it. */
struct FrameSummary
{
  double sum{ 0.0 };
  double highest{ -std::numeric_limits<double>::infinity() };
  double atHighest{ 0.0 };
  bool   isFinite{ true };

  void
  Add(double value)
  {
    sum += value;
    isFinite = isFinite && std::isfinite(value);
    if (value > highest)
    {
      highest = value;
      atHighest = 0.0;
    }
    atHighest += value == highest ? 1.0 : 0.0;
  }
};

double
SumOfSquares(const std::vector<double> & values, const ParallelFor & parallelFor)
{
  return SumOverBlocks<1>(
    values.size(), parallelFor, [&values](std::size_t p, auto & sums) { sums[0] += values[p] * values[p]; })[0];
}

/** Returns the mean over the pixels of their temporal variance, of the sum of their squares over frames and pixels, and
 * of the sum of the squares of the mean image. */
double
StackVariance(double squares, double squaresOfMean, double frames, double pixels)
{
  return std::max(0.0, squares - frames * squaresOfMean) / ((frames - 1.0) * pixels);
}
} // namespace

EmvaSeriesSums::EmvaSeriesSums(std::size_t width, std::size_t height)
  : m_Width(width)
  , m_Height(height)
{
  if (width < 3 || height < 3)
  {
    throw std::invalid_argument("frames of " + std::to_string(width) + " x " + std::to_string(height) +
                                " pixels have no rows and columns to compare; expected 3 x 3 or more");
  }
  for (std::vector<double> * const map : { &m_Sum, &m_SquareSum, &m_Frame })
  {
    map->resize(width * height, 0.0);
  }
}

template <typename TPixel>
void
EmvaSeriesSums::AddFrame(const TPixel * frame, const ParallelFor & parallelFor)
{
  const auto add = [this, frame](std::size_t begin, std::size_t end, FrameSummary & part) {
    for (std::size_t p = begin; p < end; ++p)
    {
      const auto value = static_cast<double>(frame[p]);
      m_Frame[p] = value;
      m_Sum[p] += value;
      m_SquareSum[p] += value * value;
      part.Add(value);
    }
  };
  double sum = 0.0;
  bool   isFinite = true;
  for (const FrameSummary & part : PartsOfBlocks<FrameSummary>(m_Frame.size(), parallelFor, add))
  {
    sum += part.sum;
    isFinite = isFinite && part.isFinite;
    m_AtHighest = part.highest > m_HighestDn ? 0.0 : m_AtHighest;
    m_HighestDn = std::max(m_HighestDn, part.highest);
    m_AtHighest += part.highest == m_HighestDn ? part.atHighest : 0.0;
  }
  if (!isFinite)
  {
    throw std::invalid_argument("frame " + std::to_string(m_FrameMeans.size()) +
                                " of a series holds NaN or infinity; expected numbers alone. Leave this frame out.");
  }
  m_FrameMeans.push_back(sum / static_cast<double>(m_Frame.size()));
  if (HasRoomForHighpass(m_Width, m_Height))
  {
    m_HighpassSquares += SumOfSquares(FilterHighpass(m_Frame, m_Width, m_Height, parallelFor).pixels, parallelFor);
  }
}

template SensorNoise_EXPORT void
EmvaSeriesSums::AddFrame(const unsigned char *, const ParallelFor &);
template SensorNoise_EXPORT void
EmvaSeriesSums::AddFrame(const unsigned short *, const ParallelFor &);
template SensorNoise_EXPORT void
EmvaSeriesSums::AddFrame(const short *, const ParallelFor &);
template SensorNoise_EXPORT void
EmvaSeriesSums::AddFrame(const float *, const ParallelFor &);
template SensorNoise_EXPORT void
EmvaSeriesSums::AddFrame(const double *, const ParallelFor &);

EmvaSeries
EmvaSeriesSums::Measure(const ParallelFor & parallelFor) const
{
  const std::size_t count = m_FrameMeans.size();
  if (count < 2)
  {
    throw std::invalid_argument("a series has " + std::to_string(count) +
                                " frame; expected 2 or more frames of each exposure");
  }
  const auto          frames = static_cast<double>(count);
  const auto          pixels = static_cast<double>(m_Sum.size());
  std::vector<double> mean(m_Sum.size());
  ForPixels(m_Sum.size(), parallelFor, [&](std::size_t p) { mean[p] = m_Sum[p] / frames; });
  // squares about the mean of each pixel, so that no digits are lost at high levels
  const double excess = SumOverBlocks<1>(m_Sum.size(), parallelFor, [&](std::size_t p, auto & sums) {
    sums[0] += m_SquareSum[p] - m_Sum[p] * m_Sum[p] / frames;
  })[0];
  const double stackDn2 = std::max(0.0, excess) / ((frames - 1.0) * pixels);

  EmvaSeries series;
  series.width = m_Width;
  series.height = m_Height;
  series.frames = count;
  series.meanDn = std::accumulate(m_FrameMeans.begin(), m_FrameMeans.end(), 0.0) / frames;
  for (const double level : m_FrameMeans)
  {
    series.frameSquaresDn2 += (level - series.meanDn) * (level - series.meanDn);
  }
  series.temporalVarianceDn2 = std::max(0.0, stackDn2 - series.frameSquaresDn2 / (frames - 1.0));
  series.highestDn = m_HighestDn;
  series.fractionAtHighest = m_AtHighest / (pixels * frames);
  series.unfiltered = MeasureSpatialVariance(mean, m_Width, m_Height, stackDn2, count);
  if (HasRoomForHighpass(m_Width, m_Height))
  {
    const HighpassImage filtered = FilterHighpass(mean, m_Width, m_Height, parallelFor);
    const auto          kept = static_cast<double>(filtered.pixels.size());
    const double        squaresOfMean = SumOfSquares(filtered.pixels, parallelFor);
    series.highpass = MeasureSpatialVariance(filtered.pixels,
                                             filtered.columns,
                                             filtered.rows,
                                             StackVariance(m_HighpassSquares, squaresOfMean, frames, kept),
                                             count);
  }
  return series;
}

} // namespace sensornoise
