// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "single/ImageNoise.h"

#include "base/ChiSquare.h"
#include "base/Constants.h"
#include "base/Text.h"
#include "report/StackReport.h"
#include "report/Quantities.h"
#include "sensornoise/SingleImageMethod.h"
#include "single/Constants.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sensornoise
{
namespace
{
/** Sums over all frames. */
struct AllFrames
{
  double                finite{ 0.0 };
  double                even{ 0.0 };
  DetailCorrelation     correlation;
  std::vector<LevelSet> diagonal;
  std::vector<LevelSet> sides;
};

AllFrames
Gather(const std::vector<std::optional<ImageNoise>> & frames)
{
  AllFrames all;
  for (const auto & frame : frames)
  {
    if (frame)
    {
      all.finite += frame->finite;
      all.even += frame->even;
      all.correlation.Add(frame->correlation);
      all.diagonal.insert(all.diagonal.end(), frame->diagonal.begin(), frame->diagonal.end());
      all.sides.insert(all.sides.end(), frame->sides.begin(), frame->sides.end());
    }
  }
  return all;
}

std::optional<SingleImageRecord::Line>
LineOf(const NoiseLine & line)
{
  if (!line.isDetermined)
  {
    return std::nullopt;
  }
  return SingleImageRecord::Line{
    line.line.slopeDn, std::sqrt(line.slopeVariance), line.InterceptDn2(), std::sqrt(line.InterceptVariance())
  };
}

/** Stores the variance of the sides over the variance of the diagonals, less 1, in the level sets of the line. */
void
FillBandExcess(SingleImageRecord & record, const AllFrames & all, const NoiseLine & line)
{
  double weights = 0.0;
  double sides = 0.0;
  double diagonals = 0.0;
  for (std::size_t i = 0; i < all.diagonal.size(); ++i)
  {
    if (line.isFitted[i])
    {
      const double weight = all.diagonal[i].details / line.expectedDn2[i];
      weights += all.diagonal[i].details;
      diagonals += weight * all.diagonal[i].varianceDn2;
      sides += weight * all.sides[i].varianceDn2;
    }
  }
  record.bandExcess = diagonals > 0.0 ? sides / diagonals - 1.0 : 0.0;
  // relative error of the diagonals, and of twice as many sides
  record.bandExcessStandardError = weights > 0.0 ? std::sqrt(1.5 * TruncatedVariance / weights) : 0.0;
}

/** Scatter of the slopes of the frames about their weighted mean, in units of their errors. */
std::optional<double>
ScatterOf(const std::vector<std::optional<SingleImageRecord::Line>> & lines, double & dof)
{
  double weights = 0.0;
  double sum = 0.0;
  double squares = 0.0;
  dof = -1.0;
  for (const auto & line : lines)
  {
    if (line && line->slopeStandardError > 0.0)
    {
      const double weight = 1.0 / (line->slopeStandardError * line->slopeStandardError);
      weights += weight;
      sum += weight * line->slope;
      squares += weight * line->slope * line->slope;
      dof += 1.0;
    }
  }
  return dof >= 1.0 ? std::optional<double>(std::max(0.0, squares - sum * sum / weights) / dof) : std::nullopt;
}

SingleImageRecord
MakeRecord(const SingleImageFindings & found, const AllFrames & all, NoiseLine & line)
{
  SingleImageRecord record;
  record.evenFraction = all.finite > 0.0 ? all.even / all.finite : 0.0;
  for (const auto & frame : found.frames)
  {
    record.frames.push_back(frame ? LineOf(frame->line) : std::nullopt);
  }
  FillBandExcess(record, all, line);
  if (found.meanImage)
  {
    record.meanImage = LineOf(*found.meanImage);
  }
  double dof = 0.0;
  record.frameReducedChi2 = ScatterOf(record.frames, dof);
  constexpr double level = 0.01;
  if (record.frameReducedChi2 && ChiSquareUpper(*record.frameReducedChi2 * dof, dof) < level)
  {
    line.slopeVariance *= *record.frameReducedChi2;
    line.centreVariance *= *record.frameReducedChi2;
    line.slopeCovariance *= *record.frameReducedChi2;
  }
  return record;
}

void
DescribeFrames(Report & report, const SingleImageFindings & found, const AllFrames & all)
{
  report.method = "single-image";
  NoteDnSettings(report, found.settings.dnSettings);
  report.frames = found.frames.size();
  report.framesDistinct = report.frames;
  report.width = found.geometry.width;
  report.height = found.geometry.height;
  report.bitDepth = found.dnRange.bitDepth;
  report.bitDepthSource = found.dnRange.bitDepthSource;
  if (found.dnRange.quantisationStepDn > 0.0)
  {
    report.quantisationStepDn = found.dnRange.quantisationStepDn;
  }
  report.clipLowDn = found.dnRange.clipLowDn;
  report.clipHighDn = found.dnRange.clipHighDn;
  report.clipSource = found.dnRange.clipSource;
  report.pixels.total = found.geometry.Pixels();
  report.pixels.notFinite = found.notFinite;
  report.pixels.clipped = found.clipped;
  report.pixels.valid = report.pixels.total - report.pixels.notFinite - report.pixels.clipped - found.masked;
  const double evenFraction = all.finite > 0.0 ? all.even / all.finite : 0.0;
  report.pixels.used = static_cast<std::size_t>(evenFraction * static_cast<double>(report.pixels.valid));
  SetSensorParameters(report, EstimateStatus::Failed);
  for (Quantity * const quantity :
       { &report.flickerSd, &report.vibrationSdX, &report.vibrationSdY, &report.vibrationCovariance })
  {
    *quantity = Quantity::Without(EstimateStatus::NotIdentifiable);
  }
}

/** Returns the evidence of texture as text; empty: there is no evidence. */
std::string
SignsOfTexture(const SingleImageRecord & record, const NoiseLine & line, const DetailCorrelation::Lag & correlation)
{
  const double slopeError = std::sqrt(line.slopeVariance) / std::max(std::abs(line.line.slopeDn), 1e-300);
  std::string  text;
  const auto   add = [&text](const std::string & sign) { text += (text.empty() ? "" : "; ") + sign; };
  if (record.evenFraction < InSingle.leastEvenFraction ||
      (record.evenFraction < InSingle.leastEvenFractionIfUncertain && slopeError > InSingle.largestErrorInTexture))
  {
    add("only " + Percent(record.evenFraction) + " of the frame is even");
  }
  if (record.bandExcess > InSingle.largestBandExcess + Significance.oneTest * record.bandExcessStandardError)
  {
    add("horizontal and vertical details have " + Percent(record.bandExcess) +
        " more variance than diagonal ones (expected at most " + Percent(InSingle.largestBandExcess) + ")");
  }
  if (std::abs(correlation.value) >
      InSingle.largestDetailCorrelation + Significance.oneTest * correlation.standardError)
  {
    const auto pixels = [](int lag) { return std::to_string(2 * lag); };
    add("details " + pixels(correlation.x) + " columns and " + pixels(correlation.y) + " rows apart correlate by " +
        Rounded(correlation.value) + " (expected at most " + Rounded(InSingle.largestDetailCorrelation) + " in size)");
  }
  if (line.reducedChi2 > InSingle.largestReducedChi2)
  {
    add("the variance scatters about its line " + RoundedApart(line.reducedChi2, InSingle.largestReducedChi2) +
        " times as much as by chance (expected at most " + Rounded(InSingle.largestReducedChi2) + ")");
  }
  if (record.meanImage && record.frames.size() > 1)
  {
    // Noise that does not average out is T times as large in the mean image times T as in a frame.
    const auto   frames = static_cast<double>(record.frames.size());
    const double part = (record.meanImage->slope / line.line.slopeDn - 1.0) / (frames - 1.0);
    const double error =
      std::hypot(record.meanImage->slopeStandardError / line.line.slopeDn, slopeError) / (frames - 1.0);
    if (part > InSingle.largestFixedPart && part > Significance.oneTest * error)
    {
      add(Percent(part) + " of the gain of single frames does not average out in their mean (expected at most " +
          Percent(InSingle.largestFixedPart) + ")");
    }
  }
  return text;
}

void
FillParameters(Report & report, const SingleImageFindings & found, const NoiseLine & line)
{
  const double slopeError = std::sqrt(line.slopeVariance);
  const double interceptError = std::sqrt(line.InterceptVariance());
  const double stepDn = found.dnRange.quantisationStepDn;
  report.varianceSlope = WithError(line.line.slopeDn, slopeError);
  report.gain = report.varianceSlope;
  report.totalIntercept = WithError(line.InterceptDn2(), interceptError);
  report.intercept = WithError(line.InterceptDn2() - stepDn * stepDn / 12.0, interceptError);
  for (Quantity * const quantity : { &report.offset, &report.readNoise, &report.readNoiseElectrons })
  {
    *quantity = Quantity::Without(EstimateStatus::NotIdentifiable);
  }
  constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  const double     covariance = line.InterceptCovariance();
  report.covariance = { { { line.slopeVariance, covariance, unknown },
                          { covariance, line.InterceptVariance(), unknown },
                          { unknown, unknown, unknown } } };
  report.fit.reducedChi2 = line.reducedChi2;
  report.fit.line = Report::Baseline{ 0.0, line.line.slopeDn, line.InterceptDn2() };
  report.Warn(WarningCode::LineOnly,
              "a single image determines only slope and intercept of the variance: offset and read noise are not "
              "identifiable. Record a burst under changing illumination, or dark frames, and use --method refined");
}

/** Fills in the level sets of the first frame that has some. The level sets of all frames could be thousands. */
void
FillLevelSets(Report & report, const std::vector<std::optional<ImageNoise>> & frames)
{
  const auto first = std::find_if(frames.begin(), frames.end(), [](const auto & frame) { return frame.has_value(); });
  if (first == frames.end())
  {
    return;
  }
  for (std::size_t i = 0; i < (*first)->diagonal.size(); ++i)
  {
    const LevelSet & set = (*first)->diagonal[i];
    if ((*first)->line.isFitted[i])
    {
      report.scatter.mean.push_back(set.levelDn);
      report.scatter.variance.push_back(set.varianceDn2);
      report.scatter.correctedVariance.push_back(set.varianceDn2);
      report.scatter.count.push_back(static_cast<std::size_t>(set.details));
    }
  }
}

/** Returns the number of details that were found, and the number of details in the lines of the frames. The latter are
 * in level sets that are large enough, and mostly between the clip levels by the last line that was tried. */
std::string
ReasonOfFewDetails(const SingleImageFindings & found)
{
  double      details = 0.0;
  double      inSets = 0.0;
  std::size_t sets = 0;
  for (const auto & frame : found.frames)
  {
    for (std::size_t i = 0; frame && i < frame->diagonal.size(); ++i)
    {
      const bool isFitted = frame->line.isFitted[i];
      details += frame->diagonal[i].details;
      inSets += isFitted ? frame->diagonal[i].details : 0.0;
      sets += isFitted ? 1 : 0;
    }
  }
  const auto count = [](double number) { return std::to_string(std::llround(number)); };
  return "even areas have " + count(details) + " detail coefficients, and " + count(inSets) + " of them, in " +
         std::to_string(sets) + (sets == 1 ? " level set" : " level sets") +
         ", are left for the line (expected at least " + count(InSingle.leastCoefficients) + " in " +
         std::to_string(InCommon.fewestLevels) +
         "): texture and edges fill the frame, the noise was filtered, or the frame has one level. Include even areas "
         "from dark to bright, or use --method refined with a burst";
}

/** Returns the reason why there is no line, or why its numbers are not valid; "": they are valid. */
std::string
ReasonAgainst(Report & report, const SingleImageFindings & found, const AllFrames & all, const NoiseLine & line)
{
  if (!found.reason.empty())
  {
    return found.reason;
  }
  double hidden = 0.0;
  for (std::size_t i = 0; i < line.isFitted.size(); ++i)
  {
    const double stepDn = found.dnRange.quantisationStepDn;
    hidden += line.isFitted[i] && line.expectedDn2[i] < InCommon.hiddenVariance * stepDn * stepDn
                ? all.diagonal[i].details
                : 0.0;
  }
  constexpr double largestHidden = 0.2; // fraction of the details, as of the pixels of a burst
  if (line.details > 0.0 && hidden > largestHidden * line.details)
  {
    report.Warn(WarningCode::CodesTooCoarse,
                "the noise of " + Percent(hidden / line.details) +
                  " of the even areas is below half the quantization step (expected at most " + Percent(largestHidden) +
                  "). Use more bits, or a higher analogue gain");
    return "the quantization step hides the noise. Use more bits, or a higher analogue gain";
  }
  return line.isDetermined && line.details >= InSingle.leastCoefficients ? "" : ReasonOfFewDetails(found);
}
} // namespace

NoiseLine
FitAllFrames(const std::vector<std::optional<ImageNoise>> & frames, const LevelLimits & limits)
{
  const AllFrames all = Gather(frames);
  const auto      first =
    std::find_if(frames.begin(), frames.end(), [](const auto & frame) { return frame && frame->line.isDetermined; });
  if (first == frames.end())
  {
    NoiseLine none;
    none.expectedDn2.resize(all.diagonal.size());
    none.isFitted.resize(all.diagonal.size());
    return none;
  }
  constexpr double least = 1e-300; // above 0; the fit of each frame has kept the variances above their rounding
  const double     leastDn2 = std::max(limits.stepDn * limits.stepDn / 12.0, least);
  return FitNoiseLine(all.diagonal, limits.clip, leastDn2, (*first)->line.line);
}

Report
MakeSingleImageReport(const SingleImageFindings & found)
{
  Report          report;
  const AllFrames all = Gather(found.frames);
  NoiseLine       line = FitAllFrames(found.frames, LimitsOf(found.dnRange));
  DescribeFrames(report, found, all);
  report.singleImage = MakeRecord(found, all, line);
  FillLevelSets(report, found.frames);
  const std::string reason = ReasonAgainst(report, found, all, line);
  if (!reason.empty())
  {
    report.Warn(WarningCode::NothingToMeasure, reason);
    return report;
  }
  FillParameters(report, found, line);
  const std::string signs = SignsOfTexture(*report.singleImage, line, all.correlation.Largest());
  if (!signs.empty())
  {
    report.Warn(WarningCode::TextureDominates,
                signs +
                  ": texture, fixed-pattern noise or filtered noise is in the variance, and the gain may be off by "
                  "more than its error. Include even areas, or use --method refined with a burst");
  }
  FileStatuses(report);
  DivideExcessNoise(report, found.settings.excessNoiseFactor);
  return report;
}

} // namespace sensornoise
