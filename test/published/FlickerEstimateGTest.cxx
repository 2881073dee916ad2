// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "base/Constants.h"
#include "sensornoise/Settings.h"
#include "published/Flicker.h"
#include "published/PublishedScene.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <gtest/gtest.h>
#include <random>
#include <utility>
#include <vector>

using namespace sensornoise;

namespace
{
/** Stack of frames of 20 x 20 pixels: the upper half is bright, the lower half is dark. */
struct Stack
{
  static constexpr std::size_t     Side = 20;
  static constexpr std::size_t     Pixels = Side * Side;
  std::vector<std::vector<double>> frames;

  /** Makes pixels mu + g (1 + gamma_t) p with normal noise of the given standard deviation. The dark half may have
   * another flicker. */
  Stack(const std::vector<double> & brightFlicker, const std::vector<double> & darkFlicker, double mu, double noise)
  {
    std::mt19937_64            random(7);
    std::normal_distribution<> normal(0.0, 1.0);
    for (std::size_t t = 0; t < brightFlicker.size(); ++t)
    {
      std::vector<double> frame(Pixels);
      for (std::size_t p = 0; p < Pixels; ++p)
      {
        const double flux = p < Pixels / 2 ? 2000.0 * (1.0 + brightFlicker[t]) : 300.0 * (1.0 + darkFlicker[t]);
        frame[p] = mu + flux + noise * normal(random);
      }
      frames.push_back(frame);
    }
  }
  template <typename TFunction>
  void
  Map(TFunction function)
  {
    for (auto & frame : frames)
    {
      std::transform(frame.begin(), frame.end(), frame.begin(), function);
    }
  }
  std::vector<double>
  Mean() const
  {
    std::vector<double> mean(Pixels, 0.0);
    for (const auto & frame : frames)
    {
      for (std::size_t p = 0; p < Pixels; ++p)
      {
        mean[p] += frame[p] / static_cast<double>(frames.size());
      }
    }
    return mean;
  }
  /** Returns the set of the pixels [first, last), equally weighted, with the statistics of the finder. */
  IsoIntensitySet
  SetOf(std::size_t first, std::size_t last) const
  {
    const auto      mean = this->Mean();
    IsoIntensitySet set;
    for (std::size_t p = first; p < last; ++p)
    {
      const auto n = static_cast<double>(last - first);
      set.pixels.push_back(static_cast<std::uint32_t>(p));
      set.weights.push_back(1.0 / n);
      set.levelDn += mean[p] / n;
      for (const auto & frame : frames)
      {
        set.temporalVarianceDn2 +=
          (frame[p] - mean[p]) * (frame[p] - mean[p]) / static_cast<double>(frames.size() - 1) / n;
      }
    }
    return set;
  }
  FlickerEstimate
  Estimate() const
  {
    const auto            mean = this->Mean();
    const IsoIntensitySet bright = this->SetOf(0, Pixels / 2);
    const IsoIntensitySet dark = this->SetOf(Pixels / 2, Pixels);
    FlickerSums           sums(bright, dark, mean.data(), { Side, Side, 1 }, frames.size());
    for (std::size_t t = 0; t < frames.size(); ++t)
    {
      sums.AddFrame(frames[t].data(), t);
    }
    return EstimateFlicker(sums, bright, dark, RollingShutter::Off, 0.0);
  }
};

std::vector<double>
NormalFlicker(std::size_t frames, double sd, std::uint64_t seed)
{
  std::mt19937_64            random(seed);
  std::normal_distribution<> normal(0.0, sd);
  std::vector<double>        gamma(frames);
  std::generate(gamma.begin(), gamma.end(), [&] { return normal(random); });
  return gamma;
}

/** Returns (1 + gamma) / mean(1 + gamma) - 1, the identifiable part of the flicker. */
std::vector<double>
Normalised(std::vector<double> gamma)
{
  const double mean = 1.0 + Mean(gamma);
  std::transform(gamma.begin(), gamma.end(), gamma.begin(), [mean](double g) { return (1.0 + g) / mean - 1.0; });
  return gamma;
}
} // namespace

TEST(SensorNoiseFlickerEstimate, NoiseFreeStackGivesOffsetAndFlickerExactly)
{
  for (const double mu : { 150.0, 0.0, -40.0 })
  {
    const auto            gamma = NormalFlicker(25, 0.05, 2);
    const FlickerEstimate estimate = Stack(gamma, gamma, mu, 0.0).Estimate();
    const auto            expected = Normalised(gamma);
    EXPECT_NEAR(estimate.offsetDn, mu, 1e-9 * 2000.0);
    ASSERT_EQ(estimate.gamma.size(), expected.size());
    for (std::size_t t = 0; t < expected.size(); ++t)
    {
      EXPECT_NEAR(estimate.gamma[t], expected[t], 1e-9) << t;
    }
    EXPECT_NEAR(estimate.flickerSd, std::sqrt(SampleVariance(expected)), 1e-9);
    // (3.8) and (3.14): v^* - 1 = gamma flux / mean, v_* = mu (mean_dark / mean_bright - 1) gamma
    const double brightness = 1.0 + Mean(gamma);
    const double bright = mu + 2000.0 * brightness;
    const double dark = mu + 300.0 * brightness;
    EXPECT_NEAR(estimate.slopeDn, mu * (dark / bright - 1.0) / (1.0 - mu / bright), 1e-8);
    EXPECT_NEAR(estimate.brightRatio[3], 1.0 + expected[3] * (1.0 - mu / bright), 1e-12);
    EXPECT_NEAR(estimate.darkResidualDn[3], mu * (dark / bright - 1.0) * expected[3], 1e-9);
  }
}

TEST(SensorNoiseFlickerEstimate, PermutedFramesGiveTheSameScalars)
{
  const auto            gamma = NormalFlicker(30, 0.05, 3);
  Stack                 stack(gamma, gamma, 100.0, 20.0);
  const FlickerEstimate before = stack.Estimate();
  std::reverse(stack.frames.begin(), stack.frames.end());
  std::swap(stack.frames[4], stack.frames[20]);
  const FlickerEstimate after = stack.Estimate();
  EXPECT_NEAR(after.offsetDn, before.offsetDn, 1e-9 * std::abs(before.offsetDn));
  EXPECT_NEAR(after.flickerSd, before.flickerSd, 1e-9 * before.flickerSd);
  EXPECT_NEAR(after.flickerZ, before.flickerZ, 1e-7 * before.flickerZ);
  EXPECT_NEAR(after.offsetLinePhi, before.offsetLinePhi, 1e-7 * before.offsetLinePhi);
  EXPECT_NEAR(after.gamma[29], before.gamma[0], 1e-12);
}

TEST(SensorNoiseFlickerEstimate, ScalingScalesTheOffset)
{
  const auto            gamma = NormalFlicker(30, 0.05, 4);
  Stack                 stack(gamma, gamma, 100.0, 20.0);
  const FlickerEstimate before = stack.Estimate();
  stack.Map([](double u) { return 3.0 * u; });
  const FlickerEstimate after = stack.Estimate();
  EXPECT_NEAR(after.offsetDn, 3.0 * before.offsetDn, 1e-8);
  EXPECT_NEAR(after.flickerSd, before.flickerSd, 1e-12);
  EXPECT_NEAR(after.gamma[5], before.gamma[5], 1e-12);
  EXPECT_NEAR(after.flickerZ, before.flickerZ, 1e-7 * before.flickerZ);
  EXPECT_NEAR(after.offsetLinePhi, before.offsetLinePhi, 1e-7 * before.offsetLinePhi);
}

TEST(SensorNoiseFlickerEstimate, AddingAConstantShiftsTheOffset)
{
  const auto            gamma = NormalFlicker(30, 0.05, 4);
  Stack                 stack(gamma, gamma, 100.0, 20.0);
  const FlickerEstimate before = stack.Estimate();
  stack.Map([](double u) { return u + 70.0; });
  const FlickerEstimate after = stack.Estimate();
  // v = u / ubar is relative to the mean of each pixel, whose noise, 20 / sqrt(30) DN, is r = 1.7e-3 of the level. The
  // constant changes the weights of the pixels by r^2.
  constexpr double r2 = 3e-6;
  EXPECT_NEAR(after.offsetDn, before.offsetDn + 70.0, r2 * 2100.0);
  EXPECT_NEAR(after.flickerSd, before.flickerSd, r2 * before.flickerSd);
  EXPECT_NEAR(after.gamma[5], before.gamma[5], r2);
}

TEST(SensorNoiseFlickerEstimate, NoiseDoesNotMoveTheOffsetByMoreThanItsError)
{
  const auto            gamma = NormalFlicker(200, 0.05, 5);
  const FlickerEstimate estimate = Stack(gamma, gamma, 100.0, 20.0).Estimate();
  // sd(v_*) = 20 / sqrt(200 pixels) DN, over sd(gamma) sqrt(T) = 0.7: sd(K) = 2 DN; d mu / d K = 2000^2 / (1700 2100).
  EXPECT_NEAR(estimate.offsetDn, 100.0, 5.0 * 2.0 * 1.12);
  EXPECT_GT(estimate.flickerZ, Significance.everyPixel);
  // Residual variance over its expectation, chi-square of 198: sd = sqrt(2 / 198) = 0.1.
  EXPECT_NEAR(estimate.offsetLinePhi, 1.0, 0.5);
}

TEST(SensorNoiseFlickerEstimate, NoiseWithoutFlickerIsNotTakenForFlicker)
{
  for (const std::size_t frames : { 10, 50, 200 })
  {
    const std::vector<double> none(frames, 0.0);
    const FlickerEstimate     estimate = Stack(none, none, 100.0, 20.0).Estimate();
    EXPECT_LE(estimate.flickerZ, Significance.everyPixel) << frames;
    EXPECT_TRUE(std::isfinite(estimate.offsetDn));
    EXPECT_LT(estimate.flickerSd, 0.02) << frames;
  }
}

TEST(SensorNoiseFlickerEstimate, SixStandardDeviationsOfTheNoiseAreTheThreshold)
{
  // Noise of v^*: sd = 20 / 2100 / sqrt(200) = 6.7e-4. A flicker of three times this noise: 9 / sqrt(2 / 199) = 90.
  const auto gamma = NormalFlicker(200, 0.002, 6);
  EXPECT_GT(Stack(gamma, gamma, 100.0, 20.0).Estimate().flickerZ, 30.0);
  const auto faint = NormalFlicker(200, 0.0002, 6);
  EXPECT_LT(Stack(faint, faint, 100.0, 20.0).Estimate().flickerZ, Significance.everyPixel);
}

TEST(SensorNoiseFlickerEstimate, StrongFlickerWithLittleOrNoNoiseIsIdentified)
{
  const auto gamma = NormalFlicker(30, 0.2, 8);
  EXPECT_GT(Stack(gamma, gamma, 100.0, 0.0).Estimate().flickerZ, Significance.everyPixel);
  EXPECT_GT(Stack(gamma, gamma, 100.0, 0.5).Estimate().flickerZ, Significance.everyPixel);
}

TEST(SensorNoiseFlickerEstimate, UnequalFlickerOfBrightAndDarkMissesTheLine)
{
  const FlickerEstimate estimate =
    Stack(NormalFlicker(100, 0.05, 9), NormalFlicker(100, 0.05, 10), 100.0, 20.0).Estimate();
  // v_* contains the 15 DN of the lamp at the dark half, and a noise of 1.4 DN: about 100.
  EXPECT_GT(estimate.offsetLinePhi, 30.0);
}

TEST(SensorNoiseFlickerEstimate, IdenticalFramesHaveNoFlicker)
{
  const std::vector<double> none(10, 0.0);
  const FlickerEstimate     estimate = Stack(none, none, 100.0, 0.0).Estimate();
  EXPECT_NEAR(estimate.flickerSd, 0.0, 1e-12);
  EXPECT_TRUE(std::isfinite(estimate.offsetDn));
}

TEST(SensorNoiseFlickerEstimate, ModesHaveNames)
{
  EXPECT_STREQ(NameOf(RollingShutter::Off), "off");
  EXPECT_STREQ(NameOf(RollingShutter::Auto), "auto");
  EXPECT_STREQ(NameOf(RollingShutter::Fixed), "fixed");
}
