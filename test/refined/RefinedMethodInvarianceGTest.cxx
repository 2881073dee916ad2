// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/Report.h"
#include "sensornoise/ReportText.h"
#include "sensornoise/Simulator.h"
#include "sensornoise/SimulationSettings.h"
#include "helpers/RefinedTestHelper.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <gtest/gtest.h>
#include <map>
#include <string>
#include <utility>
#include <vector>

using namespace sensornoise;
using namespace sensornoise::test;

namespace
{
using GreyValue = unsigned short;
constexpr std::size_t Width = 128;
constexpr std::size_t Height = 96;
constexpr std::size_t Frames = 40;

/** Burst with flicker and vibrations along both axes, of a calibration target or a textured scene. */
const std::array<Stack<GreyValue>, 2> &
Stacks()
{
  static const auto stacks = [] {
    SimulationSettings settings = FlickeringSettings(Frames);
    settings.conditions = { 0.05, 0.15, 0.08 };
    return std::array<Stack<GreyValue>, 2>{ Simulate<GreyValue>(settings, Width, Height),
                                            Simulate<GreyValue>(
                                              settings, Width, Height, MakeTextureScene(Width, Height)) };
  }();
  return stacks;
}

struct Scalar
{
  double value;
  double tolerance; ///< tolerance in units of the required relative precision
};

/** Returns every number of a report that is not a series: values, and standard errors as "... se". */
std::map<std::string, Scalar>
ScalarsOf(const Report & report)
{
  std::map<std::string, Scalar> scalars;
  const auto                    add = [&](const std::string & name, const Quantity & quantity, double size) {
    const double value = ValueOf(quantity);
    scalars[name] = { value, std::max(std::abs(value), size) };
    if (quantity.standardError)
    {
      // The part of the noise is subtracted from a standard error, and the odds of unlike parts multiply its rounding:
      // it has fewer digits.
      scalars[name + " se"] = { *quantity.standardError, 1e4 * *quantity.standardError };
    }
  };
  const double gain = ValueOf(report.gain);
  add("gain", report.gain, 0.0);
  add("offset", report.offset, 3000.0 * gain);
  add("read noise", report.readNoise, 0.0);
  add("read noise [e-]", report.readNoiseElectrons, 0.0);
  add("intercept", report.intercept, 3000.0 * gain * gain);
  add("total intercept", report.totalIntercept, 3000.0 * gain * gain);
  add("flicker", report.flickerSd, 0.0);
  add("vibration x", report.vibrationSdX, 0.0);
  add("vibration y", report.vibrationSdY, 0.0);
  add("vibration xy", report.vibrationCovariance, 0.0);
  scalars["reduced chi2"] = { *report.fit.reducedChi2, 1e3 };
  scalars["curvature z"] = { *report.fit.curvatureZ, 1e3 };
  scalars["phi"] = { *report.fit.offsetLinePhi, 1e3 };
  scalars["used"] = { static_cast<double>(report.pixels.used), 0.0 };
  scalars["valid"] = { static_cast<double>(report.pixels.valid), 0.0 };
  return scalars;
}

void
ExpectSame(const std::map<std::string, Scalar> & before, const std::map<std::string, Scalar> & after, double relative)
{
  for (const auto & [name, scalar] : before)
  {
    EXPECT_NEAR(after.at(name).value, scalar.value, relative * scalar.tolerance) << name;
  }
}

void
Scale(std::map<std::string, Scalar> & scalars, const std::string & name, double factor)
{
  for (const auto & key : { name, name + " se" })
  {
    scalars.at(key).value *= factor;
    scalars.at(key).tolerance *= factor;
  }
}
} // namespace

TEST(SensorNoiseRefinedMethodInvariance, PermutedFramesLeaveEveryScalar)
{
  for (const auto & stack : Stacks())
  {
    constexpr std::size_t pixels = Width * Height;
    auto                  permuted = stack;
    for (std::size_t t = 0; t < Frames; ++t)
    {
      std::copy_n(stack.Frame(t), pixels, permuted.pixels.data() + t * 7 % Frames * pixels);
    }
    const auto before = Measure(stack);
    const auto after = Measure(permuted);
    ExpectSame(ScalarsOf(before.GetReport()), ScalarsOf(after.GetReport()), 1e-9); // sums over frames in another order
    EXPECT_TRUE(HaveSameBits(after.GetVariance(), before.GetVariance()));
    EXPECT_TRUE(HaveSameBits(after.GetPixelUse(), before.GetPixelUse()));
    for (std::size_t t = 0; t < Frames; ++t)
    {
      EXPECT_NEAR(after.GetReport().flicker[t * 7 % Frames], before.GetReport().flicker[t], 1e-11);
      EXPECT_NEAR(after.GetReport().motion[t * 7 % Frames][0], before.GetReport().motion[t][0], 1e-9);
    }
  }
}

TEST(SensorNoiseRefinedMethodInvariance, TransposedFramesSwapTheAxes)
{
  for (const auto & stack : Stacks())
  {
    Stack<GreyValue> transposed{ Height, Width, Frames, stack.pixels };
    for (std::size_t i = 0; i < stack.pixels.size(); ++i)
    {
      const std::size_t x = i % Width;
      const std::size_t y = i / Width % Height;
      transposed.pixels[(i / Width / Height * Width + x) * Height + y] = stack.pixels[i];
    }
    const auto method = Measure(stack);
    const auto swapped = Measure(transposed);
    auto       after = ScalarsOf(swapped.GetReport());
    std::swap(after.at("vibration x"), after.at("vibration y"));
    std::swap(after.at("vibration x se"), after.at("vibration y se"));
    auto before = ScalarsOf(method.GetReport());
    for (const char * axes : { "x", "y", "xy" })
    {
      // Blocks of cells, which are 32 columns wide and 8 rows high, deviate by themselves. They end elsewhere.
      Scalar & error = before.at(std::string("vibration ") + axes + " se");
      error.tolerance = 0.2 * error.value / 1e-6;
    }
    ExpectSame(before, after, 1e-6);
    for (std::size_t t = 0; t < Frames; ++t)
    {
      EXPECT_NEAR(swapped.GetReport().motion[t][1], method.GetReport().motion[t][0], 1e-6);
    }
    EXPECT_GT(ValueOf(method.GetReport().vibrationSdX), 1.5 * ValueOf(method.GetReport().vibrationSdY)); // 0.15, 0.08
  }
}

TEST(SensorNoiseRefinedMethodInvariance, AddedConstantShiftsTheOffset)
{
  constexpr int added = 1000;
  for (const auto & stack : Stacks())
  {
    const auto method = Measure(stack);
    const auto shifted = Measure(stack.Map([](int u) { return u + added; }), WithDnSettings(1.0, added));
    auto       before = ScalarsOf(method.GetReport());
    auto       after = ScalarsOf(shifted.GetReport());
    after.at("offset").value -= added;
    for (const char * name : { "intercept", "total intercept" })
    {
      after.at(name).value += added * after.at("gain").value; // sigma^2 - g (mu + b)
      // The variance of the line at another level: var(c) = var(c + g b) + b^2 var(g) - 2 b cov(g, c + g b).
      const auto & covariance = shifted.GetReport().covariance.value();
      after.at(std::string(name) + " se").value =
        std::sqrt(covariance[1][1] + added * (added * covariance[0][0] + 2.0 * covariance[0][1]));
    }
    ExpectSame(before, after, 1e-7);
    EXPECT_TRUE(HaveSameBits(shifted.GetVariance(), method.GetVariance()));
    EXPECT_TRUE(HaveSameBits(shifted.GetPixelUse(), method.GetPixelUse()));
  }
}

TEST(SensorNoiseRefinedMethodInvariance, DoubledSamplesDoubleTheCamera)
{
  for (const auto & stack : Stacks())
  {
    const auto method = Measure(stack);
    // With twice the step the quantization noise, step^2 / 12, grows by a factor of 4, as all variances.
    const auto doubled = Measure(stack.Map([](int u) { return 2 * u; }), WithDnSettings(2.0));
    auto       before = ScalarsOf(method.GetReport());
    const auto after = ScalarsOf(doubled.GetReport());
    ASSERT_EQ(doubled.GetReport().quantisationStepDn, 2.0);
    for (const char * name : { "gain", "offset", "read noise" })
    {
      Scale(before, name, 2.0);
    }
    for (const char * name : { "intercept", "total intercept" })
    {
      Scale(before, name, 4.0);
    }
    // The components of twice the samples have one bit less, see UnitOfNarrowSums(): below 1e-3 standard errors.
    ExpectSame(before, after, 1e-6);
    EXPECT_TRUE(HaveSameBits(doubled.GetPixelUse(), method.GetPixelUse()));
    const double rounding = ValueOf(doubled.GetReport().totalIntercept) - ValueOf(doubled.GetReport().intercept);
    EXPECT_NEAR(rounding, 4.0 / 12.0, 1e-9);
  }
}

TEST(SensorNoiseRefinedMethodInvariance, FloatingPointPixelsGiveTheSameAsIntegers)
{
  for (const auto & stack : Stacks())
  {
    Stack<float> floats{ Width, Height, Frames, { stack.pixels.begin(), stack.pixels.end() } };
    Stack<short> signedIntegers{ Width, Height, Frames, { stack.pixels.begin(), stack.pixels.end() } };
    const auto   expected = ScalarsOf(Measure(stack).GetReport());
    ExpectSame(expected, ScalarsOf(Measure(floats).GetReport()), 1e-7);
    ExpectSame(expected, ScalarsOf(Measure(signedIntegers).GetReport()), 1e-9);
  }
}

TEST(SensorNoiseRefinedMethodInvariance, SamplesMayBeFractionsOfFullScale)
{
  for (const auto & stack : Stacks())
  {
    const auto expected = ScalarsOf(Measure(stack).GetReport());
    for (const double unit : { std::exp2(-16), std::exp2(-46), std::exp2(20) })
    {
      const auto scaled = stack.Map<float>([unit](int u) { return unit * u; });
      auto       before = expected;
      for (const char * name : { "gain", "offset", "read noise" })
      {
        Scale(before, name, unit);
      }
      for (const char * name : { "intercept", "total intercept" })
      {
        Scale(before, name, unit * unit);
      }
      ExpectSame(before, ScalarsOf(Measure(scaled, WithDnSettings(unit)).GetReport()), 1e-7);
    }
  }
}

TEST(SensorNoiseRefinedMethodInvariance, MirroredFramesMirrorTheShifts)
{
  for (const auto & stack : Stacks())
  {
    Stack<GreyValue> mirrored = stack;
    for (std::size_t y = 0; y < Height * Frames; ++y)
    {
      const auto row = mirrored.pixels.begin() + static_cast<std::ptrdiff_t>(y * Width);
      std::reverse(row, row + Width);
    }
    const auto method = Measure(stack);
    const auto other = Measure(mirrored);
    auto       after = ScalarsOf(other.GetReport());
    after.at("vibration xy").value *= -1.0;
    ExpectSame(ScalarsOf(method.GetReport()), after, 1e-7); // the columns of tiles are mirrored, too
    for (std::size_t t = 0; t < Frames; ++t)
    {
      EXPECT_NEAR(other.GetReport().motion[t][0], -method.GetReport().motion[t][0], 1e-7);
      EXPECT_NEAR(other.GetReport().motion[t][1], method.GetReport().motion[t][1], 1e-7);
    }
  }
}

// A masked pixel is only a neighbour of pixels that are measured.
TEST(SensorNoiseRefinedMethodInvariance, ValuesOfMaskedPixelsChangeNothing)
{
  constexpr std::size_t     measured = 56; // rows
  constexpr std::size_t     reach = 16;    // rows whose pixels serve as neighbours
  std::vector<std::uint8_t> mask(Width * Height, 0);
  std::fill_n(mask.begin(), measured * Width, std::uint8_t{ 1 });
  const auto measure = [&](const Stack<GreyValue> & stack) {
    RefinedMethod<GreyValue> method({}, GeometryOf(stack), stack.frames, mask);
    while (!method.IsDone())
    {
      method.AddFrames(stack.Frame(0), stack.frames);
      method.EndPass();
    }
    return ToJson(method.GetReport());
  };
  const Stack<GreyValue> & stack = Stacks()[1];
  const std::string        expected = measure(stack);
  for (const unsigned int kind : { 0U, 1U, 2U })
  {
    Stack<GreyValue> changed = stack;
    for (std::size_t t = 0; t < Frames; ++t)
    {
      for (std::size_t p = (measured + reach) * Width; p < Width * Height; ++p)
      {
        const std::size_t value = kind == 0 ? 2600 : kind == 1 ? (t + p) % 2 * 4095 : 4095 * (t % 2);
        changed.pixels[t * Width * Height + p] = static_cast<GreyValue>(value);
      }
    }
    EXPECT_EQ(measure(changed), expected) << kind;
  }
}

TEST(SensorNoiseRefinedMethodInvariance, AUnitThatSinglePrecisionDoesNotHoldIsRefused)
{
  for (const double factor : { 1e-20, 1e18 })
  {
    Stack<float> scaled{ Width, Height, Frames, {} };
    for (const GreyValue value : Stacks()[1].pixels)
    {
      scaled.pixels.push_back(static_cast<float>(factor * value));
    }
    const Report report = Measure(scaled, RefinedSettings{}).GetReport();
    EXPECT_EQ(report.gain.status, EstimateStatus::Failed) << factor;
    ASSERT_FALSE(report.warnings.empty());
    EXPECT_NE(report.warnings.front().message.find("in the unit of the frames"), std::string::npos)
      << report.warnings.front().message;
  }
}
