// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/Settings.h"
#include "report/Quantities.h"
#include "sensornoise/Report.h"
#include "sensornoise/ReportText.h"
#include "simulation/Random.h"
#include "sensornoise/Simulator.h"
#include "sensornoise/SimulationSettings.h"
#include "helpers/RefinedTestHelper.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

// The refined method with a known offset. Camera B: g = 1 DN/e-, mu = 100 DN, sigma = 8 DN.

using namespace sensornoise;
using namespace sensornoise::test;

namespace
{
constexpr std::size_t Size = 128;
constexpr std::size_t Frames = 40;
using GreyValue = unsigned short;

SimulationSettings
WithFlicker(double flickerSd)
{
  SimulationSettings settings = FlickeringSettings(Frames);
  settings.conditions.flickerSd = flickerSd;
  return settings;
}

/** Simulates the target scene under flickering illumination, with a steady signal of \a veilElectrons electrons. */
Stack<GreyValue>
SimulateVeil(double flickerSd, double veilElectrons)
{
  const SimulationSettings settings = WithFlicker(flickerSd);
  const StackSimulator     simulator(MakeTargetScene(Size, Size), Size, Size, settings);
  Stack<GreyValue>         stack{ Size, Size, Frames, std::vector<GreyValue>(Size * Size * Frames) };
  std::vector<double>      electrons(Size);
  for (std::size_t row = 0; row < Frames * Size; ++row)
  {
    CounterSeededRandom random(settings.seed, 100, row);
    simulator.ExpectedElectronsRow(row / Size, row % Size, electrons.data());
    for (std::size_t x = 0; x < Size; ++x)
    {
      const double signal = static_cast<double>(random.Poisson(electrons[x] + veilElectrons));
      stack.pixels[row * Size + x] = static_cast<GreyValue>(std::lround(signal + 100.0 + 8.0 * random.Normal()));
    }
  }
  return stack;
}

Report
ReportOf(const Stack<GreyValue> & stack, const std::optional<KnownOffset> & offset = std::nullopt)
{
  RefinedSettings settings;
  settings.offset = offset;
  return Measure(stack, settings).GetReport();
}

/** Quantile 0.975 of Student's distribution with 19 degrees of freedom, tabulated. */
constexpr double StudentQuantile = 2.0930240544;

/** Returns the known offset of 20 dark frames, with the true offset. */
KnownOffset
DarkOf(double varianceDn2, double errorDn2)
{
  return { 100.0, 0.02, 20, DarkVariance{ varianceDn2, errorDn2 } };
}

/** Expects that a quantity is identified, and deviates from the truth by at most 4 standard errors. */
void
ExpectTruth(const Quantity & quantity, double truth)
{
  EXPECT_NEAR(ValueOf(quantity), truth, 4.0 * quantity.standardError.value_or(0.0));
  EXPECT_GT(quantity.standardError.value_or(0.0), 0.0);
}
} // namespace

TEST(SensorNoiseKnownOffset, SteadyLightIsDistinguishedFromTheOffset)
{
  const Stack<GreyValue> stack = SimulateVeil(0.05, 200.0);
  const Report           blind = ReportOf(stack);
  ExpectTruth(blind.offset, 300.0); // the component that does not flicker
  EXPECT_FALSE(HasWarning(blind, WarningCode::SteadyLight));

  const Report report = ReportOf(stack, KnownOffset{ 100.0, 0.1 });
  EXPECT_EQ(report.offset.value, 100.0);
  EXPECT_EQ(report.offset.standardError, 0.1);
  ExpectTruth(report.gain, 1.0);
  ExpectTruth(report.readNoise, 8.0);
  ExpectTruth(report.readNoiseElectrons, 8.0);
  EXPECT_TRUE(HasWarning(report, WarningCode::SteadyLight));
  EXPECT_FALSE(HasWarning(report, WarningCode::OffsetOutOfRange));
}

// Steady illumination adds to the level that does not flicker, and never makes it smaller than the offset. The shot
// noise of 10 DN is a sixth of the dark variance.
TEST(SensorNoiseKnownOffset, OffsetAboveTheLevelThatDoesNotFlickerIsNotTheOffset)
{
  const Stack<GreyValue> stack = SimulateVeil(0.05, 0.0);
  const Report           given = ReportOf(stack, KnownOffset{ 110.0, 0.1 });
  EXPECT_TRUE(HasWarning(given, WarningCode::OffsetOutOfRange));
  EXPECT_EQ(given.offset.status, EstimateStatus::Failed);
  EXPECT_EQ(given.readNoise.status, EstimateStatus::Failed);
  ExpectTruth(given.gain, 1.0);

  KnownOffset dark = DarkOf(64.0 + 1.0 / 12.0, 0.3);
  dark.valueDn = 110.0;
  const Report report = ReportOf(stack, dark);
  EXPECT_TRUE(HasWarning(report, WarningCode::DarkFramesDiffer));
  EXPECT_FALSE(HasWarning(report, WarningCode::SteadyLight));
  EXPECT_EQ(report.offset.status, EstimateStatus::Failed);
  EXPECT_EQ(report.readNoise.status, EstimateStatus::Failed);
  ExpectTruth(report.gain, 1.0);
}

TEST(SensorNoiseKnownOffset, WithoutSteadyLightThereIsNoWarning)
{
  const Report report = ReportOf(SimulateVeil(0.05, 0.0), KnownOffset{ 100.0, 0.1 });
  ExpectTruth(report.readNoise, 8.0);
  EXPECT_TRUE(report.warnings.empty()) << report.warnings.front().message;
}

TEST(SensorNoiseKnownOffset, NoFlickerIsNeeded)
{
  const Stack<GreyValue> stack = Simulate<GreyValue>(WithFlicker(0.0), Size, Size);
  const Report           blind = ReportOf(stack);
  EXPECT_EQ(blind.offset.status, EstimateStatus::NotIdentifiable);
  EXPECT_EQ(blind.readNoise.status, EstimateStatus::NotIdentifiable);
  EXPECT_TRUE(HasWarning(blind, WarningCode::OffsetNotIdentifiable));

  const Report report = ReportOf(stack, KnownOffset{ 100.0, 0.5 });
  EXPECT_EQ(report.offset.value, 100.0);
  ExpectTruth(report.readNoise, 8.0);
  ASSERT_TRUE(report.covariance);
  EXPECT_EQ((*report.covariance)[2][2], 0.25);
  EXPECT_TRUE(report.warnings.empty()) << report.warnings.front().message;
  // The error of the offset alone contributes g 0.5 DN / (2 sigma) = 0.031 DN to the error of the read noise.
  EXPECT_GT(*report.readNoise.standardError, 0.031);
}

TEST(SensorNoiseKnownOffset, DarkFramesDetermineTheReadNoise)
{
  const Stack<GreyValue> stack = Simulate<GreyValue>(WithFlicker(0.05), Size, Size);
  const Report           report = ReportOf(stack, DarkOf(64.0 + 1.0 / 12.0, 0.32));
  EXPECT_NEAR(ValueOf(report.readNoise), 8.0, 1e-9);
  EXPECT_NEAR(*report.readNoise.standardError, 0.32 / 16.0, 1e-9);
  ASSERT_TRUE(report.readNoise.interval95);
  // Twenty dark frames: the quantile of Student's distribution with 19 degrees of freedom.
  EXPECT_NEAR(*report.readNoise.interval95->low, std::sqrt(64.0 - StudentQuantile * 0.32), 1e-9);
  EXPECT_NEAR(ValueOf(report.readNoiseElectrons), 8.0 / *report.gain.value, 1e-9);
  EXPECT_GT(*report.readNoiseElectrons.standardError, *report.readNoise.standardError);
  EXPECT_TRUE(report.warnings.empty()) << report.warnings.front().message;

  using Setting = std::pair<std::string, Report::SettingValue>;
  for (const Setting & expected : { Setting("offset", 100.0),
                                    Setting("offset_standard_error", 0.02),
                                    Setting("dark_frames", 20.0),
                                    Setting("dark_variance", 64.0 + 1.0 / 12.0),
                                    Setting("dark_variance_standard_error", 0.32) })
  {
    EXPECT_EQ(std::count(report.settings.begin(), report.settings.end(), expected), 1) << expected.first;
  }
}

TEST(SensorNoiseKnownOffset, DarkFramesOfAnotherCameraAreNoticed)
{
  const Stack<GreyValue> stack = Simulate<GreyValue>(WithFlicker(0.05), Size, Size);
  EXPECT_TRUE(HasWarning(ReportOf(stack, DarkOf(81.0, 0.32)), WarningCode::DarkFramesDiffer));
}

TEST(SensorNoiseKnownOffset, ReadNoiseThatTheDarkFramesDoNotShowIsAnUpperLimit)
{
  const Stack<GreyValue> stack = Simulate<GreyValue>(WithFlicker(0.05), Size, Size);
  const Report           noisy = ReportOf(stack, DarkOf(64.0, 40.0)); // 64 - 2.09 x 40 is below 0
  EXPECT_EQ(noisy.readNoise.status, EstimateStatus::UpperLimit);
  EXPECT_FALSE(noisy.readNoise.value);
  EXPECT_NEAR(*noisy.readNoise.bracket->high, std::sqrt(64.0 - 1.0 / 12.0 + StudentQuantile * 40.0), 1e-9);
  EXPECT_TRUE(HasWarning(noisy, WarningCode::ReadNoiseUpperLimit));
  const Stack<GreyValue> even{ Size, Size, 20, std::vector<GreyValue>(Size * Size * 20, 700) }; // determines nothing
  const Report           coarse = ReportOf(even, DarkOf(0.2, 0.001)); // quantization step 1 DN
  EXPECT_EQ(coarse.readNoise.status, EstimateStatus::UpperLimit);
  EXPECT_NEAR(*coarse.readNoise.bracket->high, 0.5, 1e-12);
}

TEST(SensorNoiseKnownOffset, OffsetThatTheDataContradictIsNoticed)
{
  const Stack<GreyValue> stack = Simulate<GreyValue>(WithFlicker(0.05), Size, Size);
  const Report           low = ReportOf(stack, KnownOffset{ 10.0, 0.1 }); // sigma^2 = -36 + 10 < 0
  EXPECT_TRUE(HasWarning(low, WarningCode::OffsetOutOfRange));
  EXPECT_EQ(low.readNoise.status, EstimateStatus::Failed);
  EXPECT_EQ(low.readNoiseElectrons.status, EstimateStatus::Failed);
  EXPECT_TRUE(HasWarning(ReportOf(stack, KnownOffset{ 900.0, 0.1 }), WarningCode::OffsetOutOfRange));
  EXPECT_FALSE(HasWarning(ReportOf(stack, KnownOffset{ 100.0, 0.1 }), WarningCode::OffsetOutOfRange));
  const std::string given = MakeText(ReportOf(stack, KnownOffset{ 900.0, 0.1 }));
  EXPECT_NE(given.find("the given offset is 900 DN, but the darkest pixels and a read noise above 0 allow "),
            std::string::npos)
    << given;
  EXPECT_NE(given.find("measure it with dark frames (--dark)"), std::string::npos) << given;
  KnownOffset dark{ 900.0, 0.1 };
  dark.darkFrames = 1;
  const std::string exchanged = MakeText(ReportOf(stack, dark));
  EXPECT_NE(exchanged.find("the mean level of the dark frames is 900 DN"), std::string::npos) << exchanged;
  EXPECT_NE(exchanged.find("check whether frames and dark frames are exchanged"), std::string::npos) << exchanged;
  EXPECT_EQ(exchanged.find("infinity"), std::string::npos) << exchanged;
}

TEST(SensorNoiseKnownOffset, OffsetThatIsNoNumberIsRefused)
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const KnownOffset & offset : { KnownOffset{ nan, 0.0 }, KnownOffset{ 1.0, -1.0 }, KnownOffset{ 1.0, nan } })
  {
    RefinedSettings settings;
    settings.offset = offset;
    EXPECT_THROW(settings.Validate(), std::invalid_argument);
  }
}

TEST(KnownOffset, ThatIsFarOutsideTheLevelsIsRefused)
{
  const auto errorOf = [](const RefinedSettings & settings, double limitDn) -> std::string {
    try
    {
      settings.RequireOffsetWithin(limitDn, "the test's limit");
    }
    catch (const std::invalid_argument & error)
    {
      return error.what();
    }
    return "";
  };
  RefinedSettings settings;
  EXPECT_EQ(errorOf(settings, 0.0), "");
  settings.offset = KnownOffset{ -65536.0, 0.5 };
  EXPECT_EQ(errorOf(settings, 65536.0), "");
  settings.offset = KnownOffset{ 1e308, 0.0 };
  EXPECT_EQ(
    errorOf(settings, 65536.0),
    "the offset is 1e+308 DN with a standard error of 0 DN; expected both within 65536 DN of 0, the test's limit");
  settings.offset = KnownOffset{ 100.0, 1e9 };
  EXPECT_NE(errorOf(settings, 65536.0), "");

  // For integer pixels the limit is known before a frame is read.
  settings.offset = KnownOffset{ 70000.0, 0.0 };
  EXPECT_THROW(RefinedMethod<unsigned short>(settings, { 16, 16, 1 }, 20), std::invalid_argument);
  settings.offset = KnownOffset{ 300.0, 0.0 };
  EXPECT_THROW(RefinedMethod<unsigned char>(settings, { 16, 16, 1 }, 20), std::invalid_argument);
  EXPECT_NO_THROW(RefinedMethod<unsigned short>(settings, { 16, 16, 1 }, 20));
}

TEST(KnownOffset, DnSettingsAndLevelsOutOfRangeAreRejected)
{
  const auto refuses = [](auto change) {
    RefinedSettings settings;
    change(settings);
    EXPECT_THROW(settings.Validate(), std::invalid_argument);
  };
  static constexpr double infinity = std::numeric_limits<double>::infinity();
  refuses([](RefinedSettings & s) { s.dnSettings.clipLowDn = -infinity; });
  refuses([](RefinedSettings & s) { s.dnSettings.clipHighDn = 1e308; });
  refuses([](RefinedSettings & s) { s.dnSettings.quantisationStepDn = 1e308; });
  refuses([](RefinedSettings & s) { s.dnSettings.quantisationStepDn = infinity; });
  refuses([](RefinedSettings & s) { s.levelRangeDn = LevelRange{ 0.0, infinity }; });
  refuses([](RefinedSettings & s) { s.levelRangeDn = LevelRange{ -std::numeric_limits<double>::infinity(), 5.0 }; });
}
