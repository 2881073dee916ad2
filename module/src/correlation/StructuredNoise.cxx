// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "correlation/NoiseCorrelation.h"

#include "moments/DarkFrames.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

namespace sensornoise
{

namespace
{
/** Subtracts from each frame the mean of its usable pixels. As a temporal component the mean would take a part of any
 * noise that moves it, such as half of the power of a wave. */
void
SubtractLevels(NoiseSample & sample, const std::vector<std::uint8_t> & usable)
{
  const SampleTiles & tiles = sample.GetTiles();
  for (std::size_t t = 0; t < tiles.frames; ++t)
  {
    double sum = 0.0;
    double count = 0.0;
    for (std::size_t i = 0; i < tiles.origins.size(); ++i)
    {
      const float * values = sample.OfTile(i) + t * tiles.Pixels();
      for (std::size_t p = 0; p < tiles.Pixels(); ++p)
      {
        const double take = usable[sample.PixelOf(i, p)] != 0 ? 1.0 : 0.0;
        sum += take * static_cast<double>(values[p]);
        count += take;
      }
    }
    const auto level = static_cast<float>(count > 0.0 ? sum / count : 0.0);
    for (std::size_t i = 0; i < tiles.origins.size(); ++i)
    {
      float * values = sample.OfTile(i) + t * tiles.Pixels();
      std::transform(values, values + tiles.Pixels(), values, [level](float value) { return value - level; });
    }
  }
}
} // namespace

std::optional<StructuredNoise>
MeasureStructuredNoise(FrameSample sample, std::size_t frames, const DarkMaps & dark, const ParallelFor & parallelFor)
{
  constexpr std::size_t fewest = 3; // a mean, and two degrees of freedom
  if (frames < fewest)
  {
    return std::nullopt;
  }
  NoiseSample              noise = sample.TakeNoise(dark.offsetDn, parallelFor);
  std::vector<std::size_t> kept(frames);
  std::iota(kept.begin(), kept.end(), std::size_t{ 0 });
  noise.KeepFrames(kept);
  SubtractLevels(noise, dark.usable);
  const Eigen::MatrixXd none(static_cast<Eigen::Index>(frames), 0);
  // Without signal no covariance is taken for illumination.
  const std::vector<double> signal(dark.usable.size(), 0.0);
  NoiseResiduals            residuals(std::move(noise), none, { signal, dark.usable, 0.0, true }, parallelFor);
  const double              quantisationDn2 = dark.stepDn * dark.stepDn / 12.0;
  const NoiseCorrelation    correlation = MeasureWithoutInterference(residuals, quantisationDn2, parallelFor);
  if (correlation.kind == NoiseKind::NotMeasured)
  {
    return std::nullopt;
  }
  const MeasuredNumber sum = correlation.StructuredNoiseWithScatter();
  StructuredNoise      found{ { sum.value, sum.standardError }, {} };
  for (const PeriodicInterference & wave : correlation.interference)
  {
    found.waves.push_back(wave.frequency);
  }
  return found;
}

} // namespace sensornoise
