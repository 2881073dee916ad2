// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "correlation/CorrelationSums.h"
#include "correlation/NoiseCorrelation.h"
#include "helpers/CorrelationTestHelper.h"

#include <cmath>
#include <cstddef>
#include <gtest/gtest.h>
#include <vector>

using namespace sensornoise;
using namespace sensornoise::test::correlation;

namespace
{
const FrameGeometry   Frame{ 192, 128, 1 };
constexpr std::size_t Frames = 60;
constexpr double      ReadNoiseDn2 = 9.0;

/** Returns shot noise of 1 DN/e- after a running mean of weights 1/4, 1/2, 1/4 along the rows, with read noise that is
 * added \a before or after this filter. */
NoiseResiduals
Filtered(bool before)
{
  const std::vector<double> signal = Ramp(Frame, 4.0, 100.0);
  const FrameOf             shot = WhiteNoise(Frame, 21);
  const FrameOf             read = WhiteNoise(Frame, 22);
  return ComputeResiduals(Frame, Frames, signal, [=](std::size_t t) {
    DoubleFrame       in = shot(t);
    const DoubleFrame own = read(t);
    for (std::size_t p = 0; p < in.values.size(); ++p)
    {
      in.values[p] = std::sqrt(signal[p]) * in.values[p] + (before ? std::sqrt(ReadNoiseDn2) * own.values[p] : 0.0);
    }
    DoubleFrame out = in;
    for (std::size_t p = 1; p + 1 < in.values.size(); ++p)
    {
      out.values[p] = 0.25 * in.values[p - 1] + 0.5 * in.values[p] + 0.25 * in.values[p + 1] +
                      (before ? 0.0 : std::sqrt(ReadNoiseDn2) * own.values[p]);
    }
    return out;
  });
}

void
ExpectLine(const CovarianceLine & line, const Lag & lag, double slope, double intercept)
{
  EXPECT_EQ(line.lag.x, lag.x);
  EXPECT_EQ(line.lag.y, lag.y);
  EXPECT_NEAR(line.slopeDn.value, slope, 4.5 * line.slopeDn.standardError) << lag.x << " " << lag.y;
  EXPECT_NEAR(line.interceptDn2.value, intercept, 4.5 * line.interceptDn2.standardError) << lag.x << " " << lag.y;
  EXPECT_LT(line.slopeDn.standardError, 0.02);
  EXPECT_LT(line.interceptDn2.standardError, 0.6);
}

/** Returns the covariance with all neighbours at the signal \a signalDn and the variance \a varianceDn2, averaged over
 * the shapes. */
double
CovarianceAt(const NoiseCorrelation & found, double signalDn, double varianceDn2)
{
  double sum = 0.0;
  for (const WeightedShape & shape : found.shapes)
  {
    sum += shape.probability * shape.coefficient.value *
           (shape.ofVariance * varianceDn2 + shape.ofSignal * signalDn + shape.constantDn2);
  }
  return sum;
}
} // namespace

TEST(SensorNoiseCovarianceLines, EachLagHasItsOwnTwoNumbers)
{
  for (const bool before : { false, true })
  {
    const NoiseResiduals  residuals = Filtered(before);
    const CorrelationSums sums(residuals, 0.0, 2, 3, SerialFor);
    const auto            lines = FitCovarianceLines(sums, sums.Nearest());
    ASSERT_EQ(lines.size(), 3U);
    ExpectLine(lines[0], { 0, 0, 0 }, 0.375, before ? 0.375 * ReadNoiseDn2 : ReadNoiseDn2);
    ExpectLine(lines[1], { 1, 0, 0 }, 0.25, before ? 0.25 * ReadNoiseDn2 : 0.0);
    ExpectLine(lines[2], { 0, 1, 0 }, 0.0, 0.0);
  }
}

TEST(SensorNoiseCovarianceLines, CorrelationShowsWhetherTheReadNoiseWasFiltered)
{
  const NoiseCorrelation late = MeasureNoiseCorrelation(Filtered(false), 0.0, SerialFor);
  EXPECT_EQ(late.kind, NoiseKind::Filtered);
  EXPECT_GT(late.ProbabilityOfLateNoise(), 0.95);
  EXPECT_NEAR(CovarianceAt(late, 0.0, ReadNoiseDn2), 0.0, 2.0);
  EXPECT_NEAR(CovarianceAt(late, 100.0, 37.5 + ReadNoiseDn2), 62.5, 2.0);
  EXPECT_EQ(late.covarianceLines.size(), 1U + 2U * static_cast<std::size_t>(late.reach * (late.reach + 1)));

  const NoiseCorrelation early = MeasureNoiseCorrelation(Filtered(true), 0.0, SerialFor);
  EXPECT_LT(early.ProbabilityOfLateNoise(), 0.05);
  EXPECT_NEAR(CovarianceAt(early, 0.0, 0.375 * ReadNoiseDn2), 0.625 * ReadNoiseDn2, 0.8);
  EXPECT_NEAR(CovarianceAt(early, 100.0, 37.5 + 0.375 * ReadNoiseDn2), 62.5 + 0.625 * ReadNoiseDn2, 2.0);
}
