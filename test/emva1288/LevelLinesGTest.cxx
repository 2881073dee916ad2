// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "emva1288/EvaluationSteps.h"
#include "simulation/Random.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <gtest/gtest.h>
#include <vector>

using namespace sensornoise;

namespace
{
constexpr double Slope = 2.0;
constexpr double Intercept = 5.0;
constexpr int    Lines = 400;

/** Returns values about a line, whose standard deviations rise from 0.1 to 8, multiplied by \a scale. Without known
 * variances the values have equal standard deviations. */
std::vector<LevelValue>
DrawValues(std::uint64_t seed, double scale, bool areKnown)
{
  CounterSeededRandom     random(seed);
  std::vector<LevelValue> values;
  for (int i = 0; i < 12; ++i)
  {
    const double x = 1.0 + i;
    const double sd = areKnown ? 0.1 * std::pow(1.5, i) : 1.0;
    values.push_back({ x, Intercept + Slope * x + scale * sd * random.Normal(), areKnown ? sd * sd : 0.0 });
  }
  return values;
}

/** Root mean squares of the errors of slopes and intercepts, in standard errors, and the mean reduced chi-square. */
struct Calibration
{
  double slope{ 0.0 };
  double intercept{ 0.0 };
  double reducedChi2{ 0.0 };
};

template <typename TFit>
Calibration
Calibrate(TFit fit, double scale, bool areKnown)
{
  Calibration mean;
  for (std::uint64_t seed = 0; seed < Lines; ++seed)
  {
    const LevelLine line = fit(DrawValues(seed, scale, areKnown));
    mean.slope += std::pow((line.slope - Slope) / line.slopeStandardError, 2) / Lines;
    mean.intercept += std::pow((line.intercept - Intercept) / line.interceptStandardError, 2) / Lines;
    mean.reducedChi2 += line.reducedChi2 / Lines;
  }
  return { std::sqrt(mean.slope), std::sqrt(mean.intercept), mean.reducedChi2 };
}
} // namespace

TEST(SensorNoiseEmvaLines, ExactValuesGiveTheLineWithAnyWeights)
{
  for (const LevelLine & line : { FitLevelLine(DrawValues(1, 0.0, true)),
                                  FitWeightedLine(DrawValues(1, 0.0, true)),
                                  FitRelativeLine(DrawValues(1, 0.0, true)) })
  {
    EXPECT_NEAR(line.slope, Slope, 1e-12);
    EXPECT_NEAR(line.intercept, Intercept, 1e-11);
  }
  EXPECT_NEAR(FitLineThroughOrigin({ { 1.0, 3.0, 0.0 }, { 2.0, 5.0, 0.0 } }).slope, 13.0 / 5.0, 1e-14);
}

TEST(SensorNoiseEmvaLines, StandardErrorsAreTheScatterOfTheLines)
{
  // The ratio of 400 lines is known to 1 / sqrt(800) = 3.5 %; errors never shrink, so that it may be below 1 by what
  // reduced chi-squares above 1 add, 10 % with 10 degrees of freedom.
  for (const Calibration & found : { Calibrate(FitLevelLine, 1.0, true), Calibrate(FitWeightedLine, 1.0, true) })
  {
    EXPECT_NEAR(found.slope, 0.95, 0.12);
    EXPECT_NEAR(found.intercept, 0.95, 0.12);
    EXPECT_NEAR(found.reducedChi2, 1.0, 0.15);
  }
}

TEST(SensorNoiseEmvaLines, StandardErrorsGrowWithTheScatter)
{
  // The scatter of 12 values is known to 22 %: errors in units of it have Student's distribution of 10 degrees of
  // freedom, whose standard deviation is sqrt(10 / 8).
  const double student = std::sqrt(10.0 / 8.0);
  EXPECT_NEAR(Calibrate(FitWeightedLine, 5.0, true).slope, student, 0.15);
  EXPECT_NEAR(Calibrate(FitWeightedLine, 5.0, true).reducedChi2, 25.0, 3.0);
  EXPECT_NEAR(Calibrate(FitLevelLine, 5.0, false).slope, student, 0.15);
  EXPECT_NEAR(Calibrate(FitLevelLine, 5.0, false).intercept, student, 0.15);
  EXPECT_GT(Calibrate(FitLevelLine, 5.0, true).reducedChi2, 15.0);
}
