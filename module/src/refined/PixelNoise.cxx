// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "refined/PixelNoise.h"

#include "sensornoise/Settings.h"
#include "correlation/FrameEnergies.h"
#include "correlation/LocalMotion.h"
#include "correlation/NoiseResiduals.h"
#include "correlation/LineLight.h"
#include "pixels/FlatPixels.h"
#include "refined/BeyondChance.h"
#include "refined/Constants.h"
#include "refined/FrameParts.h"
#include "refined/FramePhotonTransfer.h"
#include "refined/PixelsOfVariance.h"
#include "report/StackReport.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

namespace sensornoise
{

namespace
{
/** What the frames of the sample are compared by. */
struct FrameComparison
{
  const NoiseResiduals &    residuals;
  const ProjectedVariance & projected;
  const StillScene &        scene;
  TileLevels                levels;
  bool                      isLightLocal{ false }; ///< tiles differ in how their light changes

  /** Whether frames differ in their noise by as much as counts. */
  bool
  AreUnequal() const
  {
    return scene.changesStrongly || projected.HasUnequalFrames();
  }
};

/** The photon transfer of the frames, if they are unequal and tiles have the same changes of illumination. */
VarianceCurve
LineOfFrames(const StaticVariance & variance, const FrameComparison & by, const ParallelFor & parallelFor)
{
  if (!by.AreUnequal() || by.isLightLocal)
  {
    return {};
  }
  const std::vector<std::uint8_t> used = MaskOfUsed(variance.pixelUse);
  const auto                      count = static_cast<double>(std::count(used.begin(), used.end(), std::uint8_t{ 1 }));
  if (!(count > InRefined.leastUsedShare * static_cast<double>(by.scene.valid)))
  {
    return {};
  }
  return FitFramePhotonTransfer({ by.residuals, used, parallelFor }, by.levels, variance.line);
}

/** A line and the standard error of its slope. */
struct SlopeOfLine
{
  const VarianceLine & line;
  double               error;
};

/** The lines that are determined, of the frames and of the pixels, first the one whose slope is better known. */
std::vector<SlopeOfLine>
LinesByError(const StaticVariance & variance)
{
  const VarianceCurve & frames = variance.fromFrames;
  const auto   errorOf = [](const VarianceLine & line) { return std::sqrt(std::max(0.0, line.covariance(0, 0))); };
  const double ofPattern = variance.pattern.LargestShare() * variance.line.gain;
  const double ofPixels = std::hypot(errorOf(variance.line), ofPattern);
  const double chi2 = frames.ReducedChi2() / variance.sharedSquares;
  const double ofFrames =
    errorOf(frames.line) * std::sqrt(BeyondChance(chi2, static_cast<double>(frames.bins.size()) - 2.0));
  if (!frames.line.isDetermined)
  {
    return { { variance.line, ofPixels } };
  }
  return ofFrames < ofPixels ? std::vector<SlopeOfLine>{ { frames.line, ofFrames }, { variance.line, ofPixels } }
                             : std::vector<SlopeOfLine>{ { variance.line, ofPixels }, { frames.line, ofFrames } };
}

/** The line of which the slope is better known: that of the frames, or that of the pixels. */
const VarianceLine &
BetterLine(const StaticVariance & variance)
{
  return LinesByError(variance).front().line;
}

/** Whether frames move so little that nothing of it is left in their residuals. */
bool
IsNearlyStill(const FrameComparison & by)
{
  return std::max(by.scene.model.vibrationXPixels2, by.scene.model.vibrationYPixels2) < InRefined.smallVibration;
}

/** The frames whose noise is not that of the others. Frames of two gains that have two levels make a line of the frames
 * that fits them all; the line of the pixels then contradicts it. */
FrameNoise
CompareFrames(const StaticVariance &  variance,
              const FrameComparison & by,
              double                  sharedSquares,
              const ParallelFor &     parallelFor)
{
  // What is left of the motion of a frame is not its noise, and levels of tiles are not known under local light.
  const double least = std::max(IsNearlyStill(by) ? 0.0 : InRefined.leastUnlikeUnderMotion,
                                by.isLightLocal ? InRefined.leastUnlikeUnderLocalLight : InRefined.leastUnlikeNoise);
  const std::vector<std::uint8_t> used = MaskOfUsed(variance.pixelUse);
  const FrameEnergies             flat(by.residuals, MaskOfFlatClasses(by.projected, used, parallelFor), parallelFor);
  const double                    chance = std::sqrt(2.0 * sharedSquares / std::max(1.0, flat.Pixels().sum()));
  FrameNoise                      noise;
  for (const auto & [line, error] : LinesByError(variance))
  {
    noise = JudgeFrameNoise(NoiseOfFrames(flat, by.levels, line, error), chance, least);
    for (int round = 0; round < InRefined.roundsOfFrameNoise && noise.groups.size() > 1; ++round)
    {
      const Eigen::VectorXd known = noise.OfFrames(flat.Frames());
      noise = JudgeFrameNoise(NoiseOfFrames(flat, by.levels, line, error, known), chance, least);
    }
    noise.areFramesEqual = !by.AreUnequal();
    if (noise.HasSeveralKinds())
    {
      break;
    }
  }
  return noise;
}

/** Finds what looks like a filter and is none: places that move by themselves, and parts of frames that \a repeat. What
 * is left of the motion of whole frames has the slopes of the scene, too. */
void
NameOtherCauses(NoiseCorrelation &     correlation,
                const NoiseResiduals & residuals,
                double                 repeated,
                bool                   isNearlyStill,
                const ParallelFor &    parallelFor)
{
  if (!correlation.covarianceLines.empty() && isNearlyStill)
  {
    correlation.localMotion = FindLocalMotion(residuals, parallelFor);
    correlation.kind = correlation.HasLocalMotion() ? NoiseKind::NotLinear : correlation.kind;
  }
  const bool mayRepeat =
    correlation.kind == NoiseKind::Temporal || correlation.kind == NoiseKind::Enlarged || correlation.isOfIllumination;
  if (mayRepeat && repeated > InRefined.largestRepeatedShare)
  {
    correlation.kind = NoiseKind::NotLinear; // a filter blends values, and repeats none
    correlation.repeatedShare = repeated;
  }
}

/** The pixels by which the variance is measured. */
struct ChosenPixels
{
  std::vector<std::uint8_t> & chosen;
  std::vector<std::uint8_t> & pixelUse;
};

/** Takes off the illumination that rows or columns have of their own, where it counts; where the series of the
 * illumination are more than could be projected out (\a areSeriesLeft), wherever it is beyond chance. */
LineIllumination
AllowForLines(NoiseResiduals &     residuals,
              ProjectedVariance &  projected,
              const StillScene &   scene,
              const ChosenPixels & pixels,
              double               signalDn,
              bool                 areSeriesLeft,
              const ParallelFor &  parallelFor)
{
  LineIllumination lines;
  lines.found = FindLineLight(residuals, LineAxis::Rows, parallelFor);
  if (const MeasuredNumber ofColumns = FindLineLight(residuals, LineAxis::Columns, parallelFor);
      ofColumns.value * lines.found.standardError > lines.found.value * ofColumns.standardError)
  {
    lines.found = ofColumns;
    lines.axis = LineAxis::Columns;
  }
  const double least = areSeriesLeft ? 0.0 : InRefined.leastLineLight;
  const bool   counts = EffectOfLineLight(lines.found, signalDn, scene.model.slopeDn, least) > 0.0;
  if (counts && residuals.HasEnoughPixels())
  {
    TakeOffLineIllumination(lines, residuals, projected, pixels.chosen, pixels.pixelUse, parallelFor);
  }
  if (counts || areSeriesLeft)
  {
    lines.restOfVariance = RestOfIllumination(residuals, parallelFor);
  }
  return lines;
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
  const bool                isTold = settings.offset.has_value() || series->isOffsetTold;
  const double   zeroDn = isTold ? blackDn : ZeroOfLight(scene.model.darkestDn, scene.model.brightestDn, blackDn);
  const double   repeated = sample.RepeatedShare(chosen, scene.summary.codes.quantisationStepDn);
  NoiseResiduals residuals(
    std::move(sample), series->basis.GetBasis(), { scene.frame.mean, chosen, zeroDn, isTold }, parallelFor);
  LineIllumination lines;
  if (settings.rollingShutter != RollingShutter::Off)
  {
    lines = AllowForLines(residuals,
                          projected,
                          scene,
                          { chosen, pixelUse },
                          scene.model.brightestDn - blackDn,
                          series->local.beyond > 1.0,
                          parallelFor);
  }
  // Without levels that identify the offset no line of the pixels says how much of the noise is shot noise.
  projected.SetIllumination(series->line.gamma, offsetDn, !scene.changesStrongly || series->isOffsetTold);
  const auto fit = [&](double sharedSquares) {
    return FitStaticVariance(
      projected, chosen, pixelUse, scene.model.slopeDn, offsetDn, blackDn, parallelFor, sharedSquares);
  };
  PixelNoise noise{ fit(1.0), {}, {}, lines };
  if (!noise.variance.line.isDetermined)
  {
    return noise;
  }
  residuals.Take(MaskOfUsed(noise.variance.pixelUse), parallelFor);
  const FrameComparison comparison{ residuals,
                                    projected,
                                    scene,
                                    { series->line.gamma, offsetDn, zeroDn },
                                    series->local.series.cols() > 0 || lines.isTakenOff };
  const auto compare = [&] { noise.variance.fromFrames = LineOfFrames(noise.variance, comparison, parallelFor); };
  const auto allowForFrames = [&] {
    compare();
    if (comparison.AreUnequal())
    {
      residuals.SetUnequalFrames({ series->line.gamma, BetterLine(noise.variance).gain, offsetDn - zeroDn });
    }
  };
  allowForFrames();
  noise.correlation = MeasureNoiseCorrelation(residuals, codesDn2, parallelFor);
  const double sharedSquares = SharedSquares(noise.correlation.space);
  if (noise.correlation.IsShared() && sharedSquares > InRefined.leastSharedSquares)
  {
    noise.variance = fit(sharedSquares);
    residuals.Take(MaskOfUsed(noise.variance.pixelUse), parallelFor);
    allowForFrames();
    noise.correlation = MeasureNoiseCorrelation(residuals, codesDn2, parallelFor);
    // What neighbours share is a mean over both sides of an edge, the line is not.
    LeaveOutEdges(scene.frame, noise.variance.line, chosen, pixelUse);
    noise.variance = fit(sharedSquares);
  }
  const double shared = std::max(1.0, SharedSquares(noise.correlation.space));
  compare();
  noise.frames = CompareFrames(noise.variance, comparison, shared, parallelFor);
  if (!noise.frames.HasSeveralKinds() && !comparison.isLightLocal && IsNearlyStill(comparison))
  {
    const FrameEnergies energies(residuals, MaskOfUsed(noise.variance.pixelUse), parallelFor);
    noise.variance.parts.frames =
      CompareFrameParts(MakeFrameParts(energies, comparison.levels, { BetterLine(noise.variance), blackDn, shared }));
  }
  MeasureSettledFrames(noise.correlation, residuals, codesDn2, parallelFor);
  if (noise.correlation.kind != NoiseKind::NotMeasured)
  {
    noise.lines.left = FindLineLight(residuals, lines.axis, parallelFor);
  }
  NameOtherCauses(noise.correlation, residuals, repeated, IsNearlyStill(comparison), parallelFor);
  return noise;
}

} // namespace sensornoise
