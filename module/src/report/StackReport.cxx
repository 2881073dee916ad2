// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "report/StackReport.h"

#include "base/Quantiles.h"
#include "sensornoise/Report.h"
#include "base/Text.h"
#include "sensornoise/StepResults.h"
#include "moments/StackMaps.h"
#include "moments/StackFrames.h"
#include "base/ChiSquare.h"
#include "report/Quantities.h"
#include "report/ReportParts.h"
#include "moments/Constants.h"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <string>
#include <vector>

namespace sensornoise
{

namespace
{
/** Returns the range of the levels as text [DN]. Floating-point data may have only one clip level. */
std::string
TextOfLevels(const DnRange & dnRange)
{
  if (!dnRange.clipLowDn)
  {
    return "up to " + Text(*dnRange.clipHighDn);
  }
  return dnRange.clipHighDn ? Text(*dnRange.clipLowDn) + " to " + Text(*dnRange.clipHighDn)
                            : "from " + Text(*dnRange.clipLowDn);
}
} // namespace

void
DescribeStack(Report &                          report,
              const FrameGeometry &             geometry,
              std::size_t                       frames,
              const StackSummary &              summary,
              std::size_t                       valid,
              const std::vector<std::uint8_t> & pixelUse)
{
  report.frames = frames;
  report.framesDistinct = frames;
  report.width = geometry.width;
  report.height = geometry.height;

  const DnRange & dnRange = summary.dnRange;
  report.bitDepth = dnRange.bitDepth;
  report.bitDepthSource = dnRange.bitDepthSource;
  if (dnRange.quantisationStepDn > 0.0)
  {
    report.quantisationStepDn = dnRange.quantisationStepDn;
  }
  report.clipLowDn = dnRange.clipLowDn;
  report.clipHighDn = dnRange.clipHighDn;
  report.clipSource = dnRange.clipSource;

  report.pixels.total = geometry.Pixels();
  report.pixels.valid = valid;
  report.pixels.used =
    static_cast<std::size_t>(std::count(pixelUse.begin(), pixelUse.end(), static_cast<std::uint8_t>(PixelUse::Used)));
  report.pixels.clipped = summary.clipped;
  report.pixels.notFinite = summary.notFinite;
}

void
WarnOfStack(Report & report, std::size_t frames, const StackSummary & summary)
{
  const DnRange & dnRange = summary.dnRange;
  if (frames >= MinimumFrames && frames < 20)
  {
    report.Warn(WarningCode::FewFrames,
                "only " + std::to_string(frames) +
                  " distinct frames: treat the results as indicative. Record at least 20");
  }
  if (dnRange.clipSource.find("pile-up") != std::string::npos)
  {
    report.Warn(WarningCode::ClipLevelFound,
                "the sensor attains only the levels " + TextOfLevels(dnRange) + " DN (" +
                  DescribeClipSource(dnRange.clipSource) +
                  "). Pixels that reach an end are left out, because clipping reduces their variance. Check these "
                  "levels, and give the correct levels (--clip) if they are wrong");
  }
  if (dnRange.steps.IsCompanded())
  {
    const auto &                     table = dnRange.steps.GetTable();
    const auto                       byStep = [](const auto & a, const auto & b) { return a.stepDn < b.stepDn; };
    const auto                       ends = std::minmax_element(table.begin(), table.end(), byStep);
    const QuantisationSteps::Local & fine = *ends.first;
    const QuantisationSteps::Local & coarse = *ends.second;
    report.Warn(WarningCode::Companded,
                "the quantization step is " + Rounded(fine.stepDn) + " DN at " + Rounded(fine.levelDn) + " DN and " +
                  RoundedApart(coarse.stepDn, fine.stepDn) + " DN at " + Rounded(coarse.levelDn) +
                  " DN: a tone curve to fewer bits was applied and undone, and the quantization noise depends on the "
                  "level. Give the size of the steps (--step) if all are equal");
  }
  if (!dnRange.isRegular)
  {
    report.Warn(WarningCode::IrregularCodes,
                "the quantization step varies about " + Rounded(dnRange.quantisationStepDn) +
                  " DN: the frames were rescaled, and their quantization noise is not known. Give the frames as the "
                  "camera recorded them");
  }
  if (summary.notFinite > 0)
  {
    report.Warn(WarningCode::NotFinitePixels,
                CountText(summary.notFinite, "pixel") + (summary.notFinite == 1 ? " is" : " are") +
                  " NaN or infinite in a frame and left out, without a variance. Check the processing that wrote these "
                  "values, as cameras do not record them");
  }
}

void
WarnOfMosaic(Report &                    report,
             const std::vector<double> & mean,
             const FrameGeometry &       geometry,
             const ParallelFor &         parallelFor)
{
  if (const auto pattern = RecogniseMosaic(mean, geometry.width, geometry.height, parallelFor))
  {
    const BayerPattern other = CutPattern(*pattern, 1, 1); // the same pattern with red and blue exchanged
    report.Warn(WarningCode::Mosaic,
                std::string("the levels of neighbouring pixels alternate as behind a Bayer mosaic, ") +
                  NameOf(*pattern) + " or " + NameOf(other) +
                  ", but the frames were measured as frames of a monochrome sensor. Measure each colour by itself: "
                  "--bayer " +
                  NameOf(*pattern));
  }
}

std::vector<std::uint8_t>
MaskOfUsed(const std::vector<std::uint8_t> & pixelUse)
{
  std::vector<std::uint8_t> used(pixelUse.size());
  std::transform(pixelUse.begin(), pixelUse.end(), used.begin(), [](std::uint8_t use) {
    return use == static_cast<std::uint8_t>(PixelUse::Used) ? 1 : 0;
  });
  return used;
}

void
FillScatter(Report &                          report,
            const std::vector<double> &       mean,
            const std::vector<double> &       variance,
            const std::vector<double> &       correctedVariance,
            const std::vector<std::uint8_t> & used,
            const ParallelFor &               parallelFor)
{
  // Sums of one intensity bin.
  enum : std::size_t
  {
    Mean,
    Variance,
    Corrected,
    Pixels,
    Sums
  };
  constexpr std::size_t      count = 256;
  const std::size_t          pixels = mean.size();
  const IntensityIndex       index(mean.data(), used.data(), pixels, parallelFor);
  const IntensityIndex::Bins bins(index, count);
  const std::vector<double>  sums = SumOverBlocks(pixels, parallelFor, count * Sums, [&](std::size_t p, double * sum) {
    if (used[p] != 0)
    {
      double * const own = sum + Sums * bins.Of(mean[p]);
      own[Mean] += mean[p];
      own[Variance] += variance[p];
      own[Corrected] += correctedVariance[p];
      own[Pixels] += 1.0;
    }
  });
  report.scatter = Report::Scatter();
  for (const double * own = sums.data(); own != sums.data() + sums.size(); own += Sums)
  {
    if (own[Pixels] > 0.0)
    {
      report.scatter.mean.push_back(own[Mean] / own[Pixels]);
      report.scatter.variance.push_back(own[Variance] / own[Pixels]);
      report.scatter.correctedVariance.push_back(own[Corrected] / own[Pixels]);
      report.scatter.count.push_back(static_cast<std::size_t>(own[Pixels]));
    }
  }
}

void
FillBaselines(Report & report, const RegressionData & raw, const ParallelFor & parallelFor)
{
  const auto [affine, parabola] = FitLineAndParabola(raw, parallelFor);
  report.affineBaseline = Report::Baseline{ 0.0, affine.slope, affine.intercept };
  report.quadraticBaseline = Report::Baseline{ parabola.curvature, parabola.slope, parabola.intercept };
}

namespace
{
/** Returns the first two repeated frames as text: "frame 1 equals frame 0, frame 3 equals frame 2, ...". */
std::string
TextOfRepeated(const DistinctFrames & frames)
{
  constexpr std::size_t most = 2;
  std::string           text;
  std::size_t           count = 0;
  for (std::size_t t = 0; t < frames.Given() && count <= most; ++t)
  {
    if (frames.OriginalOf(t) != t)
    {
      text += count == 0 ? "" : ", ";
      text +=
        count == most ? "..." : "frame " + std::to_string(t) + " equals frame " + std::to_string(frames.OriginalOf(t));
      ++count;
    }
  }
  return text;
}

/** Returns the first four frames that are left out as text: "frame 3: no-noise, frame 31: other-shape, ...". */
std::string
TextOfLeftOut(const std::vector<LeftOutFrame> & leftOut)
{
  constexpr std::size_t most = 4;
  std::string           text;
  for (std::size_t k = 0; k < leftOut.size() && k <= most; ++k)
  {
    text += k == 0 ? "" : ", ";
    text += k == most ? "..." : "frame " + std::to_string(leftOut[k].frame) + ": " + NameOf(leftOut[k].fault);
  }
  return text;
}

/** Replaces the values of the counted frames by values of all given frames; \a ofLeftOut for frames that are left out.
 * An empty series stays empty. */
template <typename TValue>
void
SpreadOverFrames(std::vector<TValue> & series, const DistinctFrames & frames, const TValue & ofLeftOut)
{
  if (!series.empty())
  {
    series = frames.ExpandToGiven(series, ofLeftOut);
  }
}

/** Returns the subject of a sentence: "2 of 40 frames are". */
std::string
OfFrames(std::size_t count, std::size_t all)
{
  return std::to_string(count) + " of " + std::to_string(all) + " frames " + (count == 1 ? "is" : "are");
}
} // namespace

void
ReportAllFrames(Report & report, const DistinctFrames & frames, const std::vector<LeftOutFrame> & leftOut)
{
  report.frames = frames.Given();
  report.framesDistinct = frames.Count();
  report.framesLeftOut = leftOut;
  constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  SpreadOverFrames(report.flicker, frames, unknown);
  SpreadOverFrames(report.flickerRows,
                   frames,
                   std::vector<double>(report.flickerRows.empty() ? 0 : report.flickerRows.front().size(), unknown));
  SpreadOverFrames(report.motion, frames, { unknown, unknown });
  // These warnings come first, because the other warnings are about the counted frames only.
  if (frames.Repeated() > 0)
  {
    const Warning warning{ WarningCode::RepeatedFrames,
                           OfFrames(frames.Repeated(), frames.Given()) + " equal to an earlier one (" +
                             TextOfRepeated(frames) +
                             "; the first is 0): each is counted once, because a repetition has no "
                             "new noise. Set the recorder to the frame rate of the camera" };
    report.warnings.insert(report.warnings.begin(), warning);
  }
  if (!leftOut.empty())
  {
    const Warning warning{
      WarningCode::FramesLeftOut,
      OfFrames(leftOut.size(), frames.Given()) + " unlike the others (" + TextOfLeftOut(leftOut) +
        "; the first is 0) and would change the variance of all pixels: all else is measured without " +
        (leftOut.size() == 1 ? "it. Check how it was recorded" : "them. Check how they were recorded")
    };
    report.warnings.insert(report.warnings.begin(), warning);
  }
}

void
ReportLinearity(Report & report, const std::optional<ExposureFit> & fit)
{
  if (!fit)
  {
    return;
  }
  constexpr double  percent = 100.0;
  LinearityRecord & linearity = report.linearity;
  linearity.reason = fit->reason;
  linearity.saturationDn = fit->saturationDn;
  linearity.saturationSource = fit->saturationSource;
  linearity.levels.clear();
  for (const ExposureFit::Level & level : fit->levels)
  {
    linearity.levels.push_back({ level.exposure, level.frames, level.meanDn, std::nullopt });
    if (level.deviation)
    {
      linearity.levels.back().deviationPercent = percent * *level.deviation;
    }
  }
  const double student = fit->dof > 0.0 ? StudentQuantile(0.975, fit->dof) : 0.0;
  if (fit->squaredError)
  {
    linearity.errorPercent = RootOf(
      percent * percent * fit->squaredError->value, percent * percent * fit->squaredError->standardError, student);
  }
  if (fit->offsetDn)
  {
    linearity.offsetSource = fit->isOffsetOfDarkFrames ? "dark frames" : "line";
    linearity.offsetDn = fit->isOffsetOfDarkFrames || student == 0.0
                           ? WithError(fit->offsetDn->value, fit->offsetDn->standardError)
                           : WithError(fit->offsetDn->value, fit->offsetDn->standardError, student);
  }
  if (fit->responsivity)
  {
    linearity.responsivity = WithError(fit->responsivity->value, fit->responsivity->standardError, student);
  }
}

namespace
{
/** Returns whether the change of the scene may be the only cause of a warning. Warnings about clipping and about
 * digital numbers do not depend on the scene. */
bool
MayFollow(WarningCode code)
{
  return KindOf(code).severity == Severity::Error || code == WarningCode::NearClipLevel ||
         code == WarningCode::StrongVibration || code == WarningCode::MotionNotUniform ||
         code == WarningCode::LocalLight || code == WarningCode::NotStatic || code == WarningCode::OffsetLineMisfit ||
         code == WarningCode::OffsetAboveDarkest || code == WarningCode::OffsetNotIdentifiable ||
         code == WarningCode::FlickerNotIdentifiable || code == WarningCode::CorrectedVarianceCurved ||
         code == WarningCode::PoorFit || code == WarningCode::RollingShutter ||
         code == WarningCode::LinesWithoutFlicker;
}
} // namespace

void
ReportSceneChange(Report & report, const SceneChange & change)
{
  if (report.gain.status == EstimateStatus::Identified || !change.IsLarge())
  {
    return;
  }
  auto & warnings = report.warnings;
  warnings.erase(
    std::remove_if(warnings.begin(), warnings.end(), [](const Warning & warning) { return MayFollow(warning.code); }),
    warnings.end());
  const Warning warning{
    WarningCode::SceneChanges,
    "the frames do not show one static scene: " + PercentApart(change.fraction, InMoments.sceneChangeFraction) +
      " of the differences between areas change from frame to frame (expected less than " +
      Percent(InMoments.sceneChangeFraction) +
      "). Check whether another axis was taken for time, the scene or camera moves, the illumination "
      "is off in some frames "
      "(leave them out: --frames), or the bytes of each pixel are swapped (--raw WxH:uint16be)"
  };
  warnings.insert(warnings.begin(), warning);
}

} // namespace sensornoise
