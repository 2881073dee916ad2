// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/NoiseModel.h"

#include <gtest/gtest.h>
#include <limits>
#include <stdexcept>
#include <string>

using namespace sensornoise;

namespace
{
/** Slope and total intercept only: offset, gain and read noise have failed, as in a report of smoothed frames. */
Report
ReportOf(double slope, double intercept)
{
  Report report;
  report.varianceSlope = Quantity::Identified(slope);
  report.totalIntercept = Quantity::Identified(intercept);
  return report;
}

std::string
ErrorOf(const Report & report)
{
  try
  {
    NoiseModelOf(report);
  }
  catch (const std::invalid_argument & error)
  {
    return error.what();
  }
  return "no error";
}
} // namespace

TEST(NoiseModel, AsksForSlopeAndInterceptOnly)
{
  const NoiseModel model = NoiseModelOf(ReportOf(0.5, -40.0));
  EXPECT_EQ(model.varianceSlopeDn, 0.5);
  EXPECT_EQ(model.totalInterceptDn2, -40.0);
  EXPECT_EQ(model.VarianceAt(100.0), 10.0);
}

TEST(NoiseModel, SaysWhatIsMissing)
{
  Report report = ReportOf(0.5, 3.0);
  report.totalIntercept = Quantity::Without(EstimateStatus::NotIdentifiable);
  EXPECT_EQ(ErrorOf(report),
            "the report's total_intercept has no value (it is not identifiable); expected a report that has "
            "variance_slope and total_intercept");
  report.varianceSlope = Quantity::Without(EstimateStatus::Failed);
  EXPECT_EQ(ErrorOf(report),
            "the report's variance_slope has no value (it is failed); expected a report that has variance_slope and "
            "total_intercept");
}

TEST(NoiseModel, RefusesASlopeThatIsNotAboveZero)
{
  EXPECT_EQ(ErrorOf(ReportOf(-0.25, 3.0)),
            "the variance slope is -0.25; expected a finite number above 0 [DN/e-], the report's variance_slope");
  EXPECT_NE(ErrorOf(ReportOf(0.0, 3.0)), "no error");
  EXPECT_NE(ErrorOf(ReportOf(std::numeric_limits<double>::infinity(), 3.0)), "no error");
  EXPECT_NE(ErrorOf(ReportOf(std::numeric_limits<double>::quiet_NaN(), 3.0)), "no error");
  EXPECT_EQ(ErrorOf(ReportOf(1.0, -std::numeric_limits<double>::infinity())),
            "the total intercept is -inf; expected a finite number [DN^2], the report's total_intercept");
}
