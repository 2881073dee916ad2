// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "report/StackReport.h"
#include "sensornoise/ReportPage.h"
#include "sensornoise/ReportText.h"

#include <gtest/gtest.h>
#include <string>

using namespace sensornoise;

namespace
{
/** Returns a linearity error of 0.5 % +- 0.02 %, offset 100 +- 0.5 DN. */
ExposureFit
Fit()
{
  ExposureFit fit;
  fit.squaredError = FittedNumber{ 0.25e-4, 0.02e-4 };
  fit.dof = 1e6;
  fit.offsetDn = FittedNumber{ 100.0, 0.5 };
  fit.responsivity = FittedNumber{ 35.0, 0.1 };
  fit.saturationDn = 4095.0;
  fit.saturationSource = "code range";
  fit.levels = { { 1.0, 2, 135.0, std::nullopt }, { 50.0, 3, 1850.0, 0.005 }, { 99.0, 4, 3400.0, -0.0025 } };
  return fit;
}

Report
ReportOf(const ExposureFit & fit)
{
  Report report;
  ReportLinearity(report, fit);
  return report;
}

bool
Has(const std::string & text, const std::string & part)
{
  return text.find(part) != std::string::npos;
}
} // namespace

TEST(SensorNoiseLinearityReport, WithoutExposuresItIsNotIdentifiable)
{
  Report report;
  ReportLinearity(report, std::nullopt);
  const std::string json = ToJson(report);
  EXPECT_TRUE(Has(json, R"("linearity": {"status": "not-identifiable", "reason": "no exposures were given", )"))
    << json;
  EXPECT_TRUE(Has(json, R"("levels": [])"));
  EXPECT_FALSE(Has(MakeTable(report), "linearity"));
  EXPECT_FALSE(Has(ToHtml(report, {}), "<h2>Linearity</h2>"));
}

TEST(SensorNoiseLinearityReport, ValuesArePercentWithErrors)
{
  const Report report = ReportOf(Fit());
  EXPECT_EQ(report.linearity.errorPercent.status, EstimateStatus::Identified);
  EXPECT_NEAR(*report.linearity.errorPercent.value, 0.5, 1e-12);
  EXPECT_NEAR(*report.linearity.errorPercent.standardError, 0.02, 1e-12); // d sqrt(s) = ds / (2 sqrt(s))
  EXPECT_EQ(report.linearity.reason, "");
  EXPECT_EQ(report.linearity.offsetSource, "line");
  EXPECT_EQ(*report.linearity.levels[1].deviationPercent, 0.5);
  EXPECT_FALSE(report.linearity.levels[0].deviationPercent);
  const std::string json = ToJson(report);
  EXPECT_TRUE(Has(json, R"("status": "identified", "reason": null)"));
  EXPECT_TRUE(Has(json, R"({"exposure": 1, "frames": 2, "mean_dn": 135, "deviation_percent": null})")) << json;
  const std::string table = MakeTable(report);
  EXPECT_TRUE(Has(table, "\nlinearity error                 0.500 \u00B1 0.020      %        identified")) << table;
  EXPECT_TRUE(
    Has(table, "\nlinearity: 2 of 3 exposures in the range, saturation 4095 DN (DN range), offset of the line"))
    << table;
  const std::string page = ToHtml(report, {});
  EXPECT_TRUE(Has(page, "<h2>Linearity</h2>"));
  EXPECT_TRUE(Has(page, "outside of the range"));
}

TEST(SensorNoiseLinearityReport, AnIntervalThatHoldsZeroIsAnUpperLimit)
{
  ExposureFit fit = Fit();
  fit.squaredError = FittedNumber{ 1e-6, 1e-6 };
  const Report report = ReportOf(fit);
  EXPECT_EQ(report.linearity.errorPercent.status, EstimateStatus::UpperLimit);
  EXPECT_TRUE(Has(MakeTable(report), "\nlinearity error               < 0.172  "));
}

TEST(SensorNoiseLinearityReport, AMissingErrorHasItsReason)
{
  ExposureFit fit = Fit();
  fit.squaredError.reset();
  fit.reason = "only 2 of 3 exposures have a level in the range.";
  fit.isOffsetOfDarkFrames = true;
  const Report report = ReportOf(fit);
  EXPECT_EQ(report.linearity.errorPercent.status, EstimateStatus::NotIdentifiable);
  EXPECT_EQ(*report.linearity.offsetDn.value, 100.0);
  EXPECT_EQ(report.linearity.offsetSource, "dark frames");
  EXPECT_TRUE(Has(MakeTable(report), "\nlinearity: not identifiable: only 2 of 3 exposures"));
}
