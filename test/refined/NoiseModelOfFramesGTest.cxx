// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
// Check of the noise model of a report on other frames.
#include "sensornoise/Report.h"
#include "sensornoise/ReportText.h"
#include "sensornoise/Simulator.h"
#include "sensornoise/SimulationSettings.h"
#include "sensornoise/NoiseModel.h"
#include "helpers/RefinedTestHelper.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <gtest/gtest.h>
#include <vector>

using namespace sensornoise;
using namespace sensornoise::test;

namespace
{
using Verdict = NoiseModelCheck::Verdict;
constexpr std::size_t Width = 192;
constexpr std::size_t Height = 144;

/** Returns the report of 60 frames of camera B, with flicker and vibration. */
Report
ReportOf(std::uint64_t seed, const std::function<void(SimulationSettings &)> & change = [](SimulationSettings &) {})
{
  SimulationSettings settings = FlickeringSettings(60);
  settings.seed = seed;
  change(settings);
  const auto stack = Simulate<unsigned short>(settings, Width, Height, MakeTextureScene(Width, Height));
  return Measure(stack).GetReport();
}

Report
WithSlopeTimes(double factor, Report report)
{
  *report.varianceSlope.value *= factor;
  return report;
}
} // namespace

TEST(NoiseModelOfFrames, FitsHeldOutFramesInEveryBand)
{
  const NoiseModelCheck check = CheckReport(ReportOf(31), ReportOf(32));
  EXPECT_EQ(check.verdict, Verdict::Fits) << MakeTable(check);
  EXPECT_GE(check.bands.size(), 8U);
  double chi2 = 0.0;
  for (const auto & band : check.bands)
  {
    EXPECT_LT(band.standardError, 0.03) << MakeTable(check);
    chi2 += std::pow((*band.ratio - 1.0) / band.standardError, 2);
  }
  // The errors of the report are common to the bands. The limit is twice the expectation of chi-square, plus 4.5 of its
  // standard deviations.
  const auto bands = static_cast<double>(check.bands.size());
  EXPECT_LT(chi2, 2.0 * bands + 4.5 * std::sqrt(2.0 * bands)) << MakeTable(check);
}

TEST(NoiseModelOfFrames, SlopeThatIsFivePerCentWrongIsSeen)
{
  const Report frames = ReportOf(31);
  for (const double factor : { 0.95, 1.05 })
  {
    const NoiseModelCheck check = CheckReport(frames, WithSlopeTimes(factor, ReportOf(32)));
    EXPECT_EQ(check.verdict, Verdict::DoesNotFit) << MakeTable(check);
    EXPECT_NEAR(*check.bands.back().ratio, 1.0 / factor, 0.03) << MakeTable(check);
  }
}

// Smoothed frames have less noise than raw frames. Their noise model does not fit raw frames, but smoothed ones.
TEST(NoiseModelOfFrames, ReportOfSmoothedFramesFitsSmoothedFramesOnly)
{
  const auto   smooth = [](SimulationSettings & settings) { settings.flaws.smoothing.sdPixels = 0.5; };
  const Report report = ReportOf(33, smooth);
  EXPECT_EQ(CheckReport(ReportOf(31), report).verdict, Verdict::DoesNotFit);
  const NoiseModelCheck same = CheckReport(ReportOf(34, smooth), report);
  EXPECT_EQ(same.verdict, Verdict::Fits) << MakeTable(same);
}

TEST(NoiseModelOfFrames, OtherGainAndOtherOffsetAreSeen)
{
  const Report report = ReportOf(32);
  for (const auto & change :
       { std::function<void(SimulationSettings &)>([](auto & settings) { settings.camera.gainDnPerElectron *= 1.1; }),
         std::function<void(SimulationSettings &)>([](auto & settings) { settings.camera.offsetDn += 60.0; }) })
  {
    const NoiseModelCheck check = CheckReport(ReportOf(31, change), report);
    EXPECT_EQ(check.verdict, Verdict::DoesNotFit) << MakeTable(check);
  }
}

// The ratio of the check is the temporal variance of the transformed frames, which is computed here without flicker and
// motion. From 4 e- to 60 e- the transform gives variances from 1.0 to 1.07. Both are from the same frames. The
// variance of the transform is taken at the middle of the band, which adds 0.015.
TEST(NoiseModelOfFrames, IsTheVarianceOfTransformedFrames)
{
  SimulationSettings settings = FlickeringSettings(60);
  settings.camera = { 60.0, 4.0, 100.0, 8.0 };
  settings.conditions = { 0.0, 0.0, 0.0 };
  const auto       stack = Simulate<unsigned short>(settings, Width, Height, MakeTextureScene(Width, Height));
  const auto       method = Measure(stack);
  const NoiseModel model{ 4.0, 64.0 + 1.0 / 12.0 - 400.0 };
  const auto       check = CheckNoiseModel(method.GetReport(), model, 2.0);
  ASSERT_GE(check.bands.size(), 6U);

  std::vector<double> stabilised(stack.pixels.size());
  GeneralizedAnscombe(model).Stabilise(stack.pixels.data(), stack.pixels.size(), stabilised.data());
  for (const auto & band : check.bands)
  {
    double      sum = 0.0;
    std::size_t pixels = 0;
    for (std::size_t p = 0; p < Width * Height; ++p)
    {
      const double level = method.GetMean()[p];
      if (method.GetPixelUse()[p] == 0 && level >= band.lowDn && level <= band.highDn)
      {
        double mean = 0.0;
        double squares = 0.0;
        for (std::size_t t = 0; t < stack.frames; ++t)
        {
          const double value = stabilised[t * Width * Height + p];
          mean += value;
          squares += value * value;
        }
        const auto frames = static_cast<double>(stack.frames);
        sum += (squares - mean * mean / frames) / (frames - 1.0);
        ++pixels;
      }
    }
    if (pixels > 300)
    {
      ASSERT_TRUE(band.transformVariance);
      EXPECT_NEAR(sum / static_cast<double>(pixels), *band.ratio * *band.transformVariance, 0.015)
        << band.lowDn << " DN, " << pixels << " pixels\n"
        << MakeTable(check);
    }
  }
}
