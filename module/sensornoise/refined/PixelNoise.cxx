// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/refined/PixelNoise.h"

#include "sensornoise/correlation/NoiseResiduals.h"
#include "sensornoise/refined/Constants.h"
#include "sensornoise/refined/PixelsOfVariance.h"
#include "sensornoise/report/StackReport.h"

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

namespace sensornoise
{

PixelNoise
MeasurePixelNoise(ProjectedVariance &                      projected,
                  FrameSample                              sample,
                  const StillScene &                       scene,
                  const std::optional<const SceneSeries> & series,
                  const RefinedSettings &                  settings,
                  double                                   codesDn2,
                  const ParallelFor &                      parallelFor)
{
  const double              blackDn = BlackLevel(settings, scene, series);
  const double              offsetDn = series->offset + scene.model.centreDn;
  std::vector<std::uint8_t> pixelUse = scene.pixelUse;
  std::vector<std::uint8_t> chosen = PixelsOfVariance(scene, settings, pixelUse);
  projected.SetIllumination(series->line.gamma, offsetDn);
  const auto fit = [&](double sharedSquares) {
    return FitStaticVariance(
      projected, chosen, pixelUse, scene.model.slopeDn, offsetDn, blackDn, parallelFor, sharedSquares);
  };
  PixelNoise noise{ fit(1.0), {} };
  if (!noise.variance.line.isDetermined)
  {
    return noise;
  }
  std::vector<std::uint8_t> used = MaskOfUsed(noise.variance.pixelUse);
  const bool                isTold = settings.offset.has_value() || series->isOffsetTold;
  const double   zeroDn = isTold ? blackDn : ZeroOfLight(scene.model.darkestDn, scene.model.brightestDn, blackDn);
  NoiseResiduals residuals(
    std::move(sample), series->basis.GetBasis(), { scene.frame.mean, used, zeroDn }, parallelFor);
  const auto allowForFrames = [&] {
    if (projected.HasUnequalFrames())
    {
      residuals.SetUnequalFrames({ series->line.gamma, noise.variance.line.gain, offsetDn - zeroDn });
    }
  };
  allowForFrames();
  noise.correlation = MeasureNoiseCorrelation(residuals, codesDn2, parallelFor);
  const double sharedSquares = SharedSquares(noise.correlation.space);
  if (noise.correlation.IsShared() && sharedSquares > InRefined.leastSharedSquares)
  {
    noise.variance = fit(sharedSquares);
    used = MaskOfUsed(noise.variance.pixelUse);
    residuals.Take(used, parallelFor);
    allowForFrames();
    noise.correlation = MeasureNoiseCorrelation(residuals, codesDn2, parallelFor);
    // What neighbours share is a mean over both sides of an edge, the line is not.
    LeaveOutEdges(scene.frame, noise.variance.line, chosen, pixelUse);
    noise.variance = fit(sharedSquares);
  }
  MeasureSettledFrames(noise.correlation, residuals, codesDn2, parallelFor);
  return noise;
}

} // namespace sensornoise
