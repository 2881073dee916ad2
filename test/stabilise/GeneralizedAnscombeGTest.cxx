// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/NoiseModel.h"

#include "stabilise/NoiseModelCheck.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <gtest/gtest.h>
#include <limits>
#include <stdexcept>
#include <vector>

using namespace sensornoise;

namespace
{
constexpr double   NaN = std::numeric_limits<double>::quiet_NaN();
constexpr double   Infinity = std::numeric_limits<double>::infinity();
constexpr unsigned ManyValues = 1000; // several blocks, and a part of one

double
Stabilised(const NoiseModel & model, double level)
{
  double result = 0.0;
  GeneralizedAnscombe(model).Stabilise(&level, 1, &result);
  return result;
}

double
Level(const NoiseModel & model, double stabilised, AnscombeInverse inverse = AnscombeInverse::ExactUnbiased)
{
  double result = 0.0;
  GeneralizedAnscombe(model).Invert(&stabilised, 1, &result, inverse);
  return result;
}

std::vector<double>
LevelsFrom(double first, double step)
{
  std::vector<double> levels(ManyValues);
  for (std::size_t i = 0; i < levels.size(); ++i)
  {
    levels[i] = first + step * static_cast<double>(i);
  }
  return levels;
}

template <typename TPixel>
TPixel
Rounded(double level)
{
  const double model[2] = { 0.5, 3.0 };
  double       stabilised = 2.0 / model[0] * std::sqrt(model[0] * level + 0.375 * 0.25 + model[1]);
  TPixel       result{};
  GeneralizedAnscombe({ model[0], model[1] }).Invert(&stabilised, 1, &result, AnscombeInverse::Algebraic);
  return result;
}
} // namespace

// 2/a sqrt(a x + 3/8 a^2 + b) with a = 2: sqrt(2 x + 1.5 + b).
TEST(GeneralizedAnscombe, IsItsFormula)
{
  EXPECT_DOUBLE_EQ(Stabilised({ 2.0, 0.5 }, 7.0), 4.0);
  EXPECT_DOUBLE_EQ(Stabilised({ 2.0, -21.5 }, 14.5), 3.0);
  EXPECT_EQ(Stabilised({ 2.0, -1.5 }, 0.0), 0.0);
  EXPECT_DOUBLE_EQ(Stabilised({ 1.0, 0.0 }, 0.0), std::sqrt(1.5)); // Anscombe's own
}

// x to s x makes a and b s a and s^2 b, and what is stabilised has no unit.
TEST(GeneralizedAnscombe, DoesNotDependOnTheUnitOfLevels)
{
  for (const double level : { 0.0, 3.0, 1000.0, 60000.0 })
  {
    const double expected = Stabilised({ 0.4, 11.0 }, level);
    EXPECT_DOUBLE_EQ(Stabilised({ 16.0 * 0.4, 256.0 * 11.0 }, 16.0 * level), expected);
    EXPECT_DOUBLE_EQ(Stabilised({ 0.3 * 0.4, 0.09 * 11.0 }, 0.3 * level), expected);
    EXPECT_NEAR(Level({ 16.0 * 0.4, 256.0 * 11.0 }, expected), 16.0 * Level({ 0.4, 11.0 }, expected), 1e-10);
  }
}

// x to x + c makes b b - a c: an offset is inside b.
TEST(GeneralizedAnscombe, KnowsTheOffsetByTheIntercept)
{
  for (const double level : { 0.0, 3.0, 1000.0 })
  {
    EXPECT_NEAR(Stabilised({ 0.5, 11.0 - 0.5 * 100.0 }, level + 100.0), Stabilised({ 0.5, 11.0 }, level), 1e-12);
  }
}

TEST(GeneralizedAnscombe, AlgebraicInverseLeadsBack)
{
  const GeneralizedAnscombe transform({ 0.37, -30.0 }); // negative arguments below 80.9 DN
  const auto                levels = LevelsFrom(85.0, 61.0);
  std::vector<double>       stabilised(levels.size());
  std::vector<double>       back(levels.size());
  EXPECT_EQ(transform.Stabilise(levels.data(), levels.size(), stabilised.data()), 0U);
  EXPECT_EQ(transform.Invert(stabilised.data(), levels.size(), back.data(), AnscombeInverse::Algebraic), 0U);
  for (std::size_t i = 0; i < levels.size(); ++i)
  {
    EXPECT_NEAR(back[i], levels[i], 1e-12 * (100.0 + levels[i]));
  }
}

// The closed form against the exact inverse, found by integration. The bounds are from its documentation.
TEST(GeneralizedAnscombe, ClosedFormIsNearTheExactInverse)
{
  for (double electrons = 0.0; electrons <= 10000.0; electrons = std::max(electrons + 0.11, 1.3 * electrons))
  {
    const double bound = electrons < 1.0 ? 0.047 : electrons < 3.0 ? 0.033 : electrons < 1000.0 ? 0.0185 : 0.0046;
    for (double readNoise = 0.0; readNoise <= 30.0; readNoise = 1.3 * readNoise + 0.1)
    {
      const StabilisedMoments moments = MomentsOfStabilised(electrons, readNoise);
      const double            found = Level({ 1.0, readNoise * readNoise }, moments.mean);
      EXPECT_NEAR(found, electrons, bound) << electrons << ' ' << readNoise;
    }
  }
}

// The same for a sensor with gain and offset: mu + g lambda.
TEST(GeneralizedAnscombe, ClosedFormKnowsGainAndOffset)
{
  constexpr double gain = 2.5;
  constexpr double offset = 100.0;
  constexpr double readNoise = 1.5; // [e-]
  const NoiseModel model{ gain, gain * gain * readNoise * readNoise - gain * offset };
  for (const double electrons : { 5.0, 80.0, 3000.0 })
  {
    const double mean = MomentsOfStabilised(electrons, readNoise).mean;
    EXPECT_NEAR(Level(model, mean), offset + gain * electrons, gain * 0.0185);
  }
}

// 1/4 D^2 - 1/8 and 1/4 D^2 - 3/8; the closed form tends to the first as sqrt(3/2) / (4 D).
TEST(GeneralizedAnscombe, InversesDifferByTheirConstants)
{
  const NoiseModel model{ 1.0, 0.0 };
  EXPECT_DOUBLE_EQ(Level(model, 10.0, AnscombeInverse::Algebraic), 24.625);
  EXPECT_DOUBLE_EQ(Level(model, 10.0, AnscombeInverse::Asymptotic), 24.875);
  const double rest = std::sqrt(1.5) * (0.025 + 0.000625) - 0.01375;
  EXPECT_NEAR(Level(model, 10.0), 24.875 + rest, 1e-13);
}

TEST(GeneralizedAnscombe, NoMeanIsBelowTheZeroLevel)
{
  const NoiseModel model{ 2.0, -50.0 };
  for (const double stabilised : { -3.0, 0.0, 1.2 })
  {
    EXPECT_NEAR(Level(model, stabilised), 25.0, 1e-14);
  }
  EXPECT_GT(Level(model, 1.23), 25.0);
  EXPECT_DOUBLE_EQ(Level(model, -3.0, AnscombeInverse::Algebraic), 25.0 - 0.375 * 2.0);
  EXPECT_DOUBLE_EQ(Level(model, -3.0, AnscombeInverse::Asymptotic), 25.0 - 0.125 * 2.0);
}

TEST(GeneralizedAnscombe, CountsNegativeArguments)
{
  const GeneralizedAnscombe transform({ 1.0, -500.375 }); // those below 500 are negative
  const auto                levels = LevelsFrom(0.0, 1.0);
  std::vector<float>        stabilised(levels.size());
  EXPECT_EQ(transform.Stabilise(levels.data(), levels.size(), stabilised.data()), 500U);
  EXPECT_EQ(transform.Stabilise(levels.data(), 3, stabilised.data()), 3U); // what pads a block is not counted
  EXPECT_EQ(stabilised[499], 0.0F);
  EXPECT_EQ(stabilised[501], 2.0F);
}

TEST(GeneralizedAnscombe, NotANumberStaysOneAndIsNotNegative)
{
  const GeneralizedAnscombe transform({ 1.0, 0.0 });
  const double              levels[3] = { NaN, Infinity, -Infinity };
  double                    stabilised[3];
  EXPECT_EQ(transform.Stabilise(levels, 3, stabilised), 1U);
  EXPECT_TRUE(std::isnan(stabilised[0]));
  EXPECT_EQ(stabilised[1], Infinity);
  EXPECT_EQ(stabilised[2], 0.0);
  for (const auto inverse : { AnscombeInverse::ExactUnbiased, AnscombeInverse::Algebraic, AnscombeInverse::Asymptotic })
  {
    EXPECT_TRUE(std::isnan(Level({ 1.0, 0.0 }, NaN, inverse)));
    EXPECT_EQ(Level({ 1.0, 0.0 }, Infinity, inverse), Infinity);
  }
  unsigned short greyValues[3] = { 1, 1, 1 };
  EXPECT_EQ(transform.Invert(stabilised, 3, greyValues, AnscombeInverse::ExactUnbiased), 1U);
  EXPECT_EQ(greyValues[0], 0);
  EXPECT_EQ(greyValues[1], 65535);
}

TEST(GeneralizedAnscombe, IntegersAreRoundedAndKeptInRange)
{
  EXPECT_EQ(Rounded<unsigned char>(7.49), 7);
  EXPECT_EQ(Rounded<unsigned char>(7.51), 8);
  EXPECT_EQ(Rounded<unsigned char>(300.0), 255);
  EXPECT_EQ(Rounded<unsigned char>(-2.0), 0);
  EXPECT_EQ(Rounded<unsigned short>(65535.4), 65535);
  EXPECT_EQ(Rounded<unsigned short>(1e9), 65535);
  EXPECT_EQ(Rounded<short>(-3.6), -4);
  EXPECT_EQ(Rounded<short>(-3.4), -3);
  EXPECT_EQ(Rounded<short>(40000.0), 32767);
}

TEST(GeneralizedAnscombe, EveryGreyValueComesBackThroughFloat)
{
  const GeneralizedAnscombe   transform({ 0.02, -1.7 }); // 50 e- a DN: the hardest for float
  std::vector<unsigned short> greyValues;
  for (int greyValue = 100; greyValue < 65536; ++greyValue)
  {
    greyValues.push_back(static_cast<unsigned short>(greyValue));
  }
  std::vector<float>          stabilised(greyValues.size());
  std::vector<unsigned short> back(greyValues.size());
  transform.Stabilise(greyValues.data(), greyValues.size(), stabilised.data());
  transform.Invert(stabilised.data(), greyValues.size(), back.data(), AnscombeInverse::Algebraic);
  EXPECT_EQ(back, greyValues);
}

TEST(GeneralizedAnscombe, HasTheSameBitsWhereverAValueStands)
{
  const GeneralizedAnscombe transform({ 0.3, 2.0 });
  const auto                levels = LevelsFrom(1.0, 3.7);
  std::vector<double>       whole(levels.size());
  std::vector<double>       parts(levels.size());
  std::vector<double>       back(levels.size());
  transform.Stabilise(levels.data(), levels.size(), whole.data());
  transform.Invert(whole.data(), levels.size(), back.data(), AnscombeInverse::ExactUnbiased);
  for (std::size_t i = 0; i < levels.size(); i += 7)
  {
    const std::size_t count = std::min<std::size_t>(7, levels.size() - i);
    transform.Stabilise(levels.data() + i, count, parts.data() + i);
  }
  EXPECT_EQ(std::memcmp(whole.data(), parts.data(), whole.size() * sizeof(double)), 0);
  transform.Invert(whole.data(), whole.size(), whole.data(), AnscombeInverse::ExactUnbiased); // in place
  EXPECT_EQ(std::memcmp(whole.data(), back.data(), whole.size() * sizeof(double)), 0);
}

TEST(GeneralizedAnscombe, InversesHaveNames)
{
  for (const auto inverse : { AnscombeInverse::ExactUnbiased, AnscombeInverse::Algebraic, AnscombeInverse::Asymptotic })
  {
    EXPECT_EQ(AnscombeInverseOf(NameOf(inverse)), inverse);
  }
  EXPECT_THROW(AnscombeInverseOf("exact"), std::invalid_argument);
  EXPECT_THROW(GeneralizedAnscombe({ 0.0, 1.0 }), std::invalid_argument);
}
