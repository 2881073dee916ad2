/*=========================================================================
 *
 *  Copyright the ITKSensorNoise contributors
 *
 *  Licensed under the Apache License, Version 2.0 (the "License");
 *  you may not use this file except in compliance with the License.
 *  You may obtain a copy of the License at
 *
 *         https://www.apache.org/licenses/LICENSE-2.0.txt
 *
 *  Unless required by applicable law or agreed to in writing, software
 *  distributed under the License is distributed on an "AS IS" BASIS,
 *  WITHOUT WARRANTIES OR CONDITIONS OF ANY KIND, either express or implied.
 *  See the License for the specific language governing permissions and
 *  limitations under the License.
 *
 *=========================================================================*/
#include "sensornoise/published/PublishedMethod.h"
#include "sensornoise/report/ReportJson.h"
#include "sensornoise/base/FrameGeometry.h"
#include "sensornoise/base/Parallel.h"
#include "sensornoise/base/PixelUse.h"
#include "sensornoise/base/RollingShutter.h"
#include "sensornoise/moments/Codes.h"
#include "sensornoise/published/PublishedSettings.h"
#include "sensornoise/report/Report.h"
#include "sensornoise/simulation/Random.h"
#include "sensornoise/simulation/SimulationSettings.h"
#include "helpers/StackTestHelper.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <gtest/gtest.h>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

using namespace sensornoise;
using test::Stack;

namespace
{
using Codes = unsigned short;

/** Patches of 16 grey levels seen by camera B of the paper, with flicker, without vibration and without blur, whose
 * faint rims the vibration test keeps where their variance happens to be high. */
SimulationSettings
SettingsOf(double flickerSd, std::size_t frames)
{
  SimulationSettings settings;
  settings.conditions = { flickerSd, 0.0, 0.0 };
  settings.frames = frames;
  settings.opticalBlurPixels = 0.0;
  settings.seed = 5;
  return settings;
}

template <typename TPixel = Codes>
Stack<TPixel>
Simulate(const SimulationSettings & settings, std::size_t width = 64, std::size_t height = 56)
{
  return test::Simulate<TPixel>(settings, width, height);
}

/** A stack for the identities: 40 frames with flicker of 5 %. */
const Stack<Codes> &
FlickeringStack()
{
  static const Stack<Codes> stack = Simulate(SettingsOf(0.05, 40));
  return stack;
}

PublishedSettings
WithGlobalShutter()
{
  PublishedSettings settings;
  settings.rollingShutter = RollingShutter::Off;
  return settings;
}

template <typename TPixel>
PublishedMethod<TPixel>
Measure(const Stack<TPixel> &             stack,
        const PublishedSettings &         settings = {},
        std::size_t                       chunk = 1000,
        const std::vector<std::uint8_t> & mask = {},
        const ParallelFor &               parallelFor = SerialFor)
{
  const FrameGeometry     geometry{ stack.width, stack.height, settings.shutterAxis };
  PublishedMethod<TPixel> method(settings, geometry, stack.frames, mask, parallelFor);
  for (unsigned int pass = 0; pass < method.NumberOfPasses; ++pass)
  {
    for (std::size_t t = 0; t < stack.frames; t += chunk)
    {
      method.AddFrames(stack.pixels.data() + t * geometry.Pixels(), std::min(chunk, stack.frames - t));
    }
    method.EndPass();
  }
  return method;
}

double
ValueOf(const Quantity & quantity)
{
  EXPECT_EQ(quantity.status, EstimateStatus::Identified) << quantity.unit;
  return quantity.value.value_or(std::nan(""));
}

bool
HasWarning(const Report & report, const std::string & code)
{
  return std::any_of(report.warnings.begin(), report.warnings.end(), [&](const Warning & w) { return w.code == code; });
}

/** \a other has the values of \a report, scaled and shifted, to rounding errors. */
void
ExpectSameCamera(const Report & report,
                 const Report & other,
                 double         scale = 1.0,
                 double         shiftDn = 0.0,
                 double         eps = 1e-8)
{
  const double gain = ValueOf(report.gain);
  EXPECT_NEAR(ValueOf(other.gain), scale * gain, eps * scale * gain);
  EXPECT_NEAR(ValueOf(other.offset), scale * ValueOf(report.offset) + shiftDn, eps * scale * 3000.0);
  EXPECT_NEAR(ValueOf(other.intercept),
              scale * scale * (ValueOf(report.intercept) - gain * shiftDn / scale),
              eps * scale * scale * 3000.0 * gain);
  EXPECT_NEAR(ValueOf(other.flickerSd), ValueOf(report.flickerSd), eps);
  EXPECT_EQ(other.pixels.used, report.pixels.used);
}

void
ExpectNothingMeasured(const Report & report, const std::string & code)
{
  for (const Quantity & quantity : { report.gain, report.offset, report.readNoise, report.intercept })
  {
    EXPECT_EQ(quantity.status, EstimateStatus::Failed);
    EXPECT_FALSE(quantity.value);
  }
  EXPECT_FALSE(report.IsUsable());
  EXPECT_TRUE(HasWarning(report, code)) << ToJson(report);
  EXPECT_EQ(report.pixels.used, 0u);
}

template <typename TPixel>
Stack<TPixel>
ConstantStack(TPixel value, std::size_t frames = 20)
{
  return { 20, 16, frames, std::vector<TPixel>(20 * 16 * frames, value) };
}
} // namespace

TEST(SensorNoisePublishedMethod, RecoversTheCamera)
{
  for (const char camera : { 'A', 'B', 'C' })
  {
    SimulationSettings simulation = SettingsOf(0.1, 60);
    simulation.camera = PaperCamera(camera);
    const auto &   truth = simulation.camera;
    const auto     stack = Simulate(simulation, 96, 96);
    const auto     method = Measure(stack, WithGlobalShutter());
    const Report & report = method.GetReport();
    const double   pixels = static_cast<double>(report.pixels.used);
    const double   full = truth.electrons * truth.gainDnPerElectron; // [DN] above the offset
    // Levels k/15 of the full scale: sd 0.31, root mean square of the variance at most 0.6 (g full) + sigma^2 + 1/12.
    const double spread = 0.31 * full;
    const double noise = 0.6 * truth.gainDnPerElectron * full + truth.readNoiseDn * truth.readNoiseDn + 0.1;
    const double gainSd = std::sqrt(2.0 / 59.0) * noise / (spread * std::sqrt(pixels));
    // The vibration test prefers pixels of low variance: level -ln(level) 2 / (T-1) = 0.16 % of the variance.
    EXPECT_NEAR(ValueOf(report.gain) / truth.gainDnPerElectron, 1.0, 5.0 * gainSd / truth.gainDnPerElectron + 0.0016)
      << camera;
    // v_* and v^* average 30 pixels at least; sd(K) is their noise over the flicker's, d mu / d K = 1 + mu / full.
    const double darkNoise = (truth.readNoiseDn * truth.readNoiseDn + 0.1) / 30.0;
    const double brightNoise = truth.offsetDn * truth.offsetDn * truth.gainDnPerElectron / full / 30.0;
    const double offsetSd = std::sqrt((darkNoise + brightNoise) / 59.0) / 0.08 * (1.0 + truth.offsetDn / full);
    EXPECT_NEAR(ValueOf(report.offset), truth.offsetDn, 5.0 * offsetSd) << camera;
    const double flicker = DrawTruth(simulation, 96).realisedFlickerSd;
    EXPECT_NEAR(ValueOf(report.flickerSd), flicker, 0.02 * flicker) << camera; // offset and v^* to 1 % each
    // Each pixel's term has variance 2 + 12/59; the noise of gamma_t, common to all pixels, adds 5 % at most.
    EXPECT_NEAR(*report.fit.reducedChi2, 1.0, 5.0 * std::sqrt(2.2 / pixels) + 0.05) << camera;
    EXPECT_EQ(report.bitDepth, 12) << camera;
    EXPECT_FALSE(HasWarning(report, "corrected-variance-curved")) << camera;
  }
}

TEST(SensorNoisePublishedMethod, WithoutFlickerOffsetAndReadNoiseAreNotIdentifiable)
{
  const auto     method = Measure(Simulate(SettingsOf(0.0, 40)), WithGlobalShutter());
  const Report & report = method.GetReport();
  EXPECT_NEAR(ValueOf(report.gain), 1.0, 0.065); // sd sqrt(2/39) 1,700 / (900 sqrt(1,300 pixels)): 1.2 %; 5 of them
  EXPECT_EQ(report.offset.status, EstimateStatus::NotIdentifiable);
  EXPECT_EQ(report.readNoise.status, EstimateStatus::NotIdentifiable);
  EXPECT_FALSE(report.offset.value || report.readNoise.value);
  EXPECT_TRUE(HasWarning(report, "offset-not-identifiable"));
  ASSERT_TRUE(report.offset.bracket && report.offset.bracket->high);
  EXPECT_GT(*report.offset.bracket->high, 100.0);
}

TEST(SensorNoisePublishedMethod, StrongFlickerAndLittleNoiseIdentifyTheOffset)
{
  SimulationSettings simulation = SettingsOf(0.15, 20);
  simulation.camera = { 1e5, 0.02, 100.0, 0.5 };
  for (simulation.seed = 1; simulation.seed <= 5; ++simulation.seed)
  {
    const auto method = Measure(Simulate(simulation), WithGlobalShutter());
    EXPECT_EQ(method.GetReport().offset.status, EstimateStatus::Identified) << simulation.seed;
  }
}

TEST(SensorNoisePublishedMethod, AnyChunksAndThreadsGiveTheSameBits)
{
  for (const bool rolling : { false, true })
  {
    SimulationSettings simulation = SettingsOf(0.05, 31);
    simulation.rollingShutterPeriodRows = rolling ? 40.0 : 0.0;
    const auto stack = Simulate(simulation);
    const auto expected = Measure(stack);
    for (const std::size_t chunk : { 1, 7, 30 })
    {
      const auto method = Measure(stack, {}, chunk, {}, test::Threads(4));
      EXPECT_EQ(ToJson(method.GetReport()), ToJson(expected.GetReport())) << chunk;
      EXPECT_EQ(method.GetMean(), expected.GetMean()) << chunk;
      EXPECT_EQ(method.GetVariance(), expected.GetVariance()) << chunk;
      EXPECT_EQ(method.GetPixelUse(), expected.GetPixelUse()) << chunk;
      for (std::size_t p = 0; p < expected.GetMean().size(); ++p)
      {
        const double variance = expected.GetCorrectedVariance()[p];
        ASSERT_TRUE(method.GetCorrectedVariance()[p] == variance || std::isnan(variance)) << chunk;
      }
    }
  }
}

TEST(SensorNoisePublishedMethod, PermutedFramesGiveTheSameCamera)
{
  const auto &      stack = FlickeringStack();
  auto              permuted = stack;
  const std::size_t pixels = stack.width * stack.height;
  for (std::size_t t = 0; t < stack.frames; ++t)
  {
    const std::size_t to = t * 7 % stack.frames;
    std::copy_n(stack.pixels.begin() + static_cast<std::ptrdiff_t>(t * pixels),
                pixels,
                permuted.pixels.begin() + static_cast<std::ptrdiff_t>(to * pixels));
  }
  const auto before = Measure(stack, WithGlobalShutter());
  const auto after = Measure(permuted, WithGlobalShutter());
  EXPECT_EQ(after.GetVariance(), before.GetVariance());
  ExpectSameCamera(before.GetReport(), after.GetReport());
  EXPECT_NEAR(after.GetReport().flicker[21], before.GetReport().flicker[3], 1e-12);
}

TEST(SensorNoisePublishedMethod, TransposedFramesSwapTheAxes)
{
  SimulationSettings simulation = SettingsOf(0.05, 40);
  simulation.conditions.vibrationSdXPixels = 0.3;
  simulation.conditions.vibrationSdYPixels = 0.1;
  for (const double period : { 0.0, 40.0 })
  {
    simulation.rollingShutterPeriodRows = period;
    const auto   stack = Simulate(simulation);
    Stack<Codes> transposed{ stack.height, stack.width, stack.frames, stack.pixels };
    for (std::size_t i = 0; i < stack.pixels.size(); ++i)
    {
      const std::size_t x = i % stack.width;
      const std::size_t y = i / stack.width % stack.height;
      const std::size_t t = i / stack.width / stack.height;
      transposed.pixels[(t * stack.width + x) * stack.height + y] = stack.pixels[i];
    }
    PublishedSettings alongX;
    alongX.shutterAxis = 0;
    const auto     method = Measure(stack);
    const auto     swapped = Measure(transposed, alongX);
    const Report & before = method.GetReport();
    const Report & after = swapped.GetReport();
    ExpectSameCamera(before, after);
    EXPECT_EQ(before.flickerRows.empty(), period == 0.0);
    EXPECT_EQ(after.flickerRows.empty(), period == 0.0);
    EXPECT_NEAR(ValueOf(after.vibrationSdX), ValueOf(before.vibrationSdY), 1e-8);
    EXPECT_NEAR(ValueOf(after.vibrationSdY), ValueOf(before.vibrationSdX), 1e-8);
    EXPECT_NEAR(ValueOf(after.vibrationCovariance), ValueOf(before.vibrationCovariance), 1e-8);
    EXPECT_GT(ValueOf(before.vibrationSdX), 2.0 * ValueOf(before.vibrationSdY)); // 0.3 against 0.1
  }
}

TEST(SensorNoisePublishedMethod, AddedConstantShiftsTheOffset)
{
  const auto before = Measure(FlickeringStack(), WithGlobalShutter());
  const auto after = Measure(FlickeringStack().Map<Codes>([](int u) { return u + 5000; }), WithGlobalShutter());
  // v = u / ubar is relative to each pixel's mean, and S^* reaches over means up to 1 % from u^* (3 sd of a mean are
  // 3 * 25 DN of 3,000, weighted): the constant re-weighs a flicker of 5 % by that, 5e-4.
  ExpectSameCamera(before.GetReport(), after.GetReport(), 1.0, 5000.0, 5e-4);
}

TEST(SensorNoisePublishedMethod, LeftAlignedCodesScaleTheCamera)
{
  const auto     stack = FlickeringStack().Map<Codes>([](int u) { return 16 * std::min(u, 3400); }); // saturated
  const auto     right = Measure(FlickeringStack().Map<Codes>([](int u) { return std::min(u, 3400); }));
  const auto     left = Measure(stack);
  const Report & before = right.GetReport();
  const Report & after = left.GetReport();
  ExpectSameCamera(before, after, 16.0);
  EXPECT_EQ(after.quantisationStepDn, 16.0);
  EXPECT_EQ(after.bitDepth, before.bitDepth);
  EXPECT_EQ(after.clipHighDn, 16.0 * before.clipHighDn.value());
  EXPECT_EQ(after.pixels.clipped, before.pixels.clipped);
}

TEST(SensorNoisePublishedMethod, SaturatedPixelsAreFoundAndLeftOut)
{
  const auto     method = Measure(FlickeringStack().Map<Codes>([](int u) { return std::min(u, 2900); }));
  const Report & report = method.GetReport();
  EXPECT_EQ(report.clipHighDn, 2900.0);
  EXPECT_TRUE(HasWarning(report, "clip-level-found"));
  EXPECT_GT(report.pixels.clipped, 0u);
  EXPECT_NEAR(ValueOf(report.gain), 1.0, 0.05);
}

TEST(SensorNoisePublishedMethod, FloatingPointPixelsGiveTheSameAsCodes)
{
  const auto        codes = Measure(FlickeringStack(), WithGlobalShutter());
  PublishedSettings given = WithGlobalShutter();
  given.codes = MakeCodeSettings(12, 0.0, 4095.0, 1.0);
  const auto floats = Measure(FlickeringStack().Map<float>([](int u) { return u; }), given);
  ExpectSameCamera(codes.GetReport(), floats.GetReport());
  EXPECT_EQ(codes.GetPixelUse(), floats.GetPixelUse());
  const auto signedCodes = Measure(FlickeringStack().Map<short>([](int u) { return u; }), WithGlobalShutter());
  ExpectSameCamera(codes.GetReport(), signedCodes.GetReport());
}

TEST(SensorNoisePublishedMethod, StacksWithoutInformationFailWithAReason)
{
  const auto clipped = Measure(ConstantStack<unsigned char>(255));
  ExpectNothingMeasured(clipped.GetReport(), "nothing-to-measure");
  EXPECT_EQ(clipped.GetReport().pixels.clipped, 320u);
  const auto constant = Measure(ConstantStack<Codes>(700));
  ExpectNothingMeasured(constant.GetReport(), "nothing-to-measure");
  EXPECT_EQ(constant.GetPixelUse()[30], static_cast<std::uint8_t>(PixelUse::Constant));
  EXPECT_EQ(constant.GetPixelUse()[5], static_cast<std::uint8_t>(PixelUse::Border));
  const auto nan = Measure(ConstantStack<float>(std::numeric_limits<float>::quiet_NaN()));
  ExpectNothingMeasured(nan.GetReport(), "nothing-to-measure");
  EXPECT_EQ(nan.GetReport().pixels.notFinite, 320u);
  EXPECT_TRUE(nan.GetCorrectedVariance().empty());
  auto              repeated = FlickeringStack();
  const std::size_t pixels = repeated.width * repeated.height;
  for (std::size_t i = pixels; i < repeated.pixels.size(); ++i)
  {
    repeated.pixels[i] = repeated.pixels[i % pixels];
  }
  ExpectNothingMeasured(Measure(repeated).GetReport(), "nothing-to-measure");
}

TEST(SensorNoisePublishedMethod, OneIntensityIsTooSmallARange)
{
  auto                stack = ConstantStack<float>(0.0F, 40);
  CounterSeededRandom random(3);
  std::generate(
    stack.pixels.begin(), stack.pixels.end(), [&] { return static_cast<float>(500.0 + 20.0 * random.Normal()); });
  const auto method = Measure(stack);
  EXPECT_EQ(method.GetReport().gain.status, EstimateStatus::NotIdentifiable);
  EXPECT_TRUE(HasWarning(method.GetReport(), "intensity-range-too-small"));
}

TEST(SensorNoisePublishedMethod, MaskedPixelsTakeNoPart)
{
  auto                      stack = FlickeringStack();
  std::vector<std::uint8_t> mask(stack.width * stack.height, 1);
  for (std::size_t p = 0; p < mask.size(); ++p)
  {
    mask[p] = p / stack.width < 40 ? 7 : 0;
  }
  PublishedSettings settings = WithGlobalShutter();
  settings.codes = MakeCodeSettings(12, 0.0, 4095.0, 1.0); // else the masked pixels' codes count
  const auto expected = Measure(stack, settings, 1000, mask);
  for (std::size_t i = 0; i < stack.pixels.size(); ++i)
  {
    if (i / stack.width % stack.height > 40) // row 40 is the neighbour of the last used one
    {
      stack.pixels[i] = static_cast<Codes>(i * 977 % 4096);
    }
  }
  const auto method = Measure(stack, settings, 1000, mask);
  ExpectSameCamera(expected.GetReport(), method.GetReport(), 1.0, 0.0, 0.0);
  EXPECT_EQ(method.GetPixelUse(), expected.GetPixelUse());
  EXPECT_EQ(std::count(method.GetPixelUse().begin(), method.GetPixelUse().end(), std::uint8_t{ 7 }), 16 * 64);
  mask.assign(mask.size(), 0);
  ExpectNothingMeasured(Measure(stack, settings, 1000, mask).GetReport(), "nothing-to-measure");
}

TEST(SensorNoisePublishedMethod, WrongUseIsRefused)
{
  using Method = PublishedMethod<Codes>;
  const FrameGeometry geometry{ 20, 16, 1 };
  EXPECT_THROW(Method({}, geometry, 4), std::invalid_argument);
  EXPECT_NO_THROW(Method({}, geometry, 5));
  EXPECT_THROW(Method({}, { 2, 2, 1 }, 20), std::invalid_argument);
  EXPECT_THROW(Method({}, geometry, 20, std::vector<std::uint8_t>(319, 1)), std::invalid_argument);
  PublishedSettings settings;
  settings.level = 0.0;
  EXPECT_THROW(Method(settings, geometry, 20), std::invalid_argument);
  settings = {};
  settings.brightQuantile = 0.005;
  EXPECT_THROW(Method(settings, geometry, 20), std::invalid_argument);
  settings = {};
  settings.codes.bitDepth = 10;
  EXPECT_THROW(Measure(FlickeringStack(), settings), std::invalid_argument); // the data reach beyond 1,023
}

TEST(SensorNoisePublishedMethod, PassOfWrongLengthIsRefused)
{
  const auto             stack = ConstantStack<Codes>(700);
  PublishedMethod<Codes> shortPass({}, { 20, 16, 1 }, 20);
  shortPass.AddFrames(stack.pixels.data(), 19);
  EXPECT_THROW(shortPass.EndPass(), std::logic_error);
  for (unsigned int pass = 0; pass < 3; ++pass)
  {
    PublishedMethod<Codes> longPass({}, { 20, 16, 1 }, 19);
    for (unsigned int before = 0; before < pass; ++before)
    {
      longPass.AddFrames(stack.pixels.data(), 19);
      longPass.EndPass();
    }
    longPass.AddFrames(stack.pixels.data(), 10);
    EXPECT_THROW(longPass.AddFrames(stack.pixels.data(), 10), std::logic_error) << pass;
  }
}
