// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/Emva1288.h"
#include "helpers/EmvaTestHelper.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <gtest/gtest.h>
#include <stdexcept>
#include <string>
#include <vector>

using namespace sensornoise;
using namespace sensornoise::test::emva;

namespace
{
/** Returns exact series of a camera: dark frames and flat fields of 20 exposures, and two saturated ones. */
std::vector<EmvaSeries>
ExactCamera(const LinearCamera & camera, bool hasDarkOfAll = true)
{
  std::vector<EmvaSeries> series;
  for (std::size_t i = 0; i <= 22; ++i)
  {
    const auto exposure = static_cast<double>(i);
    if (i == 0 || hasDarkOfAll)
    {
      series.push_back(ExactSeries(camera, exposure, 0.0));
    }
    if (i > 0)
    {
      series.push_back(i <= 20 ? ExactSeries(camera, exposure, 350.0 * exposure)
                               : SaturatedSeries(camera, exposure, 350.0 * exposure));
    }
  }
  return series;
}

bool
HasNote(const EmvaReport & report, const std::string & code)
{
  return std::any_of(
    report.notes.begin(), report.notes.end(), [&code](const EmvaNote & note) { return note.code == code; });
}

/** Expects the exact values of a camera whose electrons at saturation are 7000. */
void
ExpectCamera(const EmvaReport & report, const LinearCamera & camera)
{
  const auto expect = [](const Quantity & quantity, double value, const char * name) {
    ASSERT_TRUE(quantity.value) << name;
    EXPECT_NEAR(*quantity.value, value, 1e-9 * std::abs(value)) << name;
  };
  const double threshold =
    std::sqrt(std::pow(camera.darkNoise, 2) + 1.0 / 12.0 / std::pow(camera.gain, 2) + 0.25) + 0.5;
  expect(report.gain, camera.gain, "gain");
  expect(report.weightedGain, camera.gain, "weighted gain");
  expect(report.gainThroughOrigin, camera.gain, "gain through the origin");
  expect(report.responsivity, camera.gain * camera.efficiency, "responsivity");
  expect(report.quantumEfficiency, 100.0 * camera.efficiency, "quantum efficiency");
  expect(report.darkSignal, camera.offsetDn, "dark signal");
  expect(report.darkNoiseElectrons, camera.darkNoise, "dark noise");
  expect(report.saturationSignal, camera.gain * 7000.0, "saturation");
  expect(report.saturationElectrons, 7000.0, "saturation capacity");
  expect(report.saturationPhotons, 7000.0 / camera.efficiency, "saturation in photons");
  expect(report.thresholdElectrons, threshold, "threshold");
  expect(report.thresholdPhotons, threshold / camera.efficiency, "threshold in photons");
  expect(report.dynamicRange, 7000.0 / threshold, "dynamic range");
  expect(report.largestSnr, std::sqrt(7000.0), "maximum SNR");
}
} // namespace

TEST(SensorNoiseEmva1288, ExactSeriesGiveTheCamera)
{
  LinearCamera camera;
  ExpectCamera(EvaluateEmva1288(ExactCamera(camera)), camera);
  camera = { 0.2, 30.0, 11.0, 0.45, 0.0, 1.0 };
  ExpectCamera(EvaluateEmva1288(ExactCamera(camera, false)), camera);
}

TEST(SensorNoiseEmva1288, ExactSeriesAreLinear)
{
  const EmvaReport report = EvaluateEmva1288(ExactCamera({}));
  EXPECT_NEAR(*report.linearityError.value, 0.0, 1e-10);
  EXPECT_NEAR(*report.linearityOffset.value, 0.0, 1e-8);
  EXPECT_NEAR(*report.linearitySlope.value, 0.3, 1e-10); // K times the quantum efficiency
  // 5 % to 95 % of the 20th exposure: the 1st to the 19th
  EXPECT_TRUE(report.points[0].deviationPercent);
  EXPECT_TRUE(report.points[18].deviationPercent);
  EXPECT_FALSE(report.points[19].deviationPercent);
}

TEST(SensorNoiseEmva1288, TheDarkCurrentIsTheSlopeOfMeanAndVariance)
{
  LinearCamera camera;
  camera.darkCurrent = 25.0;
  EmvaSettings settings;
  settings.exposureUnit = "s";
  const EmvaReport report = EvaluateEmva1288(ExactCamera(camera), settings);
  EXPECT_NEAR(*report.darkCurrent.value, 12.5, 1e-9);
  EXPECT_NEAR(*report.darkCurrentElectrons.value, 25.0, 1e-8);
  EXPECT_NEAR(*report.darkCurrentOfVariance.value, 25.0, 1e-8);
  EXPECT_NEAR(*report.darkNoiseElectrons.value, camera.darkNoise, 1e-8); // at exposure 0
  EXPECT_FALSE(HasNote(report, "dark-not-matched"));
  EXPECT_FALSE(HasNote(report, "few-dark-exposures"));
}

TEST(SensorNoiseEmva1288, DarkLevelsBetweenExposuresAreInterpolated)
{
  LinearCamera camera;
  camera.darkCurrent = 25.0;
  std::vector<EmvaSeries> series = ExactCamera(camera);
  series.erase(std::remove_if(
                 series.begin(),
                 series.end(),
                 [](const EmvaSeries & each) { return each.isDark && each.exposure != 0.0 && each.exposure != 22.0; }),
               series.end());
  const EmvaReport report = EvaluateEmva1288(series);
  EXPECT_NEAR(*report.gain.value, camera.gain, 1e-10);
  EXPECT_NEAR(report.points[9].signalDn, camera.gain * 3500.0, 1e-8);
  EXPECT_TRUE(HasNote(report, "dark-not-matched"));
  EXPECT_FALSE(report.darkCurrent.value); // two exposures do not determine it
}

TEST(SensorNoiseEmva1288, TheBitDepthHoldsAllDigitalNumbers)
{
  std::vector<EmvaSeries> series = ExactCamera({});
  EmvaSettings            settings;
  const auto              refusal = [&]() -> std::string {
    try
    {
      EvaluateEmva1288(series, settings);
    }
    catch (const std::invalid_argument & error)
    {
      return error.what();
    }
    return "";
  };
  settings.bitDepth = 12; // the numbers end at 4095
  EXPECT_EQ(refusal(), "");
  settings.bitDepth = 11;
  EXPECT_NE(refusal().find("hold the level 4095 DN, but 11 bits with a quantization step of 1 DN end at 2047 DN"),
            std::string::npos);
  settings.quantizationStepDn = 4.0; // 11 bits that are shifted by 2 end at 8188
  EXPECT_EQ(refusal(), "");
  settings.bitDepth = 17;
  EXPECT_NE(refusal().find("the bit depth is 17; expected at most 16"), std::string::npos);
}

TEST(SensorNoiseEmva1288, TheThresholdIsWhereSignalEqualsNoise)
{
  // (26) and (21) are independent statements of the standard.
  std::vector<EmvaSeries> series = ExactCamera({});
  EmvaReport              report = EvaluateEmva1288(series);
  series.push_back(ExactSeries({}, 0.001, 0.6 * *report.thresholdPhotons.value));
  report = EvaluateEmva1288(series);
  EXPECT_NEAR(*report.points.front().modelSnr, 1.0, 1e-4); // K changes little by the further exposure
  EXPECT_NEAR(report.points.front().snr, 1.0, 1e-3);
}

TEST(SensorNoiseEmva1288, QuantizationHidesASmallDarkNoise)
{
  LinearCamera camera;
  camera.darkNoise = 0.5; // 0.25 DN: the variance is 0.0625 + 1/12 < 0.24
  const EmvaReport report = EvaluateEmva1288(ExactCamera(camera));
  EXPECT_EQ(report.darkNoiseElectrons.status, EstimateStatus::UpperLimit);
  EXPECT_NEAR(*report.darkNoiseElectrons.interval95->high, 0.40 / *report.gain.value, 1e-12);
  EXPECT_EQ(report.thresholdElectrons.status, EstimateStatus::UpperLimit);
  EXPECT_FALSE(report.dynamicRange.value);
  EXPECT_TRUE(HasNote(report, "quantized-dark-noise"));
}

TEST(SensorNoiseEmva1288, TheQuantizationStepScalesItsVariance)
{
  LinearCamera camera;
  camera.quantization = 16.0;
  camera.darkNoise = 40.0;
  EmvaSettings settings;
  settings.quantizationStepDn = 16.0;
  EXPECT_NEAR(*EvaluateEmva1288(ExactCamera(camera), settings).darkNoiseElectrons.value, 40.0, 1e-8);
}

TEST(SensorNoiseEmva1288, WithoutSaturationTheCapacityHasALowerBound)
{
  std::vector<EmvaSeries> series = ExactCamera({});
  series.erase(
    std::remove_if(series.begin(), series.end(), [](const EmvaSeries & each) { return each.exposure > 20.0; }),
    series.end());
  const EmvaReport report = EvaluateEmva1288(series);
  EXPECT_FALSE(report.saturationElectrons.value);
  ASSERT_TRUE(report.saturationElectrons.bracket);
  EXPECT_NEAR(*report.saturationElectrons.bracket->low, 7000.0, 1e-6);
  EXPECT_TRUE(HasNote(report, "not-saturated"));
  EXPECT_NEAR(*report.gain.value, 0.5, 1e-10);
}

TEST(SensorNoiseEmva1288, APairPrecedesALongSeriesOfItsExposure)
{
  std::vector<EmvaSeries> series = ExactCamera({});
  EmvaSeries              longer = ExactSeries({}, 10.0, 3500.0, 50);
  longer.temporalVarianceDn2 *= 1.5; // would change the gain
  longer.unfiltered.totalDn2 = longer.unfiltered.measuredDn2 = 49.0;
  series.push_back(longer);
  const EmvaReport report = EvaluateEmva1288(series);
  EXPECT_NEAR(*report.gain.value, 0.5, 1e-10);
  EXPECT_EQ(*report.brightStack, series.size() - 1);
  EXPECT_NEAR(*report.prnuUnfiltered.value, 100.0 * 7.0 / 1750.0, 1e-9);
}

TEST(SensorNoiseEmva1288, ALongSeriesBetweenPairsIsNoPointOfTheCurve)
{
  // The photons of the long series are wrong, as in a published data set: they would change R, and with it the rest.
  std::vector<EmvaSeries> series = ExactCamera({});
  EmvaSeries              longer = ExactSeries({}, 10.5, 3675.0, 50);
  longer.photons = 0.1 * *longer.photons;
  series.push_back(longer);
  const EmvaReport report = EvaluateEmva1288(series);
  ExpectCamera(report, {});
  EXPECT_NEAR(*report.linearityError.value, 0.0, 1e-10);
  EXPECT_EQ(report.points.size(), 22U);
  EXPECT_EQ(*report.brightStack, series.size() - 1);
}

TEST(SensorNoiseEmva1288, ALongSeriesBetweenPairsCountsForTheWeightedGain)
{
  std::vector<EmvaSeries> series = ExactCamera({});
  const double            without = *EvaluateEmva1288(series).weightedGain.standardError;
  series.push_back(ExactSeries({}, 10.5, 3675.0, 500));
  EXPECT_LT(*EvaluateEmva1288(series).weightedGain.standardError, without);
  series.back().temporalVarianceDn2 *= 1.1;
  EXPECT_GT(*EvaluateEmva1288(series).weightedGain.value, 0.5 + 1e-4);
  EXPECT_NEAR(*EvaluateEmva1288(series).gain.value, 0.5, 1e-10);
}

TEST(SensorNoiseEmva1288, LongSeriesAreTheCurveWhereFewSeriesArePairs)
{
  std::vector<EmvaSeries> series = ExactCamera({});
  for (EmvaSeries & each : series)
  {
    each.frames = each.isDark || each.exposure < 4.0 ? 2U : 4U; // 3 of 22 flat exposures are pairs
  }
  const EmvaReport report = EvaluateEmva1288(series);
  ExpectCamera(report, {});
  EXPECT_EQ(report.points.size(), 22U);
}

TEST(SensorNoiseEmva1288, RefusesSeriesThatAreNone)
{
  const std::vector<EmvaSeries> sound = ExactCamera({});
  const auto                    refuses = [&](const std::function<void(std::vector<EmvaSeries> &)> & damage) {
    std::vector<EmvaSeries> series = sound;
    damage(series);
    EXPECT_THROW(EvaluateEmva1288(series), std::invalid_argument);
  };
  refuses([](auto & series) { series.clear(); });
  refuses([](auto & series) { series[3].exposure = -1.0; });
  refuses([](auto & series) { series[3].exposure = NAN; });
  refuses([](auto & series) { series[3].width = 99; });
  refuses([](auto & series) {
    series.erase(std::remove_if(series.begin(), series.end(), [](const auto & each) { return each.isDark; }),
                 series.end());
  });
  refuses([](auto & series) { series.resize(4); }); // two flat exposures
  refuses([](auto & series) {
    for (EmvaSeries & each : series)
    {
      each.temporalVarianceDn2 = 0.0;
    }
  });
  refuses([](auto & series) {
    for (EmvaSeries & each : series)
    {
      each.meanDn += each.isDark ? 5000.0 : 0.0;
    }
  });
  EmvaSettings settings;
  settings.quantizationStepDn = 0.0;
  EXPECT_THROW(EvaluateEmva1288(sound, settings), std::invalid_argument);
}
