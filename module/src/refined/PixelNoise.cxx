// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "refined/RefinedResults.h"

#include "correlation/ProcessingSigns.h"
#include "correlation/NoiseCorrelation.h"
#include "correlation/NoiseResiduals.h"
#include "moments/DarkFrames.h"
#include "base/Stencils.h"
#include "pixels/RoughnessClasses.h"
#include "refined/Constants.h"
#include "refined/FramePhotonTransfer.h"
#include "report/StackReport.h"
#include "sensornoise/Report.h"
#include "sensornoise/Settings.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

namespace sensornoise
{

double
BlackLevel(const RefinedSettings & settings, const StaticScene & scene, const std::optional<const SceneSeries> & series)
{
  if (settings.offset)
  {
    return settings.offset->valueDn;
  }
  if (series && series->isOffsetIdentifiable)
  {
    return std::min(series->offset + scene.model.centreDn, scene.model.darkestDn);
  }
  return std::min(scene.summary.dnRange.clipLowDn.value_or(0.0), scene.model.darkestDn);
}

std::vector<std::uint8_t>
PixelsOfVariance(const StaticScene & scene, const RefinedSettings & settings, std::vector<std::uint8_t> & pixelUse)
{
  std::vector<std::uint8_t> chosen = scene.frame.usable;
  const DarkMaps *          dark = settings.offset ? settings.offset->maps.get() : nullptr;
  const auto                leaveOut = [&](std::size_t p, PixelUse use) {
    chosen[p] = 0;
    pixelUse[p] = static_cast<std::uint8_t>(use);
  };
  for (std::size_t p = 0; p < chosen.size(); ++p)
  {
    const double level = scene.frame.neighbourMean[p];
    const auto & range = settings.levelRangeDn;
    if (chosen[p] != 0 && range && !(level >= range->lowDn && level <= range->highDn))
    {
      leaveOut(p, PixelUse::OutsideRange);
    }
    else if (chosen[p] != 0 && dark && dark->usable.size() == chosen.size() && dark->usable[p] == 0)
    {
      leaveOut(p, PixelUse::Outlier);
    }
  }
  return chosen;
}

void
LeaveOutEdges(const ReferenceFrame &      frame,
              const VarianceLine &        line,
              std::vector<std::uint8_t> & chosen,
              std::vector<std::uint8_t> & pixelUse)
{
  const auto        side = static_cast<double>(2 * StencilMargin + 1);
  const std::size_t width = frame.geometry.width;
  for (std::size_t p = 0; p < chosen.size(); ++p)
  {
    const std::size_t x = p % width;
    const std::size_t y = p / width;
    const bool        isInside =
      std::min(x, width - 1 - x) >= StencilMargin && std::min(y, frame.geometry.height - 1 - y) >= StencilMargin;
    if (chosen[p] == 0 || !isInside)
    {
      continue;
    }
    double sum = 0.0;
    for (std::size_t row = y - StencilMargin; row <= y + StencilMargin; ++row)
    {
      const double * const first = frame.mean.data() + row * width + x - StencilMargin;
      sum = std::accumulate(first, first + 2 * StencilMargin + 1, sum);
    }
    const double step = line.gain * (sum / (side * side) - frame.mean[p]);
    if (std::abs(step) > InRefined.largestEdge * line.At(frame.mean[p]))
    {
      chosen[p] = 0;
      pixelUse[p] = static_cast<std::uint8_t>(PixelUse::Edge);
    }
  }
}

namespace
{
/** Fractions of the sample that are copies [1]. */
struct Copies
{
  double pixels;  ///< see FrameSample::RepeatedFraction()
  double rows;    ///< see FrameSample::CopiedFraction()
  double columns; ///< see FrameSample::CopiedFraction()
};

/** Finds causes of correlation other than filters: local motion, and parts of frames that are \a copies. It does not
 * search for local motion if the whole scene moves, as the remaining motion of frames has the slopes of the scene, too.
 */
void
FindOtherCauses(NoiseCorrelation &     correlation,
                const NoiseResiduals & residuals,
                const Copies &         copies,
                bool                   movesLittle,
                const ParallelFor &    parallelFor)
{
  if (!correlation.covarianceLines.empty() && movesLittle)
  {
    correlation.localMotion = FindLocalMotion(residuals, parallelFor);
    correlation.kind = correlation.HasLocalMotion() ? NoiseKind::NotLinear : correlation.kind;
  }
  const bool mayRepeat = correlation.kind == NoiseKind::Temporal || correlation.kind == NoiseKind::Enlarged ||
                         correlation.isByIllumination || correlation.isBySensitivity;
  if (mayRepeat && copies.pixels > InRefined.largestRepeatedFraction)
  {
    correlation.kind = NoiseKind::NotLinear; // a filter blends values, and repeats none
    correlation.repeatedFraction = copies.pixels;
  }
  const double lines = std::max(copies.rows, copies.columns);
  if (correlation.kind != NoiseKind::NotMeasured && lines > InRefined.largestRepeatedFraction)
  {
    correlation.kind = NoiseKind::NotLinear;
    correlation.copiedFraction = lines;
    correlation.copiedAxis = copies.rows >= copies.columns ? LineAxis::Rows : LineAxis::Columns;
  }
}

/** Pixels by which the variance is measured: nonzero in \a chosen; \a pixelUse has the reasons for the others. */
struct ChosenPixels
{
  std::vector<std::uint8_t> & chosen;
  std::vector<std::uint8_t> & pixelUse;
};

/** Leaves out the pixels that are computed from their neighbours, and returns whether there are any. */
bool
LeaveOutInterpolated(const InterpolatedPixels & found, const ChosenPixels & pixels)
{
  for (const std::size_t p : found.pixels)
  {
    pixels.chosen[p] = 0;
    pixels.pixelUse[p] = static_cast<std::uint8_t>(PixelUse::Outlier);
  }
  return !found.pixels.empty();
}

/** Uses the pixels of \a variance in \a residuals, without those that are not compared with their neighbours. */
void
TakeCompared(NoiseResiduals &           residuals,
             const StaticVariance &     variance,
             const InterpolatedPixels & interpolated,
             const ParallelFor &        parallelFor)
{
  std::vector<std::uint8_t> used = MaskOfUsed(variance.pixelUse);
  interpolated.LeaveOutOf(used);
  residuals.Take(used, parallelFor);
}

/** Returns the fraction of the pixels of \a used that are not compared with their neighbours: outside the tiles of \a
 * residuals, or on their borders [1]. */
double
FractionNotCompared(const std::vector<std::uint8_t> & used, const NoiseResiduals & residuals)
{
  const auto all = static_cast<double>(std::count_if(used.begin(), used.end(), [](auto own) { return own != 0; }));
  return 1.0 - std::min(1.0, static_cast<double>(residuals.GetNumberOfPixels()) / std::max(1.0, all));
}

/** Returns StaticVariance::lostVariance. \a notCompared is the result of FractionNotCompared(). */
double
LostVariance(const InterpolatedPixels & interpolated, double notCompared, const NoiseCorrelation & correlation)
{
  const double ofFrames = correlation.kind == NoiseKind::Temporal ? 0.0 : correlation.timeFactor.standardError;
  // Details of the scene that may change, and a pixel has in common with each of four neighbours.
  const double ofDetails = correlation.DetailsChange() ? 0.0 : 0.25 * correlation.brightCovariance.value;
  return AddInQuadrature(interpolated.lostVariance * notCompared, ofFrames, ofDetails);
}

/** The illumination that is specific to rows or columns, and the squares without it. */
struct AllowedLines
{
  LineIllumination lines;
  ReplacedSquares  replaced;
};

/** Subtracts the illumination that is specific to rows or columns if its effect exceeds
 * InRefined.leastLineIllumination. If some temporal components of the illumination could not be projected out (\a
 * areSeriesLeft), subtracts it wherever it is significant. */
AllowedLines
AllowForLines(NoiseResiduals &     residuals,
              const StaticScene &  scene,
              const ChosenPixels & pixels,
              double               signalDn,
              bool                 areSeriesLeft,
              const ParallelFor &  parallelFor)
{
  AllowedLines       allowed;
  LineIllumination & lines = allowed.lines;
  lines.found = EstimateLineIlluminationChange(residuals, LineAxis::Rows, parallelFor);
  if (const MeasuredNumber ofColumns = EstimateLineIlluminationChange(residuals, LineAxis::Columns, parallelFor);
      ofColumns.value * lines.found.standardError > lines.found.value * ofColumns.standardError)
  {
    lines.found = ofColumns;
    lines.axis = LineAxis::Columns;
  }
  const double least = areSeriesLeft ? 0.0 : InRefined.leastLineIllumination;
  const bool   counts = EffectOfLineIllumination(lines.found, signalDn, scene.model.slopeDn, least) > 0.0;
  if (counts && residuals.HasEnoughPixels())
  {
    allowed.replaced = SubtractLineIllumination(
      lines, residuals, scene.frame.geometry.width, pixels.chosen, pixels.pixelUse, parallelFor);
  }
  if (counts || areSeriesLeft)
  {
    lines.remainingVariance = RestOfIllumination(residuals, parallelFor);
  }
  return allowed;
}

ProjectedSquares
ProjectSquares(ResidualSquares           squares,
               const StaticScene &       scene,
               const SceneSeries &       series,
               const ReplacedSquares &   replaced,
               const QuantisationNoise & quantisationNoise,
               const ParallelFor &       parallelFor)
{
  // If the levels do not identify the offset, no line of the pixels determines the fraction of shot noise.
  const FrameIllumination illumination{ series.line.gamma,
                                        series.offset + scene.model.centreDn,
                                        !scene.changesStrongly || series.isOffsetIdentifiable };
  return { scene.frame,        series.basis, series.motion, std::move(squares), scene.model,
           scene.frame.usable, parallelFor,  illumination,  replaced,           quantisationNoise };
}

/** Returns the gain by which the variances are corrected before the first line [DN/e-]. The initial model contains the
 * variance of the illumination, except under strong changes that are uniform: its gain may be thousands of times too
 * large, and would make the corrected variances negative. A gain of 0 changes them by a few per cent. */
double
FirstGain(const StaticScene & scene, const SceneSeries & series)
{
  return scene.changesStrongly && !series.local.IsLocal() ? scene.model.slopeDn : 0.0;
}

/** Compares the gains of single frames. If \a parts do not describe their differences, these are reset. If they do,
 * returns no differences. */
GainsOfFrames
CompareSingleFrames(std::optional<PartGains> & parts,
                    const FrameEnergies &      energies,
                    const TileLevels &         levels,
                    const PartReference &      reference,
                    double                     slopeError)
{
  const bool            areParts = parts && parts->Differ();
  const Eigen::VectorXd known = areParts ? ExcessOfFrames(*parts, energies.Frames()) : Eigen::VectorXd();
  GainsOfFrames         gains = CompareGainsOfFrames(energies, levels, reference, slopeError, known);
  if (!gains.Differ())
  {
    return {};
  }
  parts.reset();
  return areParts ? CompareGainsOfFrames(energies, levels, reference, slopeError) : std::move(gains);
}

/** Compares the noise of the frames and, if it does not differ, of their parts at their \a levels. Frames of several
 * scenes are not comparable: their line and their groups are dropped. */
void
MeasureFrames(PixelNoise &            noise,
              const FrameComparison & by,
              const TileLevels &      levels,
              double                  blackDn,
              bool                    isOneScene,
              const ParallelFor &     parallelFor)
{
  const double shared = std::max(1.0, VarianceInflation(noise.correlation.space));
  noise.variance.fromFrames = LineOfFrames(noise.variance, by, parallelFor);
  noise.frames = CompareFrames(noise.variance, by, noise.correlation, parallelFor);
  // Components of noise that is correlated in time may be taken for local illumination.
  const bool isNoise = by.isIlluminationLocal && noise.correlation.kind == NoiseKind::Temporal;
  if (!noise.frames.HasSeveralGroups() && by.areLevelsKnown && !isNoise && MovesLittle(by.scene.model))
  {
    const std::vector<std::uint8_t> used = MaskOfUsed(noise.variance.pixelUse);
    const SlopeOfLine               slope = BetterLine(noise.variance);
    const PartReference             reference{ slope.line, blackDn, shared };
    std::optional<PartGains> &      parts = noise.variance.parts.frames;
    parts = CompareFrameParts(MakeFrameParts(FrameEnergies(by.residuals, used, parallelFor), levels, reference));
    if (noise.correlation.kind != NoiseKind::Temporal && !by.AreUnequal())
    {
      noise.frames.gains =
        CompareSingleFrames(parts,
                            { by.residuals, MaskOfFlatClasses(by.squares, used, parallelFor), parallelFor },
                            levels,
                            reference,
                            slope.error);
    }
  }
  if (!isOneScene)
  {
    noise.variance.fromFrames = {};
    noise.frames = {};
  }
}

/** Returns what is left of the illumination of single lines; as it was if the noise was not measured. */
MeasuredNumber
LinesLeft(const PixelNoise & noise, const NoiseResiduals & residuals, const ParallelFor & parallelFor)
{
  return noise.correlation.kind == NoiseKind::NotMeasured
           ? noise.lines.left
           : EstimateLineIlluminationChange(residuals, noise.lines.axis, parallelFor);
}

/** Subtracts waves of the frequencies that the dark frames have from \a residuals, so that their variance is measured,
 * however small. */
void
SubtractWavesOfDarkFrames(NoiseResiduals & residuals, const RefinedSettings & settings, const ParallelFor & parallelFor)
{
  if (settings.offset && settings.offset->structured)
  {
    for (const WaveFrequency & wave : settings.offset->structured->waves)
    {
      residuals.SubtractWave(wave, parallelFor);
    }
  }
}
} // namespace

PixelNoise
MeasurePixelNoise(ResidualSquares                          squares,
                  FrameSample                              sample,
                  const std::vector<std::size_t> &         frameNumbers,
                  const StaticScene &                      scene,
                  const std::optional<const SceneSeries> & series,
                  const RefinedSettings &                  settings,
                  const QuantisationNoise &                quantisationNoise,
                  bool                                     isOneScene,
                  bool                                     keepsSample,
                  const ParallelFor &                      parallelFor)
{
  const double              quantisationDn2 = quantisationNoise.darkVarianceDn2;
  const double              blackDn = BlackLevel(settings, scene, series);
  const double              offsetDn = series->offset + scene.model.centreDn;
  std::vector<std::uint8_t> pixelUse = scene.pixelUse;
  std::vector<std::uint8_t> chosen = PixelsOfVariance(scene, settings, pixelUse);
  const bool                isIdentifiable = settings.offset.has_value() || series->isOffsetIdentifiable;
  const double              zeroDn =
    isIdentifiable ? blackDn : ZeroOfSignal(scene.model.darkestDn, scene.model.brightestDn, blackDn);
  const Copies   copies{ sample.RepeatedFraction(chosen, scene.summary.dnRange.quantisationStepDn),
                       sample.CopiedFraction(chosen, LineAxis::Rows),
                       sample.CopiedFraction(chosen, LineAxis::Columns) };
  NoiseResiduals residuals(
    std::move(sample), series->basis.GetBasis(), { scene.frame.mean, chosen, zeroDn, isIdentifiable }, parallelFor);
  const bool         isRolling = settings.rollingShutter != RollingShutter::Off;
  const double       signalDn = scene.model.brightestDn - blackDn;
  const AllowedLines allowed =
    isRolling ? AllowForLines(residuals, scene, { chosen, pixelUse }, signalDn, series->local.beyond > 1.0, parallelFor)
              : AllowedLines();
  ProjectedSquares projected =
    ProjectSquares(std::move(squares), scene, *series, allowed.replaced, quantisationNoise, parallelFor);
  const double firstGain = FirstGain(scene, *series);
  const auto   fit = [&](double varianceInflation) {
    StaticVariance variance =
      FitStaticVariance(projected, chosen, pixelUse, firstGain, offsetDn, blackDn, parallelFor, varianceInflation);
    variance.quantisationNoise = quantisationNoise;
    return variance;
  };
  PixelNoise noise{ fit(1.0), {}, {}, allowed.lines, PixelMap(), {} };
  if (!noise.variance.line.isDetermined)
  {
    return noise;
  }
  InterpolatedPixels interpolated;
  const auto         take = [&] { TakeCompared(residuals, noise.variance, interpolated, parallelFor); };
  take();
  interpolated = FindInterpolatedPixels(residuals, parallelFor);
  if (LeaveOutInterpolated(interpolated, { chosen, pixelUse }))
  {
    noise.variance = fit(1.0);
    take();
  }
  const FrameComparison comparison{ residuals,
                                    projected,
                                    scene,
                                    { series->line.gamma, offsetDn, zeroDn },
                                    series->local.IsLocal() || allowed.lines.isSubtracted,
                                    series->local.beyond <= 1.0 && !allowed.lines.isSubtracted };
  const auto            allowForFrames = [&] {
    noise.variance.fromFrames = LineOfFrames(noise.variance, comparison, parallelFor);
    residuals.SetUnequalFrames({ series->line.gamma, BetterLine(noise.variance).line.gain, offsetDn - zeroDn });
  };
  allowForFrames();
  SubtractWavesOfDarkFrames(residuals, settings, parallelFor);
  residuals.SetTimes(FindFrameTimes(residuals, frameNumbers, parallelFor));
  noise.correlation = MeasureWithoutInterference(residuals, quantisationDn2, parallelFor);
  const double varianceInflation = VarianceInflation(noise.correlation.space);
  if (noise.correlation.IsCorrelated() && varianceInflation > InRefined.leastVarianceInflation)
  {
    noise.variance = fit(varianceInflation);
    take();
    allowForFrames();
    noise.correlation = MeasureWithoutInterference(residuals, quantisationDn2, parallelFor);
    // Near an edge, the spatial covariance is a mean over both sides, and the pixel's variance is not on the line.
    LeaveOutEdges(scene.frame, noise.variance.line, chosen, pixelUse);
    noise.variance = fit(varianceInflation);
  }
  noise.variance.interpolatedFraction = interpolated.fraction;
  const bool isLocal = series->local.IsLocal();
  MeasureFrames(noise, comparison, { series->line.gamma, offsetDn, zeroDn, isLocal }, blackDn, isOneScene, parallelFor);
  MeasureSettledFrames(noise.correlation, residuals, quantisationDn2, parallelFor);
  noise.variance.lostVariance = LostVariance(interpolated, FractionNotCompared(chosen, residuals), noise.correlation);
  noise.lines.left = LinesLeft(noise, residuals, parallelFor);
  noise.sampled = keepsSample ? SampledNoise(residuals) : SampledNoise();
  FindOtherCauses(noise.correlation, residuals, copies, MovesLittle(comparison.scene.model), parallelFor);
  noise.correctedVariance = std::move(projected).TakeVarianceAt(noise.variance.correctingGain);
  return noise;
}

} // namespace sensornoise
