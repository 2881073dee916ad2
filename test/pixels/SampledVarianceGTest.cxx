// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "pixels/VarianceFit.h"
#include "sensornoise/Parallel.h"
#include "pixels/VarianceLine.h"
#include "helpers/StackTestHelper.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <gtest/gtest.h>
#include <optional>
#include <random>
#include <vector>

using namespace sensornoise;

namespace
{
constexpr std::size_t Pixels = 60000;
constexpr double      Dof = 30.0;
constexpr double      Gain = 0.05;
constexpr double      Intercept = -2.0;

/** Maps with means from 100 to 1,100 and the means of the neighbours. Every seventh pixel is masked and NaN. */
struct Maps
{
  std::vector<double>       mean;
  std::vector<float>        neighbourMean;
  std::vector<double>       variance;
  std::vector<float>        dof = std::vector<float>(Pixels, static_cast<float>(Dof));
  std::vector<std::uint8_t> mask = std::vector<std::uint8_t>(Pixels, 1);

  Maps()
  {
    std::mt19937                     random(44);
    std::uniform_real_distribution<> uniform(100.0, 1100.0);
    std::chi_squared_distribution<>  chiSquare(Dof);
    for (std::size_t p = 0; p < Pixels; ++p)
    {
      mask[p] = p % 7 == 3 ? 0 : 1;
      mean.push_back(mask[p] != 0 ? uniform(random) : std::nan(""));
      neighbourMean.push_back(static_cast<float>(mean.back() + 1.0));
      variance.push_back((Intercept + Gain * mean.back()) * chiSquare(random) / Dof);
    }
  }
  VarianceData
  Data() const
  {
    return { mean.data(), neighbourMean.data(), { variance.data() }, dof.data(), mask.data(), Pixels };
  }
};
} // namespace

TEST(SensorNoiseSampledVariance, HoldsTheMapsOfEvenlySpreadPixels)
{
  const Maps            maps;
  const std::size_t     counting = Pixels - (Pixels + 3) / 7;
  const SampledVariance all(maps.Data(), counting, test::Threads(3));
  const SampledVariance some(maps.Data(), 1000, test::Threads(3));
  EXPECT_EQ(all.GetData().pixels, counting);
  ASSERT_GE(some.GetData().pixels, 1000U);
  ASSERT_LT(some.GetData().pixels, 2000U);
  const VarianceData data = some.GetData();
  std::size_t        p = 0;
  for (std::size_t i = 0; i < data.pixels; ++i, ++p)
  {
    p = static_cast<std::size_t>(
      std::find(maps.mean.begin() + static_cast<std::ptrdiff_t>(p), maps.mean.end(), data.mean[i]) -
      maps.mean.begin()); // in the order of the pixels
    ASSERT_LT(p, Pixels);
    ASSERT_EQ(data.neighbourMean[i], maps.neighbourMean[p]);
    ASSERT_EQ(data.variance[i], maps.variance[p]);
    ASSERT_EQ(data.dof[i], maps.dof[p]);
    ASSERT_NE(data.mask[i], 0);
  }
  EXPECT_GT(p, Pixels - 200); // up to the end
}

TEST(SensorNoiseSampledVariance, TwoStepsLeadFromItsLineToThatOfAllPixels)
{
  const Maps            maps;
  const SampledVariance sample(maps.Data(), 1000, SerialFor);
  for (const TrimRule rule : { TrimRule::Level, TrimRule::Distance })
  {
    VarianceFit rough(sample.GetData(), SerialFor, std::nullopt, rule, 100.0);
    rough.Iterate(8);
    VarianceFit fit(maps.Data(), rough);
    fit.Iterate(2);
    VarianceFit settled(maps.Data(), SerialFor, std::nullopt, rule, 100.0);
    settled.Iterate(20);
    settled.FillErrors();
    const double error = std::sqrt(settled.GetLine().covariance(0, 0));
    EXPECT_GT(std::abs(rough.GetLine().gain - settled.GetLine().gain),
              0.5 * error); // its own error is 5 times as large
    EXPECT_NEAR(fit.GetLine().gain, settled.GetLine().gain, 0.01 * error);
    EXPECT_NEAR(
      fit.GetLine().intercept, settled.GetLine().intercept, 0.01 * std::sqrt(settled.GetLine().covariance(1, 1)));
  }
}
