/*=========================================================================
 *
 *  Copyright the ITKSensorNoise contributors
 *
 *  Licensed under the Apache License, Version 2.0 (the "License");
 *  you may not use this file except in compliance with the License.
 *  You may obtain a copy of the License at
 *
 *         https://www.apache.org/licenses/LICENSE-2.0.txt
 *
 *  Unless required by applicable law or agreed to in writing, software
 *  distributed under the License is distributed on an "AS IS" BASIS,
 *  WITHOUT WARRANTIES OR CONDITIONS OF ANY KIND, either express or implied.
 *  See the License for the specific language governing permissions and
 *  limitations under the License.
 *
 *=========================================================================*/
#include "sensornoise/refined/PixelNoise.h"

#include "sensornoise/base/PixelUse.h"
#include "sensornoise/correlation/NoiseResiduals.h"
#include "sensornoise/refined/PixelsOfVariance.h"

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

namespace sensornoise
{

namespace
{
/** Sum of the squared coefficients from which areas are judged once more [1]. Set by hand: below, the scatter of their
 * means grows by less than a twentieth. */
constexpr double LeastSharedSquares = 1.1;

std::vector<std::uint8_t>
UsedPixels(const StaticVariance & variance)
{
  std::vector<std::uint8_t> used(variance.pixelUse.size());
  std::transform(variance.pixelUse.begin(), variance.pixelUse.end(), used.begin(), [](std::uint8_t use) {
    return static_cast<std::uint8_t>(use == static_cast<std::uint8_t>(PixelUse::Used) ? 1 : 0);
  });
  return used;
}

/** Part of the levels' range above black up to which the darkest may lie to be the zero of the light [1]: flat fields
 * have none that is near it. */
constexpr double DarkShare = 0.3;

/** The level from which light is measured. Where nothing tells it, the darkest: what is shared in proportion to the
 * variance is in proportion to the light above a level that is below. */
double
ZeroOfLight(const RefinedSettings & settings, const StillScene & scene, const SceneSeries & series, double blackDn)
{
  const double dark = scene.model.darkestDn;
  const bool   isTold = settings.offset.has_value() || series.isOffsetTold;
  return !isTold && dark - blackDn < DarkShare * (scene.model.brightestDn - blackDn) ? dark : blackDn;
}
} // namespace

PixelNoise
MeasurePixelNoise(ProjectedVariance &                      projected,
                  NoiseSample                              sample,
                  const StillScene &                       scene,
                  const std::optional<const SceneSeries> & series,
                  const RefinedSettings &                  settings,
                  double                                   codesDn2,
                  const ParallelFor &                      parallelFor)
{
  const double                    blackDn = BlackLevel(settings, scene, series);
  const double                    offsetDn = series->offset + scene.model.centreDn;
  std::vector<std::uint8_t>       pixelUse = scene.pixelUse;
  const std::vector<std::uint8_t> chosen = PixelsOfVariance(scene, settings, pixelUse);
  const auto                      fit = [&](double sharedSquares) {
    return FitStaticVariance(
      projected, chosen, pixelUse, scene.model.slopeDn, offsetDn, blackDn, parallelFor, sharedSquares);
  };
  PixelNoise noise{ fit(1.0), {} };
  if (!noise.variance.line.isDetermined)
  {
    return noise;
  }
  std::vector<std::uint8_t> used = UsedPixels(noise.variance);
  NoiseResiduals            residuals(std::move(sample),
                           series->basis.GetBasis(),
                                      { scene.frame.mean, used, ZeroOfLight(settings, scene, *series, blackDn) },
                           parallelFor);
  noise.correlation = MeasureNoiseCorrelation(residuals, codesDn2, parallelFor);
  const double sharedSquares = noise.correlation.SharedSquares();
  if (noise.correlation.IsShared() && sharedSquares > LeastSharedSquares)
  {
    noise.variance = fit(sharedSquares);
    used = UsedPixels(noise.variance);
    residuals.Take(used, parallelFor);
    noise.correlation = MeasureNoiseCorrelation(residuals, codesDn2, parallelFor);
  }
  MeasureSettledFrames(noise.correlation, residuals, codesDn2, parallelFor);
  return noise;
}

} // namespace sensornoise
