// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "refined/GainReport.h"

#include "base/Constants.h"
#include "base/Eigen.h"
#include "base/Text.h"
#include "pixels/CodeNoise.h"
#include "pixels/Constants.h"
#include "pixels/GainByParts.h"
#include "pixels/FixedPatternEstimate.h"
#include "pixels/VarianceCurve.h"
#include "pixels/VarianceLine.h"
#include "pixels/VarianceStep.h"
#include "refined/Constants.h"
#include "refined/GainEstimate.h"
#include "report/Quantities.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

namespace sensornoise
{

namespace
{
/** Files the line, its curvature and its chi-square. */
void
FillFit(Report & report, const RefinedResults & found, const GainEstimate & gain)
{
  const VarianceLine & v = gain.isFromFrames ? gain.line : found.variance.line;
  report.fit.reducedChi2 = gain.reducedChi2;
  report.fit.curvature = v.curvature;
  report.fit.curvatureZ = v.curvatureSd > 0.0 ? v.curvature / v.curvatureSd : 0.0;
  report.fit.nonlinearity = gain.nonlinearity;
  report.fit.line = Report::Baseline{ 0.0, v.gain, v.intercept };
}

/** Returns the question whether frames and dark frames were exchanged, if the dark frames are brighter; else
 * \a otherwise. */
std::string
AskIfExchanged(const RefinedResults & found, const std::string & otherwise)
{
  const auto & known = found.settings.offset;
  if (!known || known->darkFrames == 0 || !(known->valueDn > found.scene.model.brightestDn))
  {
    return otherwise;
  }
  return "The dark frames are brighter than the frames, with " + Rounded(known->valueDn) + " DN against " +
         RoundedApart(found.scene.model.brightestDn, known->valueDn) + " DN: are they exchanged?";
}

/** Returns why the variance is not the variance of a sensor; empty: no reason was found. */
std::string
FindContradiction(const RefinedResults & found, const GainEstimate & gain)
{
  const std::string notRaw = ": the frames are not raw (gamma, compression), not linear";
  const bool        hasCodes = found.scene.summary.codes.clipHighDn.has_value();
  if (found.frameNoise.HasSeveralGroups())
  {
    const FrameNoise & noise = found.frameNoise;
    return "the noise variance of the frames does not follow their levels, " +
           (noise.scatter > 0.0
              ? "for half of them by more than " + PercentApart(noise.scatter, InRefined.leastUnlikeNoise)
              : "in groups (" + noise.Text(gain.line.gain) + "; the first frame is 0)") +
           " (expected at most " + Percent(InRefined.leastUnlikeNoise) +
           "): they have several gains or were processed differently. Measure the frames of each kind by themselves: "
           "--frames";
  }
  const double correction = gain.line.gain / std::max(1e-9, found.variance.line.gain);
  if (found.lines.remainingVariance > 0.0 &&
      std::abs(std::log(std::max(1e-9, correction))) > std::log(InRefined.largestCorrection))
  {
    return "the spatial noise correlation changes the gain by a factor of " +
           RoundedApart(std::max(correction, 1.0 / std::max(1e-9, correction)), InRefined.largestCorrection) +
           " (expected at most " + Rounded(InRefined.largestCorrection) +
           "), but changes of the illumination that are left correlate neighbours, too. Record more frames, or choose "
           "an evenly lit part at rest: --roi";
  }
  if (gain.nonlinearity > InRefined.largestNonlinearity)
  {
    return "the variance deviates from its line by " + PercentApart(gain.nonlinearity, InRefined.largestNonlinearity) +
           " of itself (expected less than " + Percent(InRefined.largestNonlinearity) + ")" + notRaw +
           (hasCodes ? ", or of several gains. Record raw frames, or fit the linear part alone: --level-range LOW,HIGH"
                     : ", or saturated. Record raw frames, or give the levels at which they saturate: --clip LOW,HIGH");
  }
  if (gain.isWide && gain.IsNonlinear() &&
      gain.above + gain.below > 2.0 * InCommon.largestRelativeError * gain.line.gain)
  {
    return "the variance is a curve of the mean, so that the gain depends on the assumed read noise and is between " +
           Rounded(gain.line.gain - gain.below) + " and " + Rounded(gain.line.gain + gain.above) + " DN/e-" + notRaw +
           ", or of several gains. Record raw frames";
  }
  if (!(gain.line.gain > 0.0))
  {
    return "the variance does not rise with the mean (slope " + Measured(gain.line.gain, gain.StandardError()) +
           " DN/e-, expected above 0): the frames are not raw, or have too little noise. " +
           AskIfExchanged(found, "Record raw frames");
  }
  return {};
}

/** Files the bounds of the gain by a known offset alone: the line passes the offset with a variance between 0 and the
 * lowest variance of the frames. */
void
FileGainBounds(Report & report, const RefinedResults & found, const GainEstimate & gain)
{
  const auto & known = found.settings.offset;
  const double light = known ? gain.line.pivotDn - known->valueDn : 0.0;
  if (known && !known->variance && light > 0.0)
  {
    const Eigen::Vector2d pivot(gain.line.pivotDn, 1.0);
    const double          atPivot = gain.line.intercept + gain.line.gain * gain.line.pivotDn;
    const double          error = 2.0 * std::sqrt(std::max(0.0, pivot.dot(gain.covariance * pivot)));
    const double          lowest = std::min(gain.line.At(found.scene.model.darkestDn), atPivot);
    report.gain.bracket = Interval{ std::max(0.0, atPivot - lowest - error) / light, (atPivot + error) / light };
  }
}

/** Returns which frames have most of the illumination, if the projection on flicker and motion removes nearly all noise
 * of these few frames; else an empty text. Estimator.md, 3.5. */
std::string
FindFewIlluminatedFrames(const RefinedResults & found)
{
  const Eigen::MatrixXd & basis = found.series.basis.GetBasis();
  const Eigen::Index      frames = basis.rows();
  const Eigen::VectorXd   illumination =
    (1.0 + Eigen::Map<const Eigen::VectorXd>(found.series.line.gamma.data(), frames).array()).max(0.0);
  const double          all = illumination.sum();
  const Eigen::VectorXd kept = (1.0 - 1.0 / static_cast<double>(frames)) - basis.cwiseAbs2().rowwise().sum().array();
  const double          left = illumination.dot(kept) / all * static_cast<double>(frames) / std::max(1e-9, kept.sum());
  std::vector<Eigen::Index> order(static_cast<std::size_t>(frames));
  std::iota(order.begin(), order.end(), Eigen::Index{ 0 });
  std::stable_sort(
    order.begin(), order.end(), [&](Eigen::Index a, Eigen::Index b) { return illumination(a) > illumination(b); });
  std::size_t count = 0;
  double      carried = 0.0;
  while (count < order.size() && carried < InPixels.fractionOfFewFrames * all)
  {
    carried += illumination(order[count++]);
  }
  if (left > 1.0 - InPixels.largestFeedback || 4 * count > order.size())
  {
    return {};
  }
  std::sort(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(count));
  std::string names;
  for (std::size_t i = 0; i < count; ++i)
  {
    names += (i == 0 ? "" : i + 1 == count ? " and " : ", ") + std::to_string(order[i]);
  }
  return (count == 1 ? "frame " + names + " alone carries " : "frames " + names + " carry ") + Percent(carried / all) +
         " of the illumination of " + std::to_string(frames) +
         " distinct frames (the first is 0): flicker and motion take up all but " +
         PercentApart(std::max(0.0, left), 1.0 - InPixels.largestFeedback) +
         " of their shot noise (expected at least " + Percent(1.0 - InPixels.largestFeedback) +
         "). The gain is not identifiable: record more frames with light";
}

/** Files that the gain, and with it every parameter of the sensor, is not identifiable, and warns why. */
void
FileNotIdentifiable(Report & report, const RefinedResults & found, const GainEstimate & gain)
{
  SetSensorParameters(report, EstimateStatus::NotIdentifiable);
  const double error = gain.StandardError();
  if (static_cast<double>(report.pixels.used) < InRefined.leastUsedFraction * found.scene.usable)
  {
    report.Warn(WarningCode::TooLittleToMeasure,
                PercentApart(static_cast<double>(report.pixels.used) / std::max(1.0, found.scene.usable),
                             InRefined.leastUsedFraction) +
                  " of the pixels that are not clipped fit a static scene (expected at least " +
                  Percent(InRefined.leastUsedFraction) + "), which would give a gain of " +
                  Measured(gain.line.gain, error) +
                  " DN/e-: the scene moves, or is too dark. Choose a static part of it (--roi), or more light");
    return;
  }
  FileGainBounds(report, found, gain);
  const std::string few = FindFewIlluminatedFrames(found);
  if (!few.empty())
  {
    report.Warn(WarningCode::TooLittleToMeasure, few);
    return;
  }
  const FixedPatternEstimate & pattern = found.variance.pattern;
  const double                 levels = std::sqrt(std::max(0.0, pattern.levelVarianceDn2));
  const bool                   hasDark = found.settings.offset && found.settings.offset->darkFrames > 0;
  report.Warn(
    WarningCode::IntensityRangeTooSmall,
    "the levels of the scene do not determine the gain: they differ by " + Rounded(levels) + " DN rms, " +
      Percent(levels / std::max(1e-9, gain.line.pivotDn - found.blackDn)) +
      " of the signal, and fixed-pattern noise may explain " + Percent(std::min(1.0, pattern.LargestFraction())) +
      " of that. The gain is known only to +- " + Rounded(error) + " of about " + Rounded(gain.scale) + " DN/e-. " +
      AskIfExchanged(
        found,
        hasDark ? "Record more frames, or include dark and bright areas in the scene"
                : "Record more frames, include dark and bright areas in the scene, or give dark frames (--dark)"));
}

/** Largest distances of the parts' gains below and above their mean, and their rms deviation, relative to it [1]. */
struct PartsRange
{
  double below{ 0.0 };
  double above{ 0.0 };
  double rms{ 0.0 };
};

std::string
AdviceOn(Divided divided)
{
  switch (divided)
  {
    case Divided::Phases:
      return "Measure the colours of a mosaic by themselves (--bayer), or the pixels of each amplifier (--mask)";
    case Divided::Frames:
      return "The camera changed while it recorded, or frames were processed: measure the parts by themselves "
             "(--frames)";
    case Divided::Places:
      break;
  }
  return "Measure the parts by themselves (--roi)";
}

/** Files the gains of the parts and warns of their differences. Phases are left out if the noise is correlated: where
 * frames were resampled, the variance depends on the phase, and not because of the gain. */
PartsRange
FillParts(Report & report, const RefinedResults & found, const GainEstimate & gain)
{
  PartsRange          range;
  const GainByParts & parts = found.variance.parts;
  for (const auto * const own : { &parts.places, &parts.phases, &parts.frames })
  {
    if (!*own || !(*own)->Differ() || (own == &parts.phases && found.correlation.IsCorrelated()))
    {
      continue;
    }
    const PartGains & gains = **own;
    const auto &      kind = KindOf(gains.partition);
    const double      pixels = std::accumulate(gains.pixels.begin(), gains.pixels.end(), 0.0);
    GainByPartsRecord record{ kind.name, {} };
    for (std::size_t k = 0; k < gains.excess.size(); ++k)
    {
      record.parts.push_back(
        { NameOfPart(gains.partition, k),
          gain.line.gain * (1.0 + gains.excess[k]),
          std::hypot(std::sqrt(gain.covariance(0, 0)) * (1.0 + gains.excess[k]), gain.line.gain * gains.error[k]),
          gains.pixels[k] / pixels });
    }
    const auto byGain = [](const auto & a, const auto & b) { return a.gain < b.gain; };
    const auto [lowest, highest] = std::minmax_element(record.parts.begin(), record.parts.end(), byGain);
    range.below += 1.0 - lowest->gain / gain.line.gain;
    range.above += highest->gain / gain.line.gain - 1.0;
    range.rms = std::hypot(range.rms, gains.size);
    report.Warn(WarningCode::GainNotUniform,
                std::string("the gain differs between ") + kind.words + ": from " +
                  Measured(lowest->gain, lowest->standardError) + " DN/e- (" + lowest->name + ") to " +
                  Measured(highest->gain, highest->standardError) + " DN/e- (" + highest->name + "), " +
                  PercentApart(gains.size, InParts.leastDifference) + " rms (expected at most " +
                  Percent(InParts.leastDifference) + "), and their mean is given. " + AdviceOn(kind.divided));
    report.gainByParts.push_back(std::move(record));
  }
  return range;
}

void
WarnOfStep(Report & report, const GainEstimate & gain)
{
  if (gain.step)
  {
    const VarianceStep & step = *gain.step;
    const double         below = step.line.At(step.levelDn);
    const double         larger = std::max({ 1e-9, below, below + step.sizeDn2 });
    report.Warn(
      WarningCode::VarianceSteps,
      "the variance steps by " + Measured(step.sizeDn2, step.errorDn2) + " DN^2 at " + Rounded(step.levelDn) + " DN, " +
        PercentApart(std::abs(step.sizeDn2) / larger, InSteps.leastSize) +
        " of the larger variance (expected less than " + Percent(InSteps.leastSize) +
        "), as where two amplifiers read the pixels; intercept and read noise are of the levels below. Measure "
        "either side by itself: --level-range");
  }
}

/** Files gain and intercept with intervals that contain the gains of all parts of the levels. */
void
FillGainAndIntercept(Report &               report,
                     const RefinedResults & found,
                     const GainEstimate &   gain,
                     double                 quantisationDn2,
                     double                 student)
{
  const CodeNoise & codes = found.variance.codeNoise;
  const PartsRange  parts = FillParts(report, found, gain);
  WarnOfStep(report, gain);
  const double error = std::sqrt(gain.covariance(0, 0));
  report.gain = WithError(gain.line.gain, std::hypot(gain.StandardError(), parts.rms * gain.line.gain), student);
  report.gain.interval95 =
    Interval{ gain.line.gain * (1.0 - parts.below) - gain.below - student * error * (1.0 - parts.below),
              gain.line.gain * (1.0 + parts.above) + gain.above + student * error * (1.0 + parts.above) };
  report.varianceSlope = report.gain;
  report.varianceSlope.value = gain.line.gain + codes.slopeDn;
  report.varianceSlope.interval95 =
    Interval{ *report.gain.interval95->low + codes.slopeDn, *report.gain.interval95->high + codes.slopeDn };
  // The value at the pivot is precise, so that an error of the gain changes the intercept in the opposite direction.
  const double interceptError =
    std::hypot(std::sqrt(gain.covariance(1, 1)), 0.5 * (gain.below + gain.above) * gain.line.pivotDn);
  report.totalIntercept = WithError(gain.line.intercept + codes.interceptDn2, interceptError, student);
  report.intercept = WithError(gain.line.intercept - quantisationDn2, interceptError, student);
  if (gain.nonlinearity > InRefined.leastNonlinearity && gain.IsNonlinear())
  {
    report.Warn(
      WarningCode::ResponseNotStraight,
      "the variance deviates from its line by up to " + PercentApart(gain.nonlinearity, InRefined.leastNonlinearity) +
        " of itself (expected at most " + Percent(InRefined.leastNonlinearity) +
        "): the response is non-linear, and the interval of the gain contains the gains of parts of the levels, " +
        Rounded(gain.line.gain - gain.below) + " to " + Rounded(gain.line.gain + gain.above) +
        " DN/e-. Fit a linear part alone: --level-range");
  }
}
} // namespace

bool
FillGain(Report &               report,
         const RefinedResults & found,
         const GainEstimate &   gain,
         double                 quantisationDn2,
         double                 student)
{
  FillFit(report, found, gain);
  const std::string contradiction = FindContradiction(found, gain);
  // If all levels are alike, parts of them differ by fixed-pattern noise, and not by a non-linear response.
  const double error = gain.isWide ? std::sqrt(gain.covariance(0, 0)) : gain.StandardError();
  const bool   isTooLittle = error > InCommon.largestRelativeError * gain.scale ||
                           static_cast<double>(report.pixels.used) < InRefined.leastUsedFraction * found.scene.usable;
  if (isTooLittle && !found.frameNoise.HasSeveralGroups() && !(gain.nonlinearity > InRefined.largestNonlinearity))
  {
    FileNotIdentifiable(report, found, gain);
    return false;
  }
  if (!contradiction.empty())
  {
    SetSensorParameters(report, EstimateStatus::Failed);
    report.Warn(WarningCode::VarianceNotAffine, contradiction);
    return false;
  }
  FillGainAndIntercept(report, found, gain, quantisationDn2, student);
  FileGainBounds(report, found, gain);
  return true;
}

void
WarnOfNarrowRange(Report & report, const RefinedResults & found, const GainEstimate & gain, const OffsetLimits & limits)
{
  const VarianceCurve & curve = found.variance.curve;
  const double          blackDn = report.offset.value.value_or(limits.rootDn);
  const bool            hasDark = found.settings.offset && found.settings.offset->variance;
  const bool            isTested = hasDark && gain.isLinearityTested && !gain.isDarkRejected;
  const double          inFrames = (found.InDarkestFrame(found.scene.model.centreDn) - blackDn) /
                          (found.InBrightestFrame(found.scene.model.centreDn) - blackDn);
  const double share = curve.DarkestFraction(blackDn) * (gain.isFromFrames ? std::max(0.0, inFrames) : 1.0);
  if (!isTested && share > InCommon.darkFraction)
  {
    report.Warn(WarningCode::ResponseUnchecked,
                "the darkest areas have " + PercentApart(share, InCommon.darkFraction) +
                  " of the signal of the brightest (expected at most " + Percent(InCommon.darkFraction) +
                  "), so that a non-linear response would not be noticed. " +
                  (hasDark ? "Include dark and bright areas in the scene, or record several exposures (--exposures)"
                           : "Give dark frames (--dark), or include dark areas in the scene"));
  }
}

} // namespace sensornoise
