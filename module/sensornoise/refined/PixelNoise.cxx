// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/refined/PixelNoise.h"

#include "sensornoise/correlation/FrameEnergies.h"
#include "sensornoise/correlation/NoiseResiduals.h"
#include "sensornoise/pixels/Constants.h"
#include "sensornoise/refined/Constants.h"
#include "sensornoise/refined/FramePhotonTransfer.h"
#include "sensornoise/refined/PixelsOfVariance.h"
#include "sensornoise/report/StackReport.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

namespace sensornoise
{

namespace
{
/** The used pixels of the flatter classes, in which motion that the series leave makes next to no residuals. */
std::vector<std::uint8_t>
FlatPixels(const ProjectedVariance & projected, const std::vector<std::uint8_t> & used)
{
  const auto                last = static_cast<std::uint8_t>(InPixels.flatShare * ProjectedVariance::Classes);
  std::vector<std::uint8_t> flat(used.size());
  for (std::size_t p = 0; p < flat.size(); ++p)
  {
    flat[p] = used[p] != 0 && projected.ClassOf(p) <= last ? 1 : 0;
  }
  return flat;
}

double
ErrorOfSlope(const VarianceLine & line)
{
  return std::sqrt(std::max(0.0, line.covariance(0, 0)));
}

/** What the frames of the sample are compared by. */
struct FrameComparison
{
  const NoiseResiduals &    residuals;
  const ProjectedVariance & projected;
  const StillScene &        scene;
  TileLevels                levels;
  bool                      isLightLocal; ///< tiles differ in how their light changes
};

/** The photon transfer of the frames, if they are unequal, and the frames whose noise is not that of the others. */
void
CompareFrames(PixelNoise & noise, const FrameComparison & by, const ParallelFor & parallelFor)
{
  const std::vector<std::uint8_t> used = MaskOfUsed(noise.variance.pixelUse);
  const auto                      count = static_cast<double>(std::count(used.begin(), used.end(), std::uint8_t{ 1 }));
  const double                    shared = std::max(1.0, SharedSquares(noise.correlation.space));
  StaticVariance &                variance = noise.variance;
  const bool                      areUnequal = by.scene.changesStrongly || by.projected.HasUnequalFrames();
  if (areUnequal && !by.isLightLocal && count > InRefined.leastUsedShare * static_cast<double>(by.scene.valid))
  {
    const FrameEnergies ofAll(by.residuals, used, parallelFor);
    variance.fromFrames = FitFramePhotonTransfer(ofAll, by.levels, variance.line, shared);
  }
  const double vibration = std::max(by.scene.model.vibrationXPixels2, by.scene.model.vibrationYPixels2);
  if (vibration > InRefined.smallVibration)
  {
    return; // what is left of the motion of a frame is not its noise
  }
  const double        ofPattern = variance.pattern.LargestShare() * variance.line.gain;
  const double        ofPixels = std::hypot(ErrorOfSlope(variance.line), ofPattern);
  const bool          isBetter = variance.fromFrames.isDetermined && ErrorOfSlope(variance.fromFrames) < ofPixels;
  const FrameEnergies flat(by.residuals, FlatPixels(by.projected, used), parallelFor);
  const auto          ratios = NoiseOfFrames(flat,
                                    by.levels,
                                    isBetter ? variance.fromFrames : variance.line,
                                    isBetter ? ErrorOfSlope(variance.fromFrames) : ofPixels);
  noise.frames = JudgeFrameNoise(ratios,
                                 std::sqrt(2.0 * shared / std::max(1.0, flat.Pixels().sum())),
                                 by.isLightLocal ? InRefined.leastUnlikeUnderLocalLight : InRefined.leastUnlikeNoise);
}
} // namespace

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
  PixelNoise noise{ fit(1.0), {}, {} };
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
  CompareFrames(
    noise,
    { residuals, projected, scene, { series->line.gamma, offsetDn, zeroDn }, series->local.series.cols() > 0 },
    parallelFor);
  MeasureSettledFrames(noise.correlation, residuals, codesDn2, parallelFor);
  return noise;
}

} // namespace sensornoise
