// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "scene/InitialNoiseModel.h"
#include "base/NothingToMeasure.h"
#include "base/Quantiles.h"
#include "base/Stencils.h"
#include "scene/ReferenceFrame.h"
#include "helpers/FrameTestHelper.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <gtest/gtest.h>
#include <random>
#include <string>
#include <vector>

using namespace sensornoise;
using namespace sensornoise::test;

namespace
{
constexpr std::size_t Width = 70;
constexpr std::size_t Height = 60;

/** Returns a frame with the variance of \a truth, and with \a spoiled pixels of 50 times the variance. */
ReferenceFrame
FrameOf(const InitialNoiseModel & truth, std::size_t every = 0)
{
  ReferenceFrame frame = SyntheticFrames(Width, Height, std::vector<FrameChange>(40)).reference;
  const auto &   stencils = MotionStencils();
  std::size_t    count = 0;
  for (std::size_t p = 0; p < frame.mean.size(); ++p)
  {
    if (frame.usable[p] != 0)
    {
      const double gx = ApplyStencil(stencils[StencilX], frame.mean.data(), Width, p);
      const double gy = ApplyStencil(stencils[StencilY], frame.mean.data(), Width, p);
      frame.variance.Set(p, truth.RawVariance(frame.neighbourMean[p], gx, gy));
      frame.variance.Set(p, frame.variance[p] * (every > 0 && ++count % every == 0 ? 50.0 : 1.0));
    }
  }
  return frame;
}

InitialNoiseModel
Truth(double darkestDn)
{
  InitialNoiseModel truth;
  truth.darkestDn = darkestDn;
  truth.interceptDn2 = 300.0;
  truth.slopeDn = 1.5;
  truth.flickerVariance = 2e-3;
  truth.vibrationXPixels2 = 0.003;
  truth.vibrationYPixels2 = 0.001;
  truth.vibrationXY = -0.0005;
  return truth;
}

void
ExpectTruth(const InitialNoiseModel & model)
{
  const InitialNoiseModel truth = Truth(model.darkestDn);
  EXPECT_NEAR(model.interceptDn2, truth.interceptDn2, 1e-6);
  EXPECT_NEAR(model.slopeDn, truth.slopeDn, 1e-8);
  EXPECT_NEAR(model.flickerVariance, truth.flickerVariance, 1e-10);
  EXPECT_NEAR(model.vibrationXPixels2, truth.vibrationXPixels2, 1e-8);
  EXPECT_NEAR(model.vibrationYPixels2, truth.vibrationYPixels2, 1e-8);
  EXPECT_NEAR(model.vibrationXY, truth.vibrationXY, 1e-8);
}
} // namespace

TEST(SensorNoiseInitialNoiseModel, VarianceThatChanceExplainsIsUniform)
{
  // Sample variances of 40 frames with the same noise everywhere.
  InitialNoiseModel uniform;
  uniform.interceptDn2 = 500.0;
  ReferenceFrame                        frame = FrameOf(uniform);
  std::mt19937                          random(5);
  std::chi_squared_distribution<double> chi2(39.0);
  double                                sum = 0.0;
  double                                count = 0.0;
  for (std::size_t p = 0; p < frame.variance.size(); ++p)
  {
    frame.variance.Set(p, frame.variance[p] * (chi2(random) / 39.0));
    sum += frame.usable[p] * frame.variance[p];
    count += frame.usable[p];
  }
  const InitialNoiseModel model = FitInitialNoiseModel(frame);
  EXPECT_EQ(model.flickerVariance, 0.0);
  EXPECT_EQ(model.vibrationXPixels2, 0.0);
  EXPECT_EQ(model.vibrationYPixels2, 0.0);
  EXPECT_NEAR(model.interceptDn2, sum / count, 1e-9 * sum / count);
}

TEST(SensorNoiseInitialNoiseModel, VarianceOfTheModelIsRecoveredExactly)
{
  const double darkest = FitInitialNoiseModel(FrameOf(Truth(300.0))).darkestDn; // from the mean alone
  ExpectTruth(FitInitialNoiseModel(FrameOf(Truth(darkest))));
}

TEST(SensorNoiseInitialNoiseModel, PixelsFarAboveTheModelAreTrimmed)
{
  const double darkest = FitInitialNoiseModel(FrameOf(Truth(300.0))).darkestDn;
  ExpectTruth(FitInitialNoiseModel(FrameOf(Truth(darkest), 20)));
}

TEST(SensorNoiseInitialNoiseModel, LevelsAreThoseOfTheUsablePixels)
{
  const ReferenceFrame    frame = FrameOf(Truth(300.0));
  const InitialNoiseModel model = FitInitialNoiseModel(frame);
  std::vector<double>     means;
  double                  sum = 0.0;
  for (std::size_t p = 0; p < frame.mean.size(); ++p)
  {
    if (frame.usable[p] != 0)
    {
      means.push_back(frame.mean[p]);
      sum += frame.mean[p];
    }
  }
  const auto pixels = static_cast<double>(means.size());
  EXPECT_NEAR(model.centreDn, sum / pixels, 1e-9);
  const auto darker = std::count_if(means.begin(), means.end(), [&](double mean) { return mean < model.darkestDn; });
  const auto brighter =
    std::count_if(means.begin(), means.end(), [&](double mean) { return mean > model.brightestDn; });
  EXPECT_NEAR(static_cast<double>(darker), 0.002 * pixels, 1.0);
  EXPECT_NEAR(static_cast<double>(brighter), 0.002 * pixels, 1.0);
}

TEST(SensorNoiseInitialNoiseModel, NoiseIsNeverBelowTheDarkestLevels)
{
  const InitialNoiseModel truth = Truth(300.0);
  EXPECT_EQ(truth.NoiseVariance(300.0), 300.0);
  EXPECT_EQ(truth.NoiseVariance(-1e6), 300.0);
  EXPECT_EQ(truth.NoiseVariance(400.0), 300.0 + 150.0);
  EXPECT_DOUBLE_EQ(truth.MotionVariance(2.0, 3.0), 0.003 * 4.0 + 0.001 * 9.0);
  EXPECT_DOUBLE_EQ(truth.RawVariance(400.0, 2.0, 3.0), 450.0 + 2e-3 * 1e4 + 0.012 + 0.009 - 2.0 * 0.0005 * 6.0);
}

TEST(SensorNoiseInitialNoiseModel, FewPixelsAreAnErrorThatSaysHowMany)
{
  ReferenceFrame frame = FrameOf(Truth(300.0));
  std::fill(frame.usable.begin(), frame.usable.end(), std::uint8_t{ 0 });
  std::fill_n(frame.usable.begin() + 5 * Width + 2, 60, std::uint8_t{ 1 });
  try
  {
    FitInitialNoiseModel(frame);
    FAIL();
  }
  catch (const NothingToMeasure & error)
  {
    EXPECT_NE(std::string(error.what()).find("60"), std::string::npos) << error.what();
  }
}

TEST(SensorNoiseInitialNoiseModel, SampleTakesEveryNthPixelOfTheMask)
{
  std::mt19937 random(17);
  for (const std::size_t pixels : { 1, 15, 16, 17, 1003, 4096 })
  {
    for (const unsigned int oneIn : { 1U, 2U, 40U })
    {
      std::vector<std::uint8_t> mask(pixels);
      std::vector<std::size_t>  ofMask;
      for (std::size_t p = 0; p < pixels; ++p)
      {
        mask[p] = random() % oneIn == 0 ? 1 : 0;
        if (mask[p] != 0)
        {
          ofMask.push_back(p);
        }
      }
      for (const std::size_t most : { 1, 7, 100, 5000 })
      {
        const std::size_t        step = std::max<std::size_t>(1, ofMask.size() / most);
        std::vector<std::size_t> expected;
        for (std::size_t i = 0; i < ofMask.size(); i += step)
        {
          expected.push_back(ofMask[i]);
        }
        EXPECT_EQ(SamplePixels(mask.data(), pixels, most), expected) << pixels << " " << oneIn << " " << most;
      }
    }
  }
}

TEST(SensorNoiseInitialNoiseModel, SampleIsEvenAndKeepsAllOfASmallFrame)
{
  std::vector<std::uint8_t> mask(1000, 0);
  for (std::size_t p = 0; p < mask.size(); p += 2)
  {
    mask[p] = 1;
  }
  const auto all = SamplePixels(mask);
  ASSERT_EQ(all.size(), 500u);
  EXPECT_EQ(all[7], 14u);
  const auto some = SamplePixels(mask.data(), mask.size(), 50);
  ASSERT_GE(some.size(), 50u);
  EXPECT_LT(some.size(), 100u);
  for (std::size_t i = 1; i < some.size(); ++i)
  {
    EXPECT_EQ(some[i] - some[i - 1], some[1] - some[0]);
    EXPECT_EQ(mask[some[i]], 1);
  }
}

TEST(SensorNoiseInitialNoiseModel, BinsHaveEqualCountsAndMedians)
{
  std::vector<double> values;
  for (int i = 0; i < 320; ++i)
  {
    values.push_back(std::sin(static_cast<double>(i)));
  }
  const auto               binOf = BinsOfEqualCount(values, 32);
  const auto               medians = MediansOfBins(values, binOf, 32);
  std::vector<std::size_t> counts(32, 0);
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    ++counts[binOf[i]];
  }
  EXPECT_EQ(counts, std::vector<std::size_t>(32, 10));
  std::sort(values.begin(), values.end());
  for (std::size_t b = 0; b < 32; ++b)
  {
    EXPECT_DOUBLE_EQ(medians[b], 0.5 * (values[10 * b + 4] + values[10 * b + 5])) << b;
  }
  EXPECT_TRUE(std::isnan(MediansOfBins({}, {}, 1)[0]));
}
