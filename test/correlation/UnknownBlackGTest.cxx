// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "correlation/NoiseCorrelation.h"
#include "helpers/CorrelationTestHelper.h"
#include "simulation/Random.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <gtest/gtest.h>
#include <vector>

using namespace sensornoise;
using namespace sensornoise::test::correlation;

namespace
{
const FrameGeometry   Frame{ 256, 256, 1 };
constexpr std::size_t Frames = 30;
constexpr double      Least = 100.0; // electrons of the darkest pixels; 1 DN/e-
constexpr double      ReadNoise = 10.0;
constexpr double      Coupled = 0.02; // fraction of the charge that reaches each neighbour

/** Returns Least electrons in one half of the frame, and a ramp in the other one. */
std::vector<double>
Electrons()
{
  std::vector<double> electrons = Ramp(Frame, Least, 1000.0);
  for (std::size_t p = 0; p < electrons.size() / 2; ++p)
  {
    electrons[p] = Least;
  }
  return electrons;
}

/** Returns shot noise of \a electrons, coupled between neighbours, and read noise. */
FrameOf
CoupledNoise(const std::vector<double> & electrons)
{
  return [electrons](std::size_t t) {
    DoubleFrame         shot = WhiteNoise(Frame, 5)(t);
    CounterSeededRandom random(6, t, 0);
    for (std::size_t p = 0; p < electrons.size(); ++p)
    {
      shot.values[p] *= std::sqrt(electrons[p]);
    }
    DoubleFrame frame = shot;
    for (std::size_t p = 0; p < electrons.size(); ++p)
    {
      const std::size_t left = p % Frame.width > 0 ? p - 1 : p;
      const std::size_t right = (p + 1) % Frame.width > 0 ? p + 1 : p;
      const std::size_t above = p >= Frame.width ? p - Frame.width : p;
      const std::size_t below = p + Frame.width < electrons.size() ? p + Frame.width : p;
      const double      sum = shot.values[left] + shot.values[right] + shot.values[above] + shot.values[below];
      frame.values[p] += Coupled * (sum - 4.0 * shot.values[p]) + ReadNoise * random.Normal();
    }
    return frame;
  };
}
} // namespace

TEST(SensorNoiseUnknownBlack, CoupledChargeHasItsSlope)
{
  // The signal is measured from the darkest level, so that the covariance is no longer proportional to it.
  const std::vector<double>       electrons = Electrons();
  const std::vector<std::uint8_t> all(electrons.size(), 1);
  const NoiseResiduals            residuals(
    SampleOf(Frame, Frames, CoupledNoise(electrons)), Eigen::MatrixXd(), { electrons, all, Least, false }, SerialFor);
  const NoiseCorrelation found = MeasureNoiseCorrelation(residuals, 0.0, SerialFor);
  EXPECT_EQ(found.kind, NoiseKind::Crosstalk);
  // The covariance with all neighbours is the decrease of the shot noise of the pixel.
  const double left = std::pow(1.0 - 4.0 * Coupled, 2.0) + 4.0 * Coupled * Coupled;
  double       slope = 0.0;
  double       variance = 0.0;
  for (const WeightedShape & shape : found.shapes)
  {
    const double unit = shape.ofVariance * left + shape.ofSignal;
    slope += shape.probability * shape.coefficient.value * unit;
    variance += shape.probability * std::pow(shape.coefficient.standardError * unit, 2.0);
  }
  EXPECT_NEAR(slope, 1.0 - left, 4.5 * std::sqrt(variance));
  EXPECT_LT(std::sqrt(variance), 0.01);
}
