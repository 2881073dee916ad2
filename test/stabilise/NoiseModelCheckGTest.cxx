// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/NoiseModel.h"

#include <cmath>
#include <cstddef>
#include <gtest/gtest.h>
#include <stdexcept>
#include <string>

using namespace sensornoise;

namespace
{
using Verdict = NoiseModelCheck::Verdict;
constexpr NoiseModel Model{ 0.5, 10.0 };

/** 100 frames with 1000 pixels in each of 64 bins of levels 20 to 2,036, and the variance of a function; a bin has a
 * relative error of sqrt(2 / 99,000) = 0.0045. */
template <typename TFunction>
Report
FramesOf(TFunction varianceAt, std::size_t pixels = 1000)
{
  Report frames;
  frames.framesDistinct = 100;
  for (int i = 0; i < 64; ++i)
  {
    const double level = 20.0 + 32.0 * i;
    frames.scatter.mean.push_back(level);
    frames.scatter.variance.push_back(varianceAt(level));
    frames.scatter.correctedVariance.push_back(varianceAt(level));
    frames.scatter.count.push_back(pixels);
  }
  return frames;
}

Report
FramesOfModel(double factor = 1.0, std::size_t pixels = 1000)
{
  return FramesOf([factor](double level) { return factor * Model.VarianceAt(level); }, pixels);
}

Report
ReportOf(const NoiseModel & model)
{
  Report report;
  report.varianceSlope = Quantity::Identified(model.varianceSlopeDn);
  report.totalIntercept = Quantity::Identified(model.totalInterceptDn2);
  return report;
}
} // namespace

TEST(NoiseModelCheck, RightModelFitsEverywhere)
{
  const NoiseModelCheck check = CheckNoiseModel(FramesOfModel(), Model);
  EXPECT_EQ(check.verdict, Verdict::Fits);
  EXPECT_EQ(check.sentence, "variance 1.00 +- 0.01 from 20 to 2,036 DN: this model can be used");
  std::size_t pixels = 0;
  for (const auto & band : check.bands)
  {
    ASSERT_TRUE(band.ratio);
    EXPECT_NEAR(*band.ratio, 1.0, 1e-14);
    const double inBand = static_cast<double>(band.pixels);
    EXPECT_NEAR(band.standardError, std::sqrt(2.0 / (99.0 * inBand)), 1e-15); // nothing but their number
    pixels += band.pixels;
  }
  EXPECT_EQ(pixels, 64000U);
  EXPECT_EQ(check.bands.front().lowDn, 20.0);
  EXPECT_EQ(check.bands.back().highDn, 2036.0);
}

TEST(NoiseModelCheck, SlopeThatIsFivePerCentWrongIsSeen)
{
  const NoiseModelCheck check = CheckNoiseModel(FramesOfModel(), { 1.05 * Model.varianceSlopeDn, 10.0 });
  EXPECT_EQ(check.verdict, Verdict::DoesNotFit);
  EXPECT_FALSE(check.bands.back().fits);
  EXPECT_NEAR(*check.bands.back().ratio, 1.0 / 1.05, 1e-3);
}

// A read variance of 5 DN^2 more matters in the dark only: (0.5 x + 15) / (0.5 x + 10), below 1.02 from 480 DN on.
TEST(NoiseModelCheck, SaysWhereAModelFits)
{
  const NoiseModelCheck check =
    CheckNoiseModel(FramesOf([](double level) { return Model.VarianceAt(level) + 5.0; }), Model);
  EXPECT_EQ(check.verdict, Verdict::DoesNotFit);
  EXPECT_FALSE(check.bands.front().fits);
  EXPECT_DOUBLE_EQ(*check.bands.front().ratio, 1.25);
  EXPECT_TRUE(check.bands.back().fits);
  EXPECT_NE(check.sentence.find(" to 2,036 DN, but "), std::string::npos) << check.sentence;
  EXPECT_NE(check.sentence.find(": this model does not fit there"), std::string::npos) << check.sentence;
}

TEST(NoiseModelCheck, ModelOfAnotherCameraIsSaidToBe)
{
  const NoiseModelCheck check = CheckNoiseModel(FramesOfModel(2.0), Model);
  EXPECT_EQ(check.sentence, "variance 2.00 +- 0.01 from 20 to 2,036 DN: this is not the model of these frames");
}

TEST(NoiseModelCheck, ModelWithoutVarianceAtALevelDoesNotFitThere)
{
  const NoiseModelCheck check = CheckNoiseModel(FramesOfModel(), { 0.5, -200.0 }); // none below 400 DN
  EXPECT_EQ(check.verdict, Verdict::DoesNotFit);
  EXPECT_FALSE(check.bands.front().ratio);
  EXPECT_FALSE(check.bands.front().fits);
  EXPECT_NE(check.sentence.find("not there in the model from 20 to "), std::string::npos) << check.sentence;
  EXPECT_NE(ToJson(check).find("\"variance\": null"), std::string::npos);
  EXPECT_NE(MakeTable(check).find("no variance"), std::string::npos);
}

// Bins that differ by +-3 % in turn: squares of differences of 0.06 over 2 * 0.0045^2 make the errors 9.4 times as
// large; their median over the median of chi-square with one degree of freedom is 1 / 0.45 of them.
TEST(NoiseModelCheck, WhatBinsDifferByIsInTheError)
{
  int        number = 0;
  const auto varianceAt = [&](double level) { return Model.VarianceAt(level) * (++number / 2 % 2 ? 1.03 : 0.97); };
  const NoiseModelCheck check = CheckNoiseModel(FramesOf(varianceAt), Model);
  const auto &          band = check.bands.back();
  const double          excess = 0.06 * 0.06 / (2.0 * 2.0 / 99000.0) / 0.4549364;
  EXPECT_NEAR(band.standardError,
              *band.ratio * std::sqrt(excess * 2.0 / (99.0 * static_cast<double>(band.pixels))),
              0.002 * band.standardError);
  EXPECT_EQ(check.verdict, Verdict::Fits) << MakeTable(check);
}

TEST(NoiseModelCheck, FewPixelsAreNotTested)
{
  const NoiseModelCheck check = CheckNoiseModel(FramesOfModel(1.0, 1), Model);
  EXPECT_EQ(check.verdict, Verdict::NotDetermined);
  EXPECT_NE(check.sentence.find("too few frames or pixels to test"), std::string::npos) << check.sentence;
}

TEST(NoiseModelCheck, FramesThatCannotBeMeasuredSayWhy)
{
  Report frames;
  frames.Warn(WarningCode::NothingToMeasure, "all pixels are clipped");
  const NoiseModelCheck check = CheckNoiseModel(frames, Model);
  EXPECT_EQ(check.verdict, Verdict::NotDetermined);
  EXPECT_EQ(check.sentence, "the variance of these frames could not be measured: all pixels are clipped");
  EXPECT_EQ(ToJson(check),
            "{\"schema\": \"itk-sensornoise-check/1\", \"verdict\": \"not-told\", \"sentence\": \"" + check.sentence +
              "\", \"bands\": []}\n");
}

TEST(NoiseModelCheck, TransformsOwnVarianceStandsBeside)
{
  const Report frames = FramesOfModel();
  EXPECT_NEAR(*CheckNoiseModel(frames, Model).bands.back().transformVariance, 1.0, 1e-3);
  // Without signal, and with a read noise of 2 e-: 1.1986.
  const Report dark = FramesOf([](double level) { return level / 20.0; });
  const auto   band = CheckNoiseModel(dark, { 0.05, 0.0 }, 2.0).bands.front(); // at 20 DN: 1 DN^2, 400 e-^2
  EXPECT_NEAR(*band.transformVariance, 1.0, 0.01);
  const Report darker = FramesOf([](double level) { return 0.5 * (level - 18.0); });
  EXPECT_FALSE(CheckNoiseModel(darker, { 0.5, -9.0 }).bands.front().transformVariance); // 4 e-^2, of what is not known
  EXPECT_NEAR(*CheckNoiseModel(darker, { 0.5, -9.0 }, 2.0).bands.front().transformVariance, 1.1986, 1e-3);
}

// sqrt(v)^2 can be above v, by rounding.
TEST(NoiseModelCheck, DarkestLevelMayBeAllReadNoise)
{
  const Report frames = FramesOfModel();
  for (double intercept = -9.0; intercept < 9.0; intercept += 0.37)
  {
    EXPECT_GT(*CheckNoiseModel(frames, { 0.5, intercept }, 30.0).bands.front().transformVariance, 0.0) << intercept;
  }
}

TEST(NoiseModelCheck, FramesOfAnotherScaleAreSaid)
{
  Report frames = FramesOfModel();
  Report report = ReportOf(Model);
  frames.quantisationStepDn = 16.0;
  report.quantisationStepDn = 1.0;
  EXPECT_EQ(CheckReport(frames, report).sentence,
            "variance 1.00 +- 0.01 from 20 to 2,036 DN: this model can be used; its digital numbers are 1 DN apart, "
            "the numbers of these "
            "frames 16 DN: it may be of another scale");
  EXPECT_THROW(CheckReport(frames, Report()), std::invalid_argument);
}
