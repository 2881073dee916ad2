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
#include <vector>

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

namespace
{
/** Returns dark frames of pixels without spatial structure: exponential charge of mean \a chargeDn, fixed offsets of
 * standard deviation \a offsetsDn, and a fraction \a telegraph of pixels whose level switches by 3 times the noise. */
KnownOffset
UnlikePixels(double chargeDn, double offsetsDn, double telegraph)
{
  CounterSeededRandom random(7);
  KnownOffset         offset = DarkFrames(0.0, 0.0, 1.0);
  auto                maps = std::make_shared<DarkMaps>(*offset.maps);
  for (std::size_t p = 0; p < Geometry.Pixels(); ++p)
  {
    const double chargeHereDn = -chargeDn * std::log(1.0 - random.Uniform());
    const double switchDn = random.Uniform() < telegraph ? 3.0 * std::sqrt(ReadVariance) : 0.0;
    const double on = random.Uniform();
    maps->offsetDn[p] += chargeHereDn + offsetsDn * random.Normal() + on * switchDn;
    maps->varianceDn2[p] *= 1.0 + (Gain * chargeHereDn + on * (1.0 - on) * switchDn * switchDn) / ReadVariance;
  }
  offset.maps = maps;
  return offset;
}

DarkCharge
PixelChargeOf(const KnownOffset & offset)
{
  return FindPixelCharge(offset, Geometry, SerialFor).value();
}
} // namespace

TEST(SensorNoiseDarkCharge, FromPixelToPixelTheSlopeIsTheGain)
{
  const KnownOffset offset = UnlikePixels(8.0, 0.0, 0.0);
  const DarkCharge  charge = PixelChargeOf(offset);
  EXPECT_NEAR(charge.slope.value, Gain, 0.1 * Gain); // the noise of the levels, 0.25 DN^2, is 0.4 % of the spread
  EXPECT_LT(charge.slope.standardError, 0.02 * Gain);
  EXPECT_NEAR(charge.spreadDn, 8.0, 0.8); // two exponential numbers differ by their mean
  EXPECT_LT(ChargeOf(offset).VarianceDn2(Gain), 0.2 * charge.VarianceDn2(Gain)); // tiles have hardly any structure
}

TEST(SensorNoiseDarkCharge, UnlikePixelsWithoutChargeAddNothing)
{
  EXPECT_LT(PixelChargeOf(UnlikePixels(0.0, 0.0, 0.0)).VarianceDn2(Gain), 0.01 * ReadVariance);
  EXPECT_LT(PixelChargeOf(UnlikePixels(0.0, 10.0, 0.0)).VarianceDn2(Gain), 0.05 * ReadVariance);
  EXPECT_LT(PixelChargeOf(UnlikePixels(0.0, 1.0, 0.02)).VarianceDn2(Gain), 0.05 * ReadVariance);
}

TEST(SensorNoiseDarkCharge, ErrorsHoldDarkCurrentThatDiffersFromPixelToPixel)
{
  constexpr std::size_t size = 192;
  SimulationSettings    settings = StaticCamera(20); // 1 DN/e-
  settings.conditions.flickerSd = 0.0;               // which would contradict the level of the dark frames
  const Stack<GreyValue> stack = Simulate<GreyValue>(settings, size, size);
  const Stack<GreyValue> cold = DarkFramesOf(settings, size);
  Stack<GreyValue>       warm = cold;
  CounterSeededRandom    random(8);
  std::vector<double>    electrons(size * size);
  for (double & mean : electrons)
  {
    mean = 20.0 * std::exp(0.5 * random.Normal());
  }
  for (std::size_t i = 0; i < warm.pixels.size(); ++i)
  {
    warm.pixels[i] = static_cast<GreyValue>(warm.pixels[i] + random.Poisson(electrons[i % electrons.size()]));
  }
  const Report own = Measure(stack, WithDarkFrames(cold)).GetReport();
  const Report report = Measure(stack, WithDarkFrames(warm)).GetReport();
  EXPECT_FALSE(HasWarning(own, WarningCode::DarkSignalVaries));
  EXPECT_TRUE(HasWarning(report, WarningCode::DarkSignalVaries));
  EXPECT_NEAR(ValueOf(report.offset), ValueOf(own.offset), 2.5 * *report.offset.standardError);
  EXPECT_NEAR(ValueOf(report.readNoise), ValueOf(own.readNoise), 2.5 * *report.readNoise.standardError);
  EXPECT_EQ(report.gain.status, EstimateStatus::Identified);
}

TEST(SensorNoiseDarkCharge, WithoutMapsNothingIsKnown)
{
  KnownOffset offset = DarkFrames(2.0, Gain, 0.0);
  offset.maps.reset();
  EXPECT_FALSE(FindDarkCharge(offset, Geometry, SerialFor).has_value());
  EXPECT_FALSE(FindDarkCharge({}, Geometry, SerialFor).has_value());
  EXPECT_FALSE(FindPixelCharge(offset, Geometry, SerialFor).has_value());
  EXPECT_FALSE(FindPixelCharge({}, Geometry, SerialFor).has_value());
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
