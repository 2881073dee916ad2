// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/report/StackReport.h"

#include "sensornoise/base/IntensityIndex.h"
#include "sensornoise/base/PixelUse.h"
#include "sensornoise/base/Text.h"
#include "sensornoise/moments/CodeRange.h"
#include "sensornoise/moments/MosaicLevels.h"
#include "sensornoise/moments/StackRequirements.h"

#include <algorithm>
#include <string>

namespace sensornoise
{
namespace
{
/** Between which levels the data lie; of floating-point data one end may be open. */
std::string
TextOfLevels(const CodeRange & codes)
{
  if (!codes.clipLowDn)
  {
    return "up to " + Text(*codes.clipHighDn);
  }
  return codes.clipHighDn ? Text(*codes.clipLowDn) + " to " + Text(*codes.clipHighDn)
                          : "from " + Text(*codes.clipLowDn);
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

  const CodeRange & codes = summary.codes;
  report.bitDepth = codes.bitDepth;
  report.bitDepthSource = codes.bitDepthSource;
  if (codes.quantisationStepDn > 0.0)
  {
    report.quantisationStepDn = codes.quantisationStepDn;
  }
  report.clipLowDn = codes.clipLowDn;
  report.clipHighDn = codes.clipHighDn;
  report.clipSource = codes.clipSource;

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
  const CodeRange & codes = summary.codes;
  if (frames >= MinimumFrames && frames < 20)
  {
    report.Warn(WarningCode::FewFrames,
                "the stack has " + std::to_string(frames) +
                  " different frames: indicative only; 20 or more are usable");
  }
  if (codes.clipSource.find("pile-up") != std::string::npos)
  {
    report.Warn(WarningCode::ClipLevelFound,
                "the sensor attains only the levels " + TextOfLevels(codes) + " DN (" + codes.clipSource +
                  "); pixels that reach an end are left out");
  }
  if (codes.steps.IsCompanded())
  {
    const CodeSteps::Local & dark = codes.steps.GetTable().front();
    const CodeSteps::Local & bright = codes.steps.GetTable().back();
    report.Warn(
      WarningCode::Companded,
      "the grey levels lie " + Rounded(dark.stepDn) + " DN apart about " + Rounded(dark.levelDn) + " DN and " +
        Rounded(bright.stepDn) + " DN about " + Rounded(bright.levelDn) +
        " DN: a tone curve was applied to fewer bits and undone, and the noise of rounding differs from level "
        "to level");
  }
  if (!codes.isRegular)
  {
    report.Warn(WarningCode::IrregularCodes,
                "the spacing of the grey levels varies about " + Text(codes.quantisationStepDn) +
                  " DN: the data were rescaled and their quantisation noise is not known");
  }
  if (summary.notFinite > 0)
  {
    report.Warn(WarningCode::NotFinitePixels,
                std::to_string(summary.notFinite) + " pixels are NaN or infinite in a frame and left out");
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
    const BayerPattern other = CutPattern(*pattern, 1, 1); // red and blue exchanged
    report.Warn(WarningCode::Mosaic,
                std::string("the levels of neighbouring pixels alternate as behind a Bayer mosaic, ") +
                  NameOf(*pattern) + " or " + NameOf(other) +
                  ", and the frames were measured as those of a monochrome sensor; expected the option bayer, which "
                  "measures each colour by itself");
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
  // The sums of each bin.
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

} // namespace sensornoise
