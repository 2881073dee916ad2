// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "moments/DarkDrift.h"

#include "sensornoise/Parallel.h"
#include "sensornoise/FrameGeometry.h"
#include "base/Quantiles.h"
#include "moments/Constants.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <utility>
#include <vector>

namespace sensornoise
{

namespace
{

/** Returns the finite values of the pixels \a sample of a frame [DN]. */
template <typename TPixel>
std::vector<double>
FiniteValues(const TPixel * frame, const std::vector<std::size_t> & sample)
{
  std::vector<double> values;
  values.reserve(sample.size());
  for (const std::size_t p : sample)
  {
    const auto value = static_cast<double>(frame[p]);
    if (std::isfinite(value))
    {
      values.push_back(value);
    }
  }
  return values;
}

} // namespace

DarkDrift::DarkDrift(std::size_t pixels, std::vector<std::uint8_t> mask)
  : m_Mask(mask.empty() ? std::vector<std::uint8_t>(pixels, 1) : std::move(mask))
  , m_Sample(SamplePixels(m_Mask))
  , m_ProductsDn2(pixels, 0.0)
{}

template <typename TPixel>
double
DarkDrift::MedianOf(const TPixel * frame) const
{
  std::vector<double> values = FiniteValues(frame, m_Sample);
  return values.empty() ? 0.0 : Quantile(values, 0.5);
}

template <typename TPixel>
double
DarkDrift::LevelOf(const TPixel * frame) const
{
  const double medianDn = MedianOf(frame);
  double       sum = 0.0;
  double       count = 0.0;
  for (std::size_t p = 0; p < m_Mask.size(); ++p)
  {
    const double above = static_cast<double>(frame[p]) - medianDn;
    if (m_Mask[p] != 0 && std::abs(above) <= m_ReachDn)
    {
      sum += above;
      count += 1.0;
    }
  }
  return count > 0.0 ? medianDn + sum / count : medianDn;
}

template <typename TPixel>
void
DarkDrift::Start(const TPixel * frame)
{
  std::vector<double> values = FiniteValues(frame, m_Sample);
  // At least one DN, so that rounding does not reduce the reach to 0.
  const double leastDn = std::is_integral_v<TPixel> ? 1.0 : 0.0;
  m_ReachDn =
    values.empty() ? 0.0 : InMoments.levelReach * std::max(leastDn, Quantile(values, 0.84) - Quantile(values, 0.16));
  const double medianDn = MedianOf(frame);
  for (std::size_t p = 0; p < m_Mask.size(); ++p)
  {
    m_LevelPixels += m_Mask[p] != 0 && std::abs(static_cast<double>(frame[p]) - medianDn) <= m_ReachDn ? 1.0 : 0.0;
  }
}

template <typename TPixel>
void
DarkDrift::AddFrames(const TPixel * frames, std::size_t count, const ParallelFor & parallelFor)
{
  const std::size_t pixels = m_ProductsDn2.size();
  const std::size_t first = m_LevelsDn.size();
  if (first == 0 && count > 0)
  {
    Start(frames);
  }
  m_LevelsDn.resize(first + count);
  parallelFor(count, [&](std::size_t k) { m_LevelsDn[first + k] = LevelOf(frames + k * pixels); });
  for (std::size_t t = first; t < first + count; ++t)
  {
    const double driftDn = m_LevelsDn[t] - m_LevelsDn[0];
    m_SumDn += driftDn;
    m_SumOfSquaresDn2 += driftDn * driftDn;
  }
  ForBlocks(pixels, parallelFor, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = 0; k < count; ++k)
    {
      const double   driftDn = m_LevelsDn[first + k] - m_LevelsDn[0];
      const TPixel * frame = frames + k * pixels;
      for (std::size_t p = begin; p < end; ++p)
      {
        m_ProductsDn2[p] += (static_cast<double>(frame[p]) - m_LevelsDn[0]) * driftDn;
      }
    }
  });
}

double
DarkDrift::SquaresWithoutDrift(std::size_t p, double sumOfSquaresDn2, double meanDn) const
{
  if (m_LevelsDn.size() < 2 || m_LevelPixels < 2.0)
  {
    return sumOfSquaresDn2;
  }
  const double products = m_ProductsDn2[p] - (meanDn - m_LevelsDn[0]) * m_SumDn;
  // The level of a frame contains a part of the noise of the pixel itself.
  const double share = m_LevelPixels / (m_LevelPixels - 1.0);
  return std::max(0.0, sumOfSquaresDn2 - 2.0 * products + GetSumOfSquaresDn2()) * share;
}

double
DarkDrift::GetSumOfSquaresDn2() const
{
  return m_LevelsDn.empty() ? 0.0 : m_SumOfSquaresDn2 - m_SumDn * m_SumDn / static_cast<double>(m_LevelsDn.size());
}

double
DarkDrift::GetVarianceDn2(double pixelVarianceDn2) const
{
  if (m_LevelsDn.size() < 2 || m_LevelPixels < 2.0)
  {
    return 0.0;
  }
  const double levels = GetSumOfSquaresDn2() / static_cast<double>(m_LevelsDn.size() - 1);
  return std::max(0.0, levels - pixelVarianceDn2 / m_LevelPixels);
}

#define SensorNoise_INSTANTIATE(TPixel) \
  template SensorNoise_EXPORT void DarkDrift::AddFrames<TPixel>(const TPixel *, std::size_t, const ParallelFor &)
SensorNoise_FOR_PIXEL_TYPES(SensorNoise_INSTANTIATE);
#undef SensorNoise_INSTANTIATE

} // namespace sensornoise
