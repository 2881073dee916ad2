// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "report/ReportParts.h"

#include "sensornoise/FrameGeometry.h"
#include "report/Quantities.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <gtest/gtest.h>
#include <random>

/** \file
 * Squares of the shift add an apparent shift to each plane, with opposite signs in R and B. The mean of the planes
 * contains neither this shift nor most of the noise. */

using namespace sensornoise;

namespace
{
constexpr std::size_t Frames = 200;

/** Returns reports with an rms motion of \a scale times (0.05, 0.02) pixels and noise of \a noiseSd pixels. In each
 * plane \a ofSquare times the squared motion is added, with a sign by the plane's columns along x and by its rows along
 * y. */
std::array<Report, 4>
PlanesOf(double scale, double ofSquare, double noiseSd)
{
  std::mt19937                     random(5);
  std::normal_distribution<double> normal;
  std::array<Report, 4>            reports;
  for (Report & report : reports)
  {
    report.framesDistinct = Frames;
    report.vibrationSdX = WithError(0.06, 0.001);
    report.vibrationSdY = WithError(0.03, 0.0005);
    report.vibrationCovariance = WithError(0.0, 1e-5);
  }
  for (std::size_t t = 0; t < Frames; ++t)
  {
    const double x = scale * 0.05 * normal(random);
    const double y = scale * 0.02 * normal(random);
    for (const BayerPlane plane : BayerPlanes)
    {
      const auto   corner = CornerOf(BayerPattern::RGGB, plane);
      const double signX = corner[0] == 0 ? 1.0 : -1.0;
      const double signY = corner[1] == 0 ? 1.0 : -1.0;
      reports.at(static_cast<std::size_t>(plane))
        .motion.push_back({ x + signX * ofSquare * x * x + noiseSd * normal(random),
                            y + signY * ofSquare * y * y + noiseSd * normal(random) });
    }
  }
  return reports;
}

double
VarianceOf(const std::array<Report, 4> & planes, std::size_t axis, std::size_t with)
{
  std::array<double, 2> mean{};
  for (const auto & shift : planes[0].motion)
  {
    mean[0] += shift[0] / Frames;
    mean[1] += shift[1] / Frames;
  }
  double sum = 0.0;
  for (const auto & shift : planes[0].motion)
  {
    sum += (shift[axis] - mean[axis]) * (shift[with] - mean[with]);
  }
  return sum / (Frames - 1.0);
}
} // namespace

TEST(JointMotion, SquaresOfTheShiftCancel)
{
  const auto clean = PlanesOf(1.0, 0.0, 0.0);
  const auto joint = JoinMotion(PlanesOf(1.0, 5.0, 0.0));
  ASSERT_TRUE(joint);
  const double x = VarianceOf(clean, 0, 0);
  const double y = VarianceOf(clean, 1, 1);
  EXPECT_NEAR(*joint->sdX.value, std::sqrt(x), 1e-12);
  EXPECT_NEAR(*joint->sdY.value, std::sqrt(y), 1e-12);
  EXPECT_NEAR(*joint->covariance.value, VarianceOf(clean, 0, 1), 1e-12);
  // No noise: what is left is the smallest of the planes' errors.
  EXPECT_NEAR(*joint->sdX.standardError, 0.001, 1e-9);
  EXPECT_NEAR(*joint->sdY.standardError, 0.0005, 1e-9);
  EXPECT_NEAR(*joint->covariance.standardError, 1e-5, 1e-9);
  ASSERT_EQ(joint->series.size(), Frames);
  EXPECT_NEAR(joint->series[3][0] - joint->series[7][0], clean[0].motion[3][0] - clean[0].motion[7][0], 1e-12);
}

TEST(JointMotion, NoiseOfThePlanesIsInTheErrorAlone)
{
  auto planes = PlanesOf(1.0, 0.0, 0.03);
  for (Report & plane : planes)
  {
    plane.vibrationSdX.standardError.reset();
  }
  const auto   joint = JoinMotion(planes);
  const double truth = std::sqrt(VarianceOf(PlanesOf(1.0, 0.0, 0.0), 0, 0));
  // Each half has the noise 0.03 / sqrt 2: the square's error is sqrt((s^2 + n^2 / 4) n^2 / 199), n^2 = 0.03^2.
  const double expected = std::sqrt((truth * truth + 0.25 * 9e-4) * 9e-4 / 199.0) / (2.0 * truth);
  EXPECT_NEAR(*joint->sdX.standardError, expected, 0.15 * expected); // 200 frames determine n^2 to 10 %
  EXPECT_NEAR(*joint->sdX.value, truth, 4.0 * expected);
  EXPECT_EQ(JoinMotion(PlanesOf(0.0, 0.0, 0.03))->sdX.status, EstimateStatus::UpperLimit);
}

TEST(JointMotion, NeedsAllPlanes)
{
  auto planes = PlanesOf(1.0, 0.0, 0.0);
  planes[2].motion.clear();
  EXPECT_FALSE(JoinMotion(planes));
}

TEST(JointMotion, WidensWhatDiffersFromIt)
{
  auto        planes = PlanesOf(1.0, 0.0, 0.0);
  JointMotion joint;
  joint.sdX = WithError(0.056, 0.0001);
  joint.sdY = UpperLimit(0.01);
  joint.covariance = WithError(0.0, 1e-6);
  WidenVibration(planes, joint);
  EXPECT_DOUBLE_EQ(*planes[1].vibrationSdX.value, 0.06);
  EXPECT_DOUBLE_EQ(*planes[1].vibrationSdX.standardError, std::hypot(0.001, 0.004));
  EXPECT_DOUBLE_EQ(*planes[1].vibrationSdX.interval95->high, 0.06 + 1.96 * std::hypot(0.001, 0.004));
  EXPECT_DOUBLE_EQ(*planes[1].vibrationSdY.standardError, 0.0005); // nothing to hold it against
  EXPECT_DOUBLE_EQ(*planes[1].vibrationCovariance.standardError, 1e-5);
  joint.sdX = WithError(0.3, 0.0001);
  WidenVibration(planes, joint);
  EXPECT_DOUBLE_EQ(*planes[1].vibrationSdX.interval95->low, 0.0);
}
