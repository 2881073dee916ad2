// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/Simulator.h"
#include "sensornoise/SimulationSettings.h"
#include "simulation/SimulatedSensor.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <gtest/gtest.h>
#include <numeric>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

using namespace sensornoise;

namespace
{
std::vector<double>
FactorsOf(const std::string & text, std::size_t frames)
{
  const IlluminationSettings illumination = IlluminationOf(text);
  std::vector<double>        factors;
  for (std::size_t t = 0; t < frames; ++t)
  {
    factors.push_back(IlluminationFactor(illumination, t, frames, 7));
  }
  return factors;
}

std::string
SentenceOf(const std::string & text, std::size_t frames = 8)
{
  try
  {
    CheckSettings(IlluminationOf(text), frames);
  }
  catch (const std::invalid_argument & error)
  {
    return error.what();
  }
  return "";
}
} // namespace

TEST(SensorNoiseIllumination, ShapesHaveTheirClosedForms)
{
  EXPECT_EQ(FactorsOf("steady", 3), (std::vector<double>{ 1, 1, 1 }));
  EXPECT_EQ(FactorsOf("pulses", 8), (std::vector<double>{ 0, 0, 0, 1, 0, 0, 0, 1 }));
  EXPECT_EQ(FactorsOf("pulses:0.3:2", 4), (std::vector<double>{ 0.3, 1, 0.3, 1 }));
  EXPECT_EQ(FactorsOf("ramp:0.5", 3), (std::vector<double>{ 0.5, 0.75, 1 }));
  const std::vector<double> decay = FactorsOf("decay:0.01", 5);
  const std::vector<double> sine = FactorsOf("sine:0.2:4", 4);
  for (std::size_t t = 0; t < 4; ++t)
  {
    EXPECT_NEAR(decay[t + 1] / decay[t], std::sqrt(0.1), 1e-15);
    EXPECT_NEAR(sine[t], (std::vector<double>{ 0.6, 1, 0.6, 0.2 })[t], 1e-15);
  }
  EXPECT_EQ(decay[0], 1.0);
}

TEST(SensorNoiseIllumination, RandomFactorsHaveTheirMoments)
{
  constexpr std::size_t frames = 20000;
  const auto            momentsOf = [](const std::vector<double> & factors) {
    const double mean = std::accumulate(factors.begin(), factors.end(), 0.0) / frames;
    const double square = std::inner_product(factors.begin(), factors.end(), factors.begin(), 0.0) / frames;
    return std::pair(mean, square - mean * mean);
  };
  // Four standard errors: sd / sqrt(n) of the mean, and of the variance v sqrt((kurtosis - 1) / n), which is
  // v sqrt(0.8 / n) of uniform numbers and v sqrt(8 / n) of exponential ones.
  const auto [uniformMean, uniformVariance] = momentsOf(FactorsOf("uniform:0.4", frames));
  EXPECT_NEAR(uniformMean, 0.7, 4.0 * 0.6 / std::sqrt(12.0 * frames));
  EXPECT_NEAR(uniformVariance, 0.03, 4.0 * 0.03 * std::sqrt(0.8 / frames));
  const auto [exponentialMean, exponentialVariance] = momentsOf(FactorsOf("exponential", frames));
  EXPECT_NEAR(exponentialMean, 1.0, 4.0 / std::sqrt(frames));
  EXPECT_NEAR(exponentialVariance, 1.0, 4.0 * std::sqrt(8.0 / frames));
}

TEST(SensorNoiseIllumination, TextSaysWhatWasRead)
{
  for (const char * text : { "steady", "pulses:0.3:4", "ramp:0.5", "decay:0.1", "sine:0:7.5", "uniform:0" })
  {
    EXPECT_EQ(TextOf(IlluminationOf(text)), text);
  }
  EXPECT_EQ(TextOf(IlluminationOf("pulses")), "pulses:0:4");
  EXPECT_TRUE(IsIlluminationName("sine:x"));
  EXPECT_FALSE(IsIlluminationName("sines"));
}

TEST(SensorNoiseIllumination, BadSettingsGetOneSentence)
{
  EXPECT_NE(SentenceOf("strobe").find("\"strobe\"; expected steady, pulses, ramp"), std::string::npos);
  EXPECT_NE(SentenceOf("ramp:a").find("has \"a\" where a number is expected"), std::string::npos);
  EXPECT_NE(SentenceOf("ramp:").find("has \"\" where a number is expected"), std::string::npos);
  EXPECT_NE(SentenceOf("ramp:0.5:4").find("has 2 numbers; expected at most 1 after ramp"), std::string::npos);
  EXPECT_EQ(SentenceOf("decay:0"), "the lowest illumination factor is 0; expected above 0 for an exponential decay");
  EXPECT_EQ(SentenceOf("ramp:1.5"), "the lowest illumination factor is 1.5; expected 0 to 1");
  EXPECT_EQ(SentenceOf("sine:0:0.5"), "the period of the illumination is 0.5; expected 1 to 1e9 frames");
  EXPECT_NE(SentenceOf("pulses", 3).find("a number above 0 in at least one frame"), std::string::npos);
  EXPECT_EQ(SentenceOf("pulses", 4), "");
  IlluminationSettings factors;
  factors.shape = IlluminationShape::Factors;
  factors.factors = { 1.0, 0.5 };
  EXPECT_NO_THROW(CheckSettings(factors, 2));
  EXPECT_THROW(CheckSettings(factors, 3), std::invalid_argument);
  factors.factors = { 1.0, -0.5 };
  EXPECT_THROW(CheckSettings(factors, 2), std::invalid_argument);
}

// The expected electrons of a frame are the electrons of a steady frame times its factor, whatever the flicker; where
// the factor is 1, and only there, the bits of the frame are the bits of a steady stack.
TEST(SensorNoiseIllumination, FramesAreBrightenedByTheirFactors)
{
  constexpr std::size_t size = 32;
  for (const double period : { 0.0, 10.0 })
  {
    SimulationSettings settings;
    settings.frames = 8;
    settings.rollingShutterPeriodRows = period;
    settings.bitDepth = 16;
    const StackSimulator steady(MakeTargetScene(size, size), size, size, settings);
    settings.illumination = IlluminationOf("pulses:0.25:4");
    const StackSimulator changing(MakeTargetScene(size, size), size, size, settings);
    std::vector<double>  expected(size);
    std::vector<double>  found(size);
    for (std::size_t t = 0; t < settings.frames; ++t)
    {
      const double factor = t % 4 == 3 ? 1.0 : 0.25;
      steady.ExpectedElectronsRow(t, 5, expected.data());
      changing.ExpectedElectronsRow(t, 5, found.data());
      for (std::size_t x = 0; x < size; ++x)
      {
        EXPECT_NEAR(found[x], factor * expected[x], 1e-11 * (1.0 + expected[x]));
      }
      std::vector<unsigned short> steadyDn(size);
      std::vector<unsigned short> changingDn(size);
      steady.RenderRow(t, 5, steadyDn.data());
      changing.RenderRow(t, 5, changingDn.data());
      EXPECT_EQ(steadyDn == changingDn, factor == 1.0);
    }
    // Normalised: (1 + gamma) / mean(1 + gamma) - 1 of the factors alone, to within the flicker of 5 % and its rows.
    const std::vector<double> & flicker = changing.GetTruth().normalisedFlicker;
    EXPECT_NEAR(std::accumulate(flicker.begin(), flicker.end(), 0.0), 0.0, 1e-12);
    EXPECT_GT(flicker[3], 1.0);
    EXPECT_LT(flicker[0], -0.3);
  }
}
