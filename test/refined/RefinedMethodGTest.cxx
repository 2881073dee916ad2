// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/FrameGeometry.h"
#include "sensornoise/Parallel.h"
#include "sensornoise/Report.h"
#include "sensornoise/StackMethod.h"
#include "sensornoise/Settings.h"
#include "sensornoise/ReportText.h"
#include "sensornoise/Simulator.h"
#include "sensornoise/SimulationSettings.h"
#include "helpers/RefinedTestHelper.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <gtest/gtest.h>
#include <functional>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

using namespace sensornoise;
using namespace sensornoise::test;

namespace
{
using GreyValue = unsigned short;
constexpr std::size_t Width = 128; // 12,288 pixels are two blocks
constexpr std::size_t Height = 96;

template <typename TPixel>
const Stack<TPixel> &
TexturedStack()
{
  static const auto stack = Simulate<TPixel>(FlickeringSettings(40), Width, Height, MakeTextureScene(Width, Height));
  return stack;
}

void
ExpectNothingMeasured(const Report & report)
{
  EXPECT_FALSE(report.IsUsable());
  for (const Quantity & quantity : { report.gain, report.offset, report.readNoise, report.intercept })
  {
    EXPECT_EQ(quantity.status, EstimateStatus::Failed);
    EXPECT_FALSE(quantity.value);
  }
  EXPECT_TRUE(HasWarning(report, WarningCode::NothingToMeasure)) << ToJson(report);
}
} // namespace

template <typename TPixel>
class SensorNoiseRefinedMethodBits : public ::testing::Test
{};
using PixelTypes = ::testing::Types<unsigned short, float>;
TYPED_TEST_SUITE(SensorNoiseRefinedMethodBits, PixelTypes);

TYPED_TEST(SensorNoiseRefinedMethodBits, AnyChunksAndThreadsGiveTheSameBits)
{
  const auto & stack = TexturedStack<TypeParam>();
  const auto   expected = Measure(stack);
  ASSERT_EQ(expected.GetReport().gain.status, EstimateStatus::Identified);
  ASSERT_TRUE(expected.GetReport().noiseCorrelation); // every digit is compared
  for (const std::size_t threads : { 1, 2, 7 })
  {
    for (const std::size_t chunk : { std::size_t{ 1 }, std::size_t{ 3 }, stack.frames })
    {
      const auto method =
        Measure(stack, WithDnSettings(), chunk, threads == 1 ? ParallelFor(SerialFor) : Threads(threads));
      EXPECT_EQ(ToJson(method.GetReport()), ToJson(expected.GetReport())) << threads << ' ' << chunk;
      EXPECT_TRUE(HaveSameBits(method.GetMean(), expected.GetMean())) << threads << ' ' << chunk;
      EXPECT_TRUE(HaveSameBits(method.GetVariance(), expected.GetVariance())) << threads << ' ' << chunk;
      EXPECT_TRUE(HaveSameBits(method.GetPixelUse(), expected.GetPixelUse())) << threads << ' ' << chunk;
      EXPECT_TRUE(HaveSameBits(method.GetCorrectedVariance(), expected.GetCorrectedVariance()))
        << threads << ' ' << chunk;
    }
  }
}

TEST(SensorNoiseRefinedMethod, RecoversTheCameraWithinItsErrors)
{
  const auto     settings = FlickeringSettings(40);
  const auto     method = Measure(TexturedStack<GreyValue>());
  const Report & report = method.GetReport();
  const auto     expectNear = [](const Quantity & quantity, double truth) {
    ASSERT_TRUE(quantity.value && quantity.standardError);
    EXPECT_NEAR(*quantity.value, truth, 5.0 * *quantity.standardError); // one seed: 6e-7 by chance
  };
  expectNear(report.gain, settings.camera.gainDnPerElectron);
  expectNear(report.offset, settings.camera.offsetDn);
  expectNear(report.readNoise, settings.camera.readNoiseDn);
  const SimulationTruth truth = DrawTruth(settings, Height);
  expectNear(report.flickerSd, truth.realisedFlickerSd);
  ASSERT_EQ(report.flicker.size(), settings.frames);
  // sd(gamma_t) = (sum q^2 / V)^(-1/2) with q^2 / V at least 1,000 in half of the pixels: 4e-4.
  for (std::size_t t = 0; t < settings.frames; ++t)
  {
    EXPECT_NEAR(report.flicker[t], truth.normalisedFlicker[t], 5 * 4e-4) << t;
  }
  EXPECT_EQ(report.frames, 40u);
  EXPECT_EQ(report.pixels.total, Width * Height);
  EXPECT_EQ(report.method, "refined");
}

TEST(SensorNoiseRefinedMethod, WithoutFlickerOffsetAndReadNoiseAreNotIdentifiable)
{
  auto settings = FlickeringSettings(40);
  settings.conditions.flickerSd = 0.0;
  const auto     method = Measure(Simulate<GreyValue>(settings, Width, Height));
  const Report & report = method.GetReport();
  EXPECT_NEAR(ValueOf(report.gain), 1.0, 5.0 * *report.gain.standardError);
  EXPECT_EQ(report.offset.status, EstimateStatus::NotIdentifiable);
  EXPECT_EQ(report.readNoise.status, EstimateStatus::NotIdentifiable);
  EXPECT_FALSE(report.offset.value || report.readNoise.value);
  EXPECT_TRUE(HasWarning(report, WarningCode::OffsetNotIdentifiable));
  ASSERT_TRUE(report.readNoise.bracket && report.readNoise.bracket->high);
  EXPECT_GT(*report.readNoise.bracket->high, 0.0);
}

TEST(SensorNoiseRefinedMethod, MaskedPixelsTakeNoPart)
{
  auto                      stack = TexturedStack<GreyValue>();
  std::vector<std::uint8_t> mask(Width * Height, 1);
  for (std::size_t p = 0; p < mask.size(); ++p)
  {
    mask[p] = p / Width < 70 ? 7 : 0;
  }
  const auto measure = [&] {
    RefinedMethod<GreyValue> method(WithDnSettings(), GeometryOf(stack), stack.frames, mask);
    while (!method.IsDone())
    {
      method.AddFrames(stack.Frame(0), stack.frames);
      method.EndPass();
    }
    return method;
  };
  const auto expected = measure();
  ASSERT_EQ(expected.GetReport().gain.status, EstimateStatus::Identified);
  for (std::size_t i = 0; i < stack.pixels.size(); ++i)
  {
    if (i / Width % Height >= 70)
    {
      stack.pixels[i] = stack.pixels[i] > 5 ? static_cast<GreyValue>(stack.pixels[i] - 5) : stack.pixels[i];
    }
  }
  const auto method = measure();
  EXPECT_EQ(std::count(method.GetPixelUse().begin(), method.GetPixelUse().end(), std::uint8_t{ 7 }), 26 * Width);
  // The stencils of rows 68 and 69 contain masked rows, 2 rows of 66. The other rows must not change.
  EXPECT_NEAR(ValueOf(method.GetReport().gain),
              ValueOf(expected.GetReport().gain),
              0.5 * *expected.GetReport().gain.standardError);
  mask.assign(mask.size(), 0);
  ExpectNothingMeasured(measure().GetReport());
}

TEST(SensorNoiseRefinedMethod, StacksWithoutInformationFailWithAReason)
{
  const auto constant = [](auto value) {
    using Pixel = decltype(value);
    return Stack<Pixel>{ 20, 16, 20, std::vector<Pixel>(20 * 16 * 20, value) };
  };
  const auto clipped = Measure(constant(static_cast<unsigned char>(255)), {});
  ExpectNothingMeasured(clipped.GetReport());
  EXPECT_EQ(clipped.GetReport().pixels.clipped, 320u);
  auto frames = constant(GreyValue{ 700 });
  for (std::size_t t = 0; t < frames.frames; ++t)
  {
    frames.pixels[t * 20 * 16] = static_cast<GreyValue>(700 + t); // otherwise all frames are equal
  }
  const auto measured = Measure(frames, {});
  ExpectNothingMeasured(measured.GetReport());
  EXPECT_EQ(measured.GetReport().framesDistinct, frames.frames);
  EXPECT_EQ(measured.GetPixelUse()[50], static_cast<std::uint8_t>(PixelUse::Constant));
  EXPECT_TRUE(measured.GetCorrectedVariance().empty());
  const auto nan = Measure(constant(std::numeric_limits<float>::quiet_NaN()), {});
  ExpectNothingMeasured(nan.GetReport());
  EXPECT_EQ(nan.GetReport().pixels.notFinite, 320u);
}

TEST(SensorNoiseRefinedMethod, WrongUseIsRefused)
{
  using Method = RefinedMethod<GreyValue>;
  const FrameGeometry geometry{ 20, 16, 1 };
  EXPECT_THROW(Method({}, geometry, 4), std::invalid_argument);
  EXPECT_NO_THROW(Method({}, geometry, 5));
  EXPECT_THROW(Method({}, { 2, 3, 1 }, 20), std::invalid_argument);
  EXPECT_THROW(Method({}, geometry, 20, std::vector<std::uint8_t>(319, 1)), std::invalid_argument);
  RefinedSettings settings;
  settings.dnSettings.bitDepth = 17;
  EXPECT_THROW(Method(settings, geometry, 20), std::invalid_argument);
  settings.dnSettings.bitDepth = 10;
  EXPECT_THROW(Measure(TexturedStack<GreyValue>(), settings), std::invalid_argument); // the data exceed 1,023
}

// The sums of the second pass point to the scene of the first pass, whose address must not change with a move.
TEST(SensorNoiseRefinedMethod, MayBeMovedBetweenAndWithinPasses)
{
  const auto & stack = TexturedStack<GreyValue>();
  using Method = RefinedMethod<GreyValue>;
  auto method = std::make_unique<Method>(WithDnSettings(), GeometryOf(stack), stack.frames);
  while (!method->IsDone())
  {
    method = std::make_unique<Method>(std::move(*method));
    method->AddFrames(stack.Frame(0), 7);
    method = std::make_unique<Method>(std::move(*method));
    method->AddFrames(stack.Frame(7), stack.frames - 7);
    method->EndPass();
  }
  EXPECT_EQ(ToJson(method->GetReport()), ToJson(Measure(stack).GetReport()));
}

// Only NothingToMeasure becomes a report. Other exceptions, as of a thread that cannot be started, are not caught.
TEST(SensorNoiseRefinedMethod, OtherErrorsPassThrough)
{
  const auto & stack = TexturedStack<GreyValue>();
  bool         isBroken = false;
  const auto   parallelFor = [&isBroken](std::size_t count, const std::function<void(std::size_t)> & function) {
    if (isBroken)
    {
      throw std::system_error(std::make_error_code(std::errc::resource_unavailable_try_again));
    }
    SerialFor(count, function);
  };
  RefinedMethod<GreyValue> method(WithDnSettings(), GeometryOf(stack), stack.frames, {}, parallelFor);
  method.AddFrames(stack.Frame(0), stack.frames);
  isBroken = true;
  EXPECT_THROW(method.EndPass(), std::system_error);
}

TEST(SensorNoiseRefinedMethod, PassOfWrongLengthIsRefused)
{
  const auto &             stack = TexturedStack<GreyValue>();
  const FrameGeometry      geometry{ Width, Height, 1 };
  RefinedMethod<GreyValue> shortPass({}, geometry, 40);
  shortPass.AddFrames(stack.Frame(0), 39);
  EXPECT_THROW(shortPass.EndPass(), std::logic_error);
  shortPass.AddFrames(stack.Frame(39), 1);
  EXPECT_NO_THROW(shortPass.EndPass());
  RefinedMethod<GreyValue> longPass({}, geometry, 39);
  longPass.AddFrames(stack.Frame(0), 30);
  EXPECT_THROW(longPass.AddFrames(stack.Frame(30), 10), std::logic_error);
}
