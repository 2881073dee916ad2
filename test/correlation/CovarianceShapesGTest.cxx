// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "correlation/CorrelationSums.h"

#include <array>
#include <cstddef>
#include <gtest/gtest.h>

using namespace sensornoise;

namespace
{
constexpr std::array<double, NoiseResiduals::IntensityBins> SignalDn{ 10.0, 40.0, 100.0, 300.0 };

/** Returns V = 20 + 0.5 z. Each bin has 100 pairs at one level. */
double
VarianceAt(double signalDn)
{
  return 20.0 + 0.5 * signalDn;
}

LagSums
OwnSums()
{
  LagSums sums;
  for (std::size_t b = 0; b < SignalDn.size(); ++b)
  {
    const double z = SignalDn[b];
    const double v = VarianceAt(z);
    sums.bins[b] = { 100.0, 100.0, 100.0 / v, 100.0 * z / v, 100.0 * z * z / v };
  }
  return sums;
}

/** Standard errors that differ, so that the fit has to weight. */
const Eigen::VectorXd Errors = Eigen::Vector4d(0.001, 0.002, 0.001, 0.004);

const FittedShape &
FitOf(const std::array<FittedShape, NumberOfShapes> & fits, CovarianceShape shape)
{
  return fits[static_cast<std::size_t>(shape)];
}
} // namespace

TEST(SensorNoiseCovarianceShapes, AreRelativeToTheVariance)
{
  constexpr double quantisationDn2 = 2.0;
  const auto       shapes = CovarianceShapes(OwnSums(), 0.0, quantisationDn2).InBins();
  for (std::size_t b = 0; b < SignalDn.size(); ++b)
  {
    const double z = SignalDn[b];
    const double v = VarianceAt(z);
    const auto   row = static_cast<Eigen::Index>(b);
    EXPECT_NEAR(shapes(row, static_cast<Eigen::Index>(CovarianceShape::Variance)), (v - quantisationDn2) / v, 1e-14);
    EXPECT_NEAR(shapes(row, static_cast<Eigen::Index>(CovarianceShape::Signal)), z / v, 1e-14);
    EXPECT_NEAR(shapes(row, static_cast<Eigen::Index>(CovarianceShape::Square)), z * z / v, 1e-12);
    EXPECT_NEAR(shapes(row, static_cast<Eigen::Index>(CovarianceShape::Constant)), 1.0 / v, 1e-15);
  }
}

TEST(SensorNoiseCovarianceShapes, BinWithoutPairsHasNoCovariance)
{
  LagSums own = OwnSums();
  own.bins[2] = {};
  EXPECT_EQ(CovarianceShapes(own, 0.0, 1.0).InBins().row(2).norm(), 0.0);
}

TEST(SensorNoiseCovarianceShapes, ReadNoiseMayBeAddedAfterAFilter)
{
  constexpr double       quantisationDn2 = 2.0;
  const CovarianceShapes shapes(OwnSums(), 0.0, quantisationDn2);
  for (const std::size_t part : { std::size_t{ 1 }, PartsAfterFilter })
  {
    const auto   k = static_cast<std::size_t>(CovarianceShape::FirstPart) + part - 1;
    const double late = (20.0 - quantisationDn2) * static_cast<double>(part) / PartsAfterFilter;
    EXPECT_EQ(shapes.UnitOf(k).ofVariance, 1.0);
    EXPECT_NEAR(shapes.UnitOf(k).constantDn2, -late, 1e-12);
    for (std::size_t b = 0; b < SignalDn.size(); ++b)
    {
      const double v = VarianceAt(SignalDn[b]);
      EXPECT_NEAR(shapes.InBins()(static_cast<Eigen::Index>(b), static_cast<Eigen::Index>(k)),
                  (v - quantisationDn2 - late) / v,
                  1e-12);
    }
  }
  // If the dark offset is not known, the smallest signal is the signal of the darkest pixels.
  const auto last = NumberOfShapes - 1;
  EXPECT_NEAR(
    CovarianceShapes(OwnSums(), 6.0, quantisationDn2).UnitOf(last).constantDn2, -(21.0 + 2.0 - quantisationDn2), 1e-12);
}

TEST(SensorNoiseCovarianceShapes, EachIsRecoveredExactlyAndNoOtherFits)
{
  const auto shapes = CovarianceShapes(OwnSums(), 0.0, 2.0).InBins();
  for (Eigen::Index k = 0; k < static_cast<Eigen::Index>(CovarianceShape::FirstPart); ++k)
  {
    const double          coefficient = 0.1 / shapes.col(k).maxCoeff();
    const Eigen::VectorXd shared = coefficient * shapes.col(k);
    const auto            fits = FitShapes(shapes, shared, Errors);
    for (std::size_t other = 0; other < static_cast<std::size_t>(CovarianceShape::FirstPart); ++other)
    {
      if (static_cast<Eigen::Index>(other) == k)
      {
        EXPECT_NEAR(fits[other].coefficient / coefficient, 1.0, 1e-12) << k;
        EXPECT_NEAR(fits[other].chi2, 0.0, 1e-8) << k; // with terms of up to 1e4
      }
      else
      {
        EXPECT_GT(fits[other].chi2, 10.0) << k << " " << other;
      }
    }
  }
}

TEST(SensorNoiseCovarianceShapes, ChiSquareIsThatOfTheWeightedResiduals)
{
  const auto            shapes = CovarianceShapes(OwnSums(), 0.0, 2.0).InBins();
  const Eigen::VectorXd shared = Eigen::Vector4d(0.02, 0.05, 0.01, 0.04);
  const auto            fits = FitShapes(shapes, shared, Errors);
  for (Eigen::Index k = 0; k < shapes.cols(); ++k)
  {
    const FittedShape &  fit = fits[static_cast<std::size_t>(k)];
    const Eigen::ArrayXd left = (shared - fit.coefficient * shapes.col(k)).array() / Errors.array();
    EXPECT_NEAR(fit.chi2, left.square().sum(), 1e-8) << k;
    EXPECT_NEAR((left * shapes.col(k).array() / Errors.array()).sum(), 0.0, 1e-6) << k; // at the minimum
  }
}

TEST(SensorNoiseCovarianceShapes, BinsWithoutErrorAreLeftOut)
{
  const auto      shapes = CovarianceShapes(OwnSums(), 0.0, 0.0).InBins();
  Eigen::VectorXd shared = 0.03 * shapes.col(0);
  Eigen::VectorXd errors = Errors;
  shared(1) = 7.0;
  errors(1) = 0.0;
  EXPECT_NEAR(FitOf(FitShapes(shapes, shared, errors), CovarianceShape::Variance).coefficient, 0.03, 1e-12);
  EXPECT_EQ(FitOf(FitShapes(shapes, shared, Eigen::VectorXd::Zero(4)), CovarianceShape::Variance).coefficient, 0.0);
}
