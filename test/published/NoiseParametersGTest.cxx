// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "base/PolynomialFit.h"
#include "published/PublishedPasses.h"
#include "report/Quantities.h"
#include "sensornoise/Report.h"

#include <cmath>
#include <gtest/gtest.h>
#include <optional>
#include <string>
#include <vector>

using namespace sensornoise;

namespace
{
/** Returns the line of a camera, with the slope g and the intercept sigma^2 - g mu. */
PolynomialFit
LineOf(double gain, double intercept)
{
  PolynomialFit line;
  line.slope = gain;
  line.intercept = intercept;
  line.pixels = 1000;
  line.isDetermined = true;
  return line;
}

PolynomialFit
LineOfCamera(double gain, double offset, double readNoise)
{
  return LineOf(gain, readNoise * readNoise - gain * offset);
}

Report
ReportOf(const PolynomialFit & line, std::optional<double> offsetDn, std::optional<double> darkestDn)
{
  Report report;
  FileParameters(report, EstimateParameters(line, offsetDn, darkestDn));
  return report;
}

std::vector<Quantity>
ParametersOf(const Report & report)
{
  return { report.gain,      report.offset,        report.readNoise, report.readNoiseElectrons,
           report.intercept, report.totalIntercept };
}

void
ExpectInterval(const std::optional<Interval> & interval, double low, double high)
{
  ASSERT_TRUE(interval.has_value());
  ASSERT_TRUE(interval->low && interval->high);
  EXPECT_NEAR(*interval->low, low, 1e-9);
  EXPECT_NEAR(*interval->high, high, 1e-9);
}
} // namespace

TEST(SensorNoiseNoiseParameters, CameraIsRecoveredFromItsLineAndOffset)
{
  const Report report = ReportOf(LineOfCamera(0.3, 40.0, 3.0), 40.0, 60.0);
  for (const Quantity & quantity : ParametersOf(report))
  {
    EXPECT_EQ(quantity.status, EstimateStatus::Identified);
    EXPECT_FALSE(quantity.standardError || quantity.interval95); // the paper has no errors
  }
  EXPECT_DOUBLE_EQ(*report.gain.value, 0.3);
  EXPECT_DOUBLE_EQ(*report.offset.value, 40.0);
  EXPECT_NEAR(*report.readNoise.value, 3.0, 1e-12);
  EXPECT_NEAR(*report.readNoiseElectrons.value, 10.0, 1e-12);
  EXPECT_DOUBLE_EQ(*report.intercept.value, 9.0 - 12.0);
  EXPECT_EQ(report.totalIntercept.value, report.intercept.value); // no quantization noise is removed
  EXPECT_TRUE(report.warnings.empty());
  EXPECT_TRUE(report.IsUsable());
}

TEST(SensorNoiseNoiseParameters, WithoutOffsetTheBoundsRemain)
{
  const Report report = ReportOf(LineOfCamera(0.5, 40.0, 3.0), std::nullopt, 60.0);
  EXPECT_EQ(report.gain.status, EstimateStatus::Identified);
  EXPECT_EQ(report.intercept.status, EstimateStatus::Identified);
  for (const Quantity * quantity : { &report.offset, &report.readNoise, &report.readNoiseElectrons })
  {
    EXPECT_EQ(quantity->status, EstimateStatus::NotIdentifiable);
    EXPECT_FALSE(quantity->value);
  }
  // sigma^2 = 0 at mu = 40 - 9/0.5 = 22, and sigma^2 = 9 + 0.5 (60 - 40) = 19 at mu = 60: the bounds contain the truth.
  ExpectInterval(report.offset.bracket, 22.0, 60.0);
  ExpectInterval(report.readNoise.bracket, 0.0, std::sqrt(19.0));
  ExpectInterval(report.readNoiseElectrons.bracket, 0.0, std::sqrt(19.0) / 0.5);
}

TEST(SensorNoiseNoiseParameters, WithoutDarkestMeanThereAreNoBounds)
{
  const Report report = ReportOf(LineOfCamera(0.5, 40.0, 3.0), std::nullopt, std::nullopt);
  EXPECT_FALSE(report.offset.bracket || report.readNoise.bracket);
  // The darkest mean is below the level at which sigma^2 = 0.
  const Report contradiction = ReportOf(LineOfCamera(0.5, 40.0, 3.0), std::nullopt, 21.9);
  EXPECT_FALSE(contradiction.offset.bracket || contradiction.readNoise.bracket);
}

TEST(SensorNoiseNoiseParameters, NegativeSquareOfTheReadNoiseIsNotIdentifiable)
{
  const Report report = ReportOf(LineOf(1.0, -105.0), 100.0, 120.0);
  EXPECT_EQ(report.offset.status, EstimateStatus::Identified);
  EXPECT_EQ(report.readNoise.status, EstimateStatus::NotIdentifiable);
  EXPECT_EQ(report.readNoiseElectrons.status, EstimateStatus::NotIdentifiable);
  EXPECT_FALSE(report.readNoise.value);
  ExpectInterval(report.readNoise.bracket, 0.0, std::sqrt(15.0));
  ASSERT_EQ(report.warnings.size(), 1u);
  EXPECT_EQ(report.warnings[0].code, WarningCode::ReadNoiseNotIdentifiable);
  EXPECT_NE(report.warnings[0].message.find("of -5 DN^2"), std::string::npos) << report.warnings[0].message;
}

TEST(SensorNoiseNoiseParameters, GainThatIsNotPositiveFailsEverything)
{
  PolynomialFit undetermined;
  undetermined.pixels = 77;
  for (const PolynomialFit & line : { LineOf(0.0, 10.0), LineOf(-0.1, 10.0), LineOf(std::nan(""), 10.0), undetermined })
  {
    const Report report = ReportOf(line, 40.0, 60.0);
    for (const Quantity & quantity : ParametersOf(report))
    {
      EXPECT_EQ(quantity.status, EstimateStatus::Failed);
      EXPECT_FALSE(quantity.value || quantity.bracket);
    }
    ASSERT_EQ(report.warnings.size(), 1u);
    EXPECT_EQ(report.warnings[0].code, WarningCode::VarianceNotAffine);
    EXPECT_FALSE(report.IsUsable());
    EXPECT_EQ(report.warnings[0].message.find("77 pixels") != std::string::npos, !line.isDetermined);
  }
}

TEST(SensorNoiseNoiseParameters, OneStatusCanBeSetForAllParameters)
{
  Report report = ReportOf(LineOfCamera(0.3, 40.0, 3.0), 40.0, 60.0);
  SetSensorParameters(report, EstimateStatus::NotIdentifiable);
  for (const Quantity & quantity : ParametersOf(report))
  {
    EXPECT_EQ(quantity.status, EstimateStatus::NotIdentifiable);
    EXPECT_FALSE(quantity.value || quantity.bracket);
  }
}
