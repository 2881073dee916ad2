// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "limits/CramerRaoBound.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <gtest/gtest.h>
#include <stdexcept>
#include <string>
#include <vector>

using namespace sensornoise;

namespace
{
constexpr std::size_t Width = 40;
constexpr std::size_t Height = 30;

/** A stack's plan that owns its scene. */
struct Plan
{
  std::vector<double>       flux = std::vector<double>(Width * Height); ///< [DN]
  std::vector<std::uint8_t> mask = std::vector<std::uint8_t>(Width * Height, 1);
  std::size_t               width{ Width };
  double                    gain{ 1.2 };
  double                    offset{ 90.0 };
  double                    readNoise{ 6.0 };
  double                    step{ 1.0 };
  std::size_t               frames{ 80 };
  double                    flickerSd{ 0.03 };

  PrecisionLimit
  Limit() const
  {
    std::vector<double> mean;
    for (const double value : flux)
    {
      mean.push_back(value + offset);
    }
    const double variance = readNoise * readNoise + step * step / 12.0;
    return ComputePrecisionLimit(
      { mean.data(), mask.data(), width, flux.size() / width, gain, offset, variance, step, frames, flickerSd });
  }
};

/** Levels from 20 to 1520 DN, smooth along both axes. */
Plan
SmoothPlan()
{
  Plan plan;
  for (std::size_t p = 0; p < plan.flux.size(); ++p)
  {
    const auto x = static_cast<double>(p % Width);
    const auto y = static_cast<double>(p / Width);
    plan.flux[p] = 770.0 + 750.0 * std::sin(0.31 * x) * std::cos(0.17 * y + 0.02 * x);
  }
  return plan;
}

/** Expects equality but for the rounding of sums of 1200 terms. */
void
ExpectSame(double a, double b)
{
  EXPECT_NEAR(a, b, 1e-10 * std::abs(b));
}

/** Expects equal limits, except for the intercept, which depends on the origin of the grey scale. */
void
ExpectSameButIntercept(const PrecisionLimit & a, const PrecisionLimit & b, double factor = 1.0)
{
  ExpectSame(a.gain, factor * b.gain);
  ExpectSame(a.offset, factor * b.offset);
  ExpectSame(a.readNoise, factor * b.readNoise);
  ExpectSame(a.flickerOfFrame, factor * b.flickerOfFrame);
  ExpectSame(a.flickerSd, factor * b.flickerSd);
  ExpectSame(a.vibrationXOfFrame, factor * b.vibrationXOfFrame);
  ExpectSame(a.vibrationYOfFrame, factor * b.vibrationYOfFrame);
  ExpectSame(a.vibrationSdX, factor * b.vibrationSdX);
  ExpectSame(a.vibrationSdY, factor * b.vibrationSdY);
}

std::string
ErrorOf(const Plan & plan)
{
  try
  {
    plan.Limit();
    return "";
  }
  catch (const std::invalid_argument & error)
  {
    return error.what();
  }
}
} // namespace

// With two levels everything is two averages: of the variance, which have the relative error sqrt(2 / ((T-1) n)), and
// of the response to the flicker, sum gamma_t u_t / sum gamma_t^2 = q, which has the variance V / (n (T-1)
// sigma_gamma^2).
TEST(SensorNoisePrecisionLimit, TwoLevelsAreTwoPointsOfALine)
{
  Plan                  plan;
  constexpr double      low = 100.0;
  constexpr double      high = 900.0;
  constexpr std::size_t dark = 10 * Width;
  for (std::size_t p = 0; p < plan.flux.size(); ++p)
  {
    plan.flux[p] = p < dark ? low : high;
  }
  const PrecisionLimit limit = plan.Limit();
  const double         s = plan.readNoise * plan.readNoise + 1.0 / 12.0;
  const double         dof = static_cast<double>(plan.frames - 1);
  const double         variances[] = { plan.gain * low + s, plan.gain * high + s };
  const double         counts[] = { dark, Width * Height - dark };
  const auto           squared = [](double value) { return value * value; };
  const double         lowError = 2.0 * squared(variances[0]) / (dof * counts[0]);
  const double         highError = 2.0 * squared(variances[1]) / (dof * counts[1]);
  const double         span = squared(high - low);
  const double         gainVariance = (lowError + highError) / span;
  const double         interceptVariance =
    (squared(high + plan.offset) * lowError + squared(low + plan.offset) * highError) / span;
  const double covariance = -((high + plan.offset) * lowError + (low + plan.offset) * highError) / span;
  ExpectSame(limit.gain, std::sqrt(gainVariance));
  ExpectSame(limit.intercept, std::sqrt(interceptVariance));
  ExpectSame(limit.gainInterceptCorrelation, covariance / std::sqrt(gainVariance * interceptVariance));

  const double flickerSum = dof * squared(plan.flickerSd);
  const double lowResponse = variances[0] / (counts[0] * flickerSum);
  const double highResponse = variances[1] / (counts[1] * flickerSum);
  const double offsetVariance = (squared(high) * lowResponse + squared(low) * highResponse) / span;
  ExpectSame(limit.offset, std::sqrt(offsetVariance));
  // sigma^2 is the line's value at mu: an extrapolation by the distance of the levels from mu.
  const double readVarianceVariance =
    (squared(high) * lowError + squared(low) * highError) / span + squared(plan.gain) * offsetVariance;
  ExpectSame(limit.readNoise, std::sqrt(readVarianceVariance) / (2.0 * plan.readNoise));
  const double information = squared(low) * counts[0] / variances[0] + squared(high) * counts[1] / variances[1];
  ExpectSame(limit.flickerOfFrame, 1.0 / std::sqrt(information));
}

TEST(SensorNoisePrecisionLimit, FlickerOfUnknownOffsetIsLessCertain)
{
  // u_t - ubar of unit flicker is q: with mu unknown, q is known up to a constant d, which changes sigma_gamma by
  // -(A1/A2) sigma_gamma d; the rest is the mean of T-1 independent errors.
  const Plan           plan = SmoothPlan();
  const PrecisionLimit limit = plan.Limit();
  double               a1 = 0.0;
  double               a2 = 0.0;
  for (const double q : plan.flux)
  {
    const double variance = plan.gain * q + plan.readNoise * plan.readNoise + 1.0 / 12.0;
    a1 += q / variance;
    a2 += q * q / variance;
  }
  const double ofNoise = limit.flickerOfFrame / std::sqrt(79.0);
  const double ofOffset = a1 / a2 * plan.flickerSd * limit.offset;
  ExpectSame(limit.flickerSd, std::sqrt(ofNoise * ofNoise + ofOffset * ofOffset));
}

TEST(SensorNoisePrecisionLimit, RampGivesVibrationByItsSlope)
{
  Plan plan;
  for (std::size_t p = 0; p < plan.flux.size(); ++p)
  {
    plan.flux[p] = 500.0 + 7.0 * static_cast<double>(p % Width);
  }
  plan.gain = 1e-9; // the same noise variance everywhere, 36 + 1/12
  const PrecisionLimit limit = plan.Limit();
  const double         pixels = (Width - 2) * Height; // the others have no centred difference
  EXPECT_NEAR(limit.vibrationXOfFrame, std::sqrt((36.0 + 1.0 / 12.0) / pixels) / 7.0, 1e-7);
  ExpectSame(limit.vibrationSdX, limit.vibrationXOfFrame / std::sqrt(79.0));
  EXPECT_EQ(limit.vibrationYOfFrame, PrecisionLimit::None);
  EXPECT_EQ(limit.vibrationSdY, PrecisionLimit::None);
}

TEST(SensorNoisePrecisionLimit, OriginOfTheGreyScaleMovesTheInterceptOnly)
{
  Plan                 plan = SmoothPlan();
  const PrecisionLimit before = plan.Limit();
  const double         shift = 300.0;
  plan.offset += shift;
  const PrecisionLimit after = plan.Limit();
  ExpectSameButIntercept(after, before);
  // c -> c - g shift.
  const double covariance = before.gainInterceptCorrelation * before.gain * before.intercept;
  ExpectSame(after.intercept,
             std::sqrt(before.intercept * before.intercept + shift * shift * before.gain * before.gain -
                       2.0 * shift * covariance));
}

TEST(SensorNoisePrecisionLimit, GreyScaleTwiceAsFine)
{
  Plan                 plan = SmoothPlan();
  const PrecisionLimit before = plan.Limit();
  for (double & value : plan.flux)
  {
    value *= 2.0;
  }
  plan.gain *= 2.0;
  plan.offset *= 2.0;
  plan.readNoise *= 2.0;
  plan.step *= 2.0;
  const PrecisionLimit after = plan.Limit();
  ExpectSame(after.gain, 2.0 * before.gain);
  ExpectSame(after.intercept, 4.0 * before.intercept);
  ExpectSame(after.offset, 2.0 * before.offset);
  ExpectSame(after.readNoise, 2.0 * before.readNoise);
  ExpectSame(after.flickerSd, before.flickerSd);
  ExpectSame(after.vibrationSdX, before.vibrationSdX);
  ExpectSame(after.gainInterceptCorrelation, before.gainInterceptCorrelation);
}

// Shot noise alone, V = g q, and mu = 0: with four times the electrons, the relative error of V is the same, and the
// relative error of the flux is halved.
TEST(SensorNoisePrecisionLimit, FourTimesTheElectrons)
{
  Plan plan = SmoothPlan();
  plan.offset = 0.0;
  plan.readNoise = 0.0;
  plan.step = 0.0;
  const PrecisionLimit before = plan.Limit();
  for (double & value : plan.flux)
  {
    value *= 4.0;
  }
  const PrecisionLimit after = plan.Limit();
  ExpectSame(after.gain, before.gain);
  ExpectSame(after.intercept, 4.0 * before.intercept);
  ExpectSame(after.offset, 2.0 * before.offset);
  ExpectSame(after.flickerSd, 0.5 * before.flickerSd);
  ExpectSame(after.vibrationSdX, 0.5 * before.vibrationSdX);
  EXPECT_EQ(after.readNoise, PrecisionLimit::None); // the derivative of sigma with sigma^2 is infinite at 0
}

TEST(SensorNoisePrecisionLimit, TwiceThePixelsHalveTheVariance)
{
  Plan plan = SmoothPlan();
  for (std::size_t p = 0; p < plan.flux.size(); ++p)
  {
    const std::size_t y = p / Width;
    plan.mask[p] = y > 0 && y + 1 < Height ? 1 : 0; // where two copies meet, the gradient is another one
  }
  const PrecisionLimit once = plan.Limit();
  const auto           flux = plan.flux;
  const auto           mask = plan.mask;
  plan.flux.insert(plan.flux.end(), flux.begin(), flux.end());
  plan.mask.insert(plan.mask.end(), mask.begin(), mask.end());
  const PrecisionLimit twice = plan.Limit();
  ExpectSameButIntercept(twice, once, std::sqrt(0.5));
  ExpectSame(twice.intercept, std::sqrt(0.5) * once.intercept);
}

TEST(SensorNoisePrecisionLimit, MaskedPixelsDoNotCount)
{
  Plan              plan = SmoothPlan();
  const std::size_t p = 12 * Width + 9;
  plan.mask[p] = 0;
  const PrecisionLimit before = plan.Limit();
  plan.flux[p] = -1e6;
  ExpectSame(plan.Limit().gain, before.gain);
  ExpectSame(plan.Limit().offset, before.offset);
  plan.flux[p] = std::nan(""); // its neighbours have no gradient then
  ExpectSame(plan.Limit().gain, before.gain);
  EXPECT_GT(plan.Limit().vibrationSdX, before.vibrationSdX);
}

TEST(SensorNoisePrecisionLimit, TwiceTheFlickerHalvesTheOffsetsError)
{
  Plan                 plan = SmoothPlan();
  const PrecisionLimit before = plan.Limit();
  plan.flickerSd *= 2.0;
  ExpectSame(plan.Limit().offset, 0.5 * before.offset);
  ExpectSame(plan.Limit().gain, before.gain);
}

TEST(SensorNoisePrecisionLimit, WithoutFlickerNeitherOffsetNorReadNoise)
{
  Plan plan = SmoothPlan();
  plan.flickerSd = 0.0;
  const PrecisionLimit limit = plan.Limit();
  EXPECT_EQ(limit.offset, PrecisionLimit::None);
  EXPECT_EQ(limit.readNoise, PrecisionLimit::None);
  ExpectSame(limit.gain, SmoothPlan().Limit().gain);
  ExpectSame(limit.intercept, SmoothPlan().Limit().intercept);
  EXPECT_GT(limit.flickerSd, 0.0);
  EXPECT_LT(limit.flickerSd, 1e-2);
}

TEST(SensorNoisePrecisionLimit, SceneOfOneLevelHasNoLine)
{
  Plan plan;
  plan.flux.assign(plan.flux.size(), 431.7);
  const PrecisionLimit limit = plan.Limit();
  EXPECT_EQ(limit.gain, PrecisionLimit::None);
  EXPECT_EQ(limit.intercept, PrecisionLimit::None);
  EXPECT_EQ(limit.offset, PrecisionLimit::None);
  EXPECT_EQ(limit.readNoise, PrecisionLimit::None);
  EXPECT_EQ(limit.flickerSd, PrecisionLimit::None);
}

TEST(SensorNoisePrecisionLimit, NoPixelNoPrecision)
{
  Plan plan = SmoothPlan();
  plan.mask.assign(plan.mask.size(), 0);
  EXPECT_EQ(plan.Limit().gain, PrecisionLimit::None);
  EXPECT_EQ(plan.Limit().flickerOfFrame, PrecisionLimit::None);
}

TEST(SensorNoisePrecisionLimit, RefusesWhatCannotBe)
{
  Plan plan = SmoothPlan();
  plan.frames = 1;
  EXPECT_NE(ErrorOf(plan).find("1 frames"), std::string::npos);
  plan.frames = 2;
  EXPECT_EQ(ErrorOf(plan), "");
  plan.gain = 0.0;
  EXPECT_NE(ErrorOf(plan).find("gain"), std::string::npos);
}
