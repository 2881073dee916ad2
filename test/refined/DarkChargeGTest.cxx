// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "refined/RefinedResults.h"
#include "moments/DarkFrames.h"
#include "sensornoise/FrameGeometry.h"
#include "sensornoise/Parallel.h"
#include "sensornoise/Report.h"
#include "sensornoise/Settings.h"
#include "sensornoise/SimulationSettings.h"
#include "simulation/Random.h"
#include "helpers/SensorTestHelper.h"

#include <cmath>
#include <cstddef>
#include <gtest/gtest.h>
#include <memory>

// Charge in dark frames, by dark current, glow or light.

using namespace sensornoise;
using namespace sensornoise::test;
using namespace sensornoise::test::sensor;

namespace
{
constexpr std::size_t   Width = 160;
constexpr std::size_t   Height = 128;
constexpr std::size_t   Frames = 16;
constexpr double        Gain = 0.5;         // DN/e-
constexpr double        ReadVariance = 4.0; // DN^2
constexpr FrameGeometry Geometry{ Width, Height, 1 };

/** Returns dark frames whose level rises by \a riseDn from the left to the right, and whose variance rises with \a
 * slope times the level. Their means and variances have the scatter of Frames frames of normal noise, times \a scatter.
 */
KnownOffset
DarkFrames(double riseDn, double slope, double scatter)
{
  CounterSeededRandom random(5);
  auto                maps = std::make_shared<DarkMaps>();
  maps->frames = Frames;
  maps->usable.assign(Geometry.Pixels(), 1);
  KnownOffset  offset;
  DarkVariance variance;
  for (std::size_t p = 0; p < Geometry.Pixels(); ++p)
  {
    const double rise = riseDn * static_cast<double>(p % Width) / Width;
    const double square = ReadVariance + slope * rise;
    maps->offsetDn.push_back(100.0 + rise + scatter * std::sqrt(square / Frames) * random.Normal());
    maps->varianceDn2.push_back(square * (1.0 + scatter * std::sqrt(2.0 / (Frames - 1.0)) * random.Normal()));
    offset.valueDn += maps->offsetDn.back() / static_cast<double>(Geometry.Pixels());
    variance.valueDn2 += maps->varianceDn2.back() / static_cast<double>(Geometry.Pixels());
  }
  offset.variance = variance;
  offset.darkFrames = Frames;
  offset.maps = maps;
  return offset;
}

DarkCharge
ChargeOf(const KnownOffset & offset)
{
  return FindDarkCharge(offset, Geometry, SerialFor).value();
}
} // namespace

TEST(SensorNoiseDarkCharge, WithoutScatterTheSlopeIsTheGain)
{
  const DarkCharge charge = ChargeOf(DarkFrames(2.0, Gain, 0.0));
  EXPECT_NEAR(charge.slope.value, Gain, 1e-9);
  EXPECT_NEAR(charge.slope.standardError, 0.0, 1e-9);
  // The mean level is half of the rise, less the middle of the darkest tiles and the allowance for their noise.
  EXPECT_NEAR(charge.spreadDn, 0.95, 0.15);
  EXPECT_NEAR(charge.VarianceDn2(Gain), Gain * charge.spreadDn, 1e-9);
}

TEST(SensorNoiseDarkCharge, ScatterLeavesMostOfIt)
{
  const DarkCharge charge = ChargeOf(DarkFrames(2.0, Gain, 1.0));
  EXPECT_NEAR(charge.slope.value, Gain, 4.0 * charge.slope.standardError);
  EXPECT_LT(charge.slope.standardError, 0.1 * Gain);
  // 0.5 * 2 DN of charge, less what is allowed for chance: 2 standard errors of the slope, and the darkest tiles.
  EXPECT_LT(charge.VarianceDn2(Gain), 1.1 * Gain);
  EXPECT_GT(charge.VarianceDn2(Gain), 0.6 * Gain);
}

TEST(SensorNoiseDarkCharge, LevelsWithoutChargeAddNothing)
{
  EXPECT_EQ(ChargeOf(DarkFrames(0.0, 0.0, 1.0)).VarianceDn2(Gain), 0.0);
  EXPECT_LT(ChargeOf(DarkFrames(20.0, 0.0, 1.0)).VarianceDn2(Gain), 0.02 * ReadVariance); // a gradient of the offset
  EXPECT_EQ(ChargeOf(DarkFrames(20.0, 4.0 * Gain, 1.0)).VarianceDn2(Gain), 0.0);          // another cause
}

TEST(SensorNoiseDarkCharge, WithoutMapsNothingIsKnown)
{
  KnownOffset offset = DarkFrames(2.0, Gain, 0.0);
  offset.maps.reset();
  EXPECT_FALSE(FindDarkCharge(offset, Geometry, SerialFor).has_value());
  EXPECT_FALSE(FindDarkCharge({}, Geometry, SerialFor).has_value());
}

TEST(SensorNoiseDarkCharge, ErrorsHoldWhatALeakAddsToTheDarkFrames)
{
  constexpr std::size_t size = 192;
  SimulationSettings    settings = StaticCamera(20); // 1 DN/e-
  settings.conditions.flickerSd = 0.0;               // which would contradict the level of the dark frames
  const Stack<GreyValue> stack = Simulate<GreyValue>(settings, size, size);
  const Stack<GreyValue> covered = DarkFramesOf(settings, size);
  Stack<GreyValue>       leaking = covered;
  CounterSeededRandom    random(6);
  for (std::size_t i = 0; i < leaking.pixels.size(); ++i)
  {
    const double electrons = 18.0 * static_cast<double>(i % size) / size;
    leaking.pixels[i] = static_cast<GreyValue>(leaking.pixels[i] + random.Poisson(electrons));
  }
  const Report own = Measure(stack, WithDarkFrames(covered)).GetReport();
  const Report report = Measure(stack, WithDarkFrames(leaking)).GetReport();
  EXPECT_FALSE(HasWarning(own, WarningCode::DarkSignalVaries));
  EXPECT_TRUE(HasWarning(report, WarningCode::DarkSignalVaries));
  EXPECT_NEAR(ValueOf(report.offset), ValueOf(own.offset), 2.0 * *report.offset.standardError);
  EXPECT_NEAR(ValueOf(report.readNoise), ValueOf(own.readNoise), 2.0 * *report.readNoise.standardError);
  EXPECT_GT(ValueOf(report.offset), ValueOf(own.offset) + 10.0 * *own.offset.standardError);
  EXPECT_EQ(report.gain.status, EstimateStatus::Identified);
}
