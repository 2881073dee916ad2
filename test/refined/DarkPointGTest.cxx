// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "refined/GainEstimate.h"
#include "sensornoise/Settings.h"
#include "sensornoise/Report.h"
#include "sensornoise/ReportText.h"
#include "sensornoise/SimulationSettings.h"
#include "sensornoise/Simulator.h"
#include "helpers/SensorTestHelper.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <gtest/gtest.h>
#include <string>
#include <vector>

// Dark frames give a point of the photon transfer line.

using namespace sensornoise;
using namespace sensornoise::test;
using namespace sensornoise::test::sensor;

namespace
{
constexpr std::size_t Size = 192;
constexpr std::size_t Frames = 20;

SimulationSettings
FlatCamera()
{
  SimulationSettings settings = StaticCamera(Frames);
  settings.conditions.flickerSd = 0.0;
  return settings;
}

/** Mean and mean temporal variance of all pixels except at the border. */
struct FlatMoments
{
  double mean{ 0.0 };
  double variance{ 0.0 };

  explicit FlatMoments(const Stack<GreyValue> & stack)
  {
    double pixels = 0.0;
    for (std::size_t p = 0; p < stack.width * stack.height; ++p)
    {
      const std::size_t x = p % stack.width;
      const std::size_t y = p / stack.width;
      if (x < 2 || y < 2 || x + 2 >= stack.width || y + 2 >= stack.height)
      {
        continue;
      }
      double sum = 0.0;
      double squares = 0.0;
      for (std::size_t t = 0; t < stack.frames; ++t)
      {
        const double value = stack.Frame(t)[p];
        sum += value;
        squares += value * value;
      }
      const auto frames = static_cast<double>(stack.frames);
      mean += sum / frames;
      variance += (squares - sum * sum / frames) / (frames - 1.0);
      pixels += 1.0;
    }
    mean /= pixels;
    variance /= pixels;
  }
};

/** Returns the report of a flat with dark frames whose strips of columns have in turn the gains 1 and 1.03 DN/e-. */
Report
ReportOfStrips(std::size_t columns)
{
  SimulationSettings settings = FlatCamera();
  Stack<GreyValue>   flat = Simulate<GreyValue>(settings, Size, Size, FlatScene(Size));
  settings.camera.gainDnPerElectron = 1.03;
  const Stack<GreyValue> other = Simulate<GreyValue>(settings, Size, Size, FlatScene(Size));
  for (std::size_t i = 0; i < flat.pixels.size(); ++i)
  {
    if (i % Size / columns % 2 == 1)
    {
      flat.pixels[i] = other.pixels[i];
    }
  }
  return Measure(flat, WithDarkFrames(DarkFramesOf(settings, Size))).GetReport();
}
} // namespace

TEST(SensorNoiseDarkPoint, FlatAndDarkFramesArePhotonTransfer)
{
  const SimulationSettings settings = FlatCamera();
  const Stack<GreyValue>   flat = Simulate<GreyValue>(settings, Size, Size, FlatScene(Size));
  const Stack<GreyValue>   dark = DarkFramesOf(settings, Size);
  const FlatMoments        bright(flat);
  const FlatMoments        black(dark);
  const double             gain = (bright.variance - black.variance) / (bright.mean - black.mean);
  const Report             report = Measure(flat, WithDarkFrames(dark)).GetReport();
  // The method removes the common component of the frames from the variance, 1 or 2 of 19 degrees of freedom. This is a
  // third of the error of 700,000 samples, 0.17 %.
  EXPECT_NEAR(ValueOf(report.gain) / gain, 1.0, 1e-3);
  EXPECT_NEAR(ValueOf(report.gain), 1.0, 5.0 * *report.gain.standardError);
  EXPECT_LT(*report.gain.standardError, 0.005);
  EXPECT_NEAR(ValueOf(report.offset), black.mean, 0.01);
  EXPECT_NEAR(ValueOf(report.readNoise), std::sqrt(black.variance - 1.0 / 12.0), 0.01);
  EXPECT_FALSE(HasWarning(report, WarningCode::DarkFramesDiffer));
  EXPECT_FALSE(HasWarning(report, WarningCode::NotStatic));
  EXPECT_FALSE(HasWarning(report, WarningCode::IntensityRangeTooSmall));
}

// All that differs in a flat is the gain of its two amplifiers. The dark frames determine the gain.
TEST(SensorNoiseDarkPoint, StepBetweenTheAmplifiersOfAFlatIsNoSignal)
{
  const Report report = ReportOfStrips(Size / 2);
  ASSERT_EQ(report.gain.status, EstimateStatus::Identified) << MakeText(report);
  EXPECT_NEAR(*report.gain.value, 1.015, 4.0 * *report.gain.standardError); // 4 standard errors: once in 16,000
  EXPECT_LT(*report.gain.standardError, 0.005);
}

// Strips may be of the scene. Their levels alone have twice the slope of the gain, and dark frames show it.
TEST(SensorNoiseDarkPoint, LevelsOfAFlatThatContradictTheDarkFramesHaveNoGain)
{
  const Report report = ReportOfStrips(Size / 8);
  EXPECT_EQ(report.gain.status, EstimateStatus::Failed) << MakeText(report);
  EXPECT_TRUE(HasWarning(report, WarningCode::VarianceNotAffine)) << MakeText(report);
}

// The initial model takes flicker of a flat for noise, and its slope is by chance. Neither may exclude pixels that
// never clip, nor widen the error: the variance of 30,000 pixels with 20 frames determines the gain to 0.2 %.
TEST(SensorNoiseDarkPoint, FlickerOfAFlatIsNoNoise)
{
  for (const std::uint64_t seed : { 1U, 2U, 3U, 4U })
  {
    SimulationSettings settings = FlatCamera();
    settings.seed = seed;
    settings.conditions.flickerSd = 0.05;
    settings.camera.electrons = 2700.0;
    const Stack<GreyValue> flat = Simulate<GreyValue>(settings, Size, Size, FlatScene(Size));
    const Report           report = Measure(flat, WithDarkFrames(DarkFramesOf(settings, Size))).GetReport();
    EXPECT_NEAR(ValueOf(report.gain), 1.0, 5.0 * *report.gain.standardError);
    EXPECT_LT(*report.gain.standardError, 0.003);
    EXPECT_FALSE(HasWarning(report, WarningCode::StrongVibration));
  }
}

TEST(SensorNoiseDarkPoint, PixelsThatDifferDoNotBiasAFlat)
{
  SimulationSettings settings = FlatCamera();
  settings.conditions.flickerSd = 0.003;
  settings.flaws.pattern = { 0.01, 0.0, 0.0, 2.0 };
  settings.dsnuSdDn = 10.0;
  settings.prnuSd = 0.01;
  const Stack<GreyValue> flat = Simulate<GreyValue>(settings, Size, Size, FlatScene(Size, 0.003));
  const StackSimulator   simulator(FlatScene(Size), Size, Size, settings);
  double                 offsetDn = 0.0; // with the columns of this sensor
  for (std::size_t p = 0; p < Size * Size; ++p)
  {
    offsetDn += simulator.PixelOffsetDn(p) / (Size * Size);
  }
  const Report report = Measure(flat, WithDarkFrames(DarkFramesOf(settings, Size))).GetReport();
  // The gain of a photon transfer is the mean square of the gains over their mean, (1 + 0.01^2) times the mean gain.
  EXPECT_NEAR(ValueOf(report.gain), 1.0, 5.0 * *report.gain.standardError);
  EXPECT_LT(*report.gain.standardError, 0.005);
  EXPECT_NEAR(ValueOf(report.offset), offsetDn, 0.05);
}

TEST(SensorNoiseDarkPoint, DarkFramesOfAnotherCameraAreNoticed)
{
  // The levels extend to the dark, so that no non-linearity can lie between them and the dark frames.
  const Stack<GreyValue> stack = Simulate<GreyValue>(StaticCamera(40), 128, 128);
  const auto             reportOf = [&](double varianceDn2) {
    RefinedSettings settings;
    settings.offset = KnownOffset{ 100.0, 0.02, 20, DarkVariance{ varianceDn2, 0.3 } };
    return Measure(stack, settings).GetReport();
  };
  const Report own = reportOf(64.0 + 1.0 / 12.0);
  EXPECT_FALSE(HasWarning(own, WarningCode::DarkFramesDiffer));
  for (const double varianceDn2 : { 40.0, 90.0 })
  {
    const Report report = reportOf(varianceDn2);
    EXPECT_TRUE(HasWarning(report, WarningCode::DarkFramesDiffer)) << varianceDn2;
    EXPECT_NEAR(ValueOf(report.gain), ValueOf(own.gain), 2.0 * *report.gain.standardError); // without the dark frames
    EXPECT_EQ(report.offset.status, EstimateStatus::Failed);
    EXPECT_EQ(report.readNoise.status, EstimateStatus::Failed);
    EXPECT_EQ(report.readNoiseElectrons.status, EstimateStatus::Failed);
  }
}

TEST(SensorNoiseDarkPoint, DarkFramesThatHoldSignalAreNoticed)
{
  // The shutter is not closed: the dark frames show the scene with a fraction of its signal. The pixels have DSNU and
  // PRNU.
  SimulationSettings settings = StaticCamera(40);
  settings.dsnuSdDn = 10.0;
  settings.prnuSd = 0.01;
  const Stack<GreyValue> stack = Simulate<GreyValue>(settings, Size, Size);
  const Report           own = Measure(stack, WithDarkFrames(DarkFramesOf(settings, Size))).GetReport();
  EXPECT_FALSE(HasWarning(own, WarningCode::DarkFramesDiffer));
  ExpectHolds(own.offset, 100.0);
  SimulationSettings dim = settings;
  dim.seed = 22;
  dim.camera.electrons *= 0.05;
  const Report report = Measure(stack, WithDarkFrames(Simulate<GreyValue>(dim, Size, Size))).GetReport();
  const auto   warning = std::find_if(report.warnings.begin(), report.warnings.end(), [](const Warning & w) {
    return w.code == WarningCode::DarkFramesDiffer;
  });
  ASSERT_NE(warning, report.warnings.end());
  // The mean illumination of the 40 frames of each stack is known within 0.3 %.
  const std::string words = "the dark frames hold ";
  ASSERT_EQ(warning->message.rfind(words, 0), 0U) << warning->message;
  EXPECT_NEAR(std::stod(warning->message.substr(words.size())), 5.0, 4.0 * 0.0045 * 5.0);
  EXPECT_EQ(report.offset.status, EstimateStatus::Failed);
  EXPECT_EQ(report.readNoise.status, EstimateStatus::Failed);
  EXPECT_EQ(report.gain.status, EstimateStatus::Identified);
  ExpectHolds(report.gain, 1.0);
}

TEST(SensorNoiseDarkPoint, ErrorOfTheGainIsThatOfTheLevelsAndNotOfTheDarkestPixels)
{
  // A read noise of half a DN: the darkest pixels have nearly all of the weight of the line, and it is about as often
  // beside the dark frames as chance has it, two standard errors in a twentieth of the stacks.
  SimulationSettings settings;
  settings.camera = { 3750.0, 0.8, 100.0, 0.52 };
  settings.conditions = { 0.03, 0.01, 0.02 };
  settings.frames = 24;
  for (std::uint64_t seed = 1; seed <= 40; ++seed)
  {
    settings.seed = seed;
    SimulationSettings dark = settings;
    dark.seed = 1000 + seed;
    const Stack<GreyValue> stack = Simulate<GreyValue>(settings, 96, 96);
    const Report           alone = Measure(stack, {}).GetReport();
    const Report           report = Measure(stack, WithDarkFrames(DarkFramesOf(dark, 96))).GetReport();
    ASSERT_EQ(report.gain.status, EstimateStatus::Identified) << seed;
    // Levels below a tenth of the signal give no gain by themselves, so the error may be a little larger.
    EXPECT_LT(*report.gain.standardError, 1.5 * *alone.gain.standardError) << seed;
    EXPECT_NEAR(ValueOf(report.gain), 0.8, 4.0 * *report.gain.standardError) << seed;
  }
}

TEST(SensorNoiseDarkPoint, NarrowRangeIsTiedToTheDarkFrames)
{
  // The signals are from 70 to 100 %: the line alone determines the gain within some per cent, the photon transfer
  // within some tenths of a per cent.
  const SimulationSettings settings = FlatCamera();
  const Stack<GreyValue>   stack = Simulate<GreyValue>(settings, Size, Size, FlatScene(Size, 0.3));
  const Report             report = Measure(stack, WithDarkFrames(DarkFramesOf(settings, Size))).GetReport();
  EXPECT_NEAR(ValueOf(report.gain), 1.0, 5.0 * *report.gain.standardError);
  EXPECT_LT(*report.gain.standardError, 0.005);
  // The line alone would not show dark frames whose level is wrong by a few per cent of the signal.
  EXPECT_TRUE(HasWarning(report, WarningCode::ResponseUnchecked));
}

TEST(SensorNoiseDarkPoint, FramesThatContradictLevelsThatAreAlikeHaveNoQuantities)
{
  // The level of the dark frames is wrong by 20 % of the signal. The line shows it, but parts of the sensor might, too.
  const SimulationSettings settings = FlatCamera();
  SimulationSettings       dark = settings;
  dark.camera.offsetDn += 0.2 * settings.camera.electrons * settings.camera.gainDnPerElectron;
  const Stack<GreyValue> stack = Simulate<GreyValue>(settings, Size, Size, FlatScene(Size, 0.3));
  const Report           report = Measure(stack, WithDarkFrames(DarkFramesOf(dark, Size))).GetReport();
  EXPECT_TRUE(HasWarning(report, WarningCode::VarianceNotAffine)) << ToJson(report);
  for (const Quantity * const quantity : { &report.gain, &report.offset, &report.readNoise })
  {
    EXPECT_EQ(quantity->status, EstimateStatus::Failed);
  }
}

TEST(SensorNoiseDarkPoint, RefusedStackStillHasWhatTheDarkFramesTell)
{
  // A gamma of 2.2 and a constant stack are no responses of a sensor.
  SimulationSettings     settings = StaticCamera(Frames);
  const Stack<GreyValue> dark = DarkFramesOf(settings, Size);
  settings.flaws.response = { ResponseShape::Gamma, 2.2 };
  for (const Stack<GreyValue> & stack :
       { Simulate<GreyValue>(settings, Size, Size),
         Stack<GreyValue>{ Size, Size, Frames, std::vector<GreyValue>(Size * Size * Frames, 700) } })
  {
    const Report report = Measure(stack, WithDarkFrames(dark)).GetReport();
    EXPECT_NE(report.gain.status, EstimateStatus::Identified);
    EXPECT_FALSE(report.gain.value);
    EXPECT_NEAR(ValueOf(report.offset), 100.0, 0.05);
    EXPECT_NEAR(ValueOf(report.readNoise), 8.0, 5.0 * *report.readNoise.standardError);
    EXPECT_NEAR(ValueOf(report.readNoiseMedian), 8.0, 5.0 * *report.readNoiseMedian.standardError);
    EXPECT_NE(report.readNoiseElectrons.status, EstimateStatus::Identified); // needs the gain
  }
}
