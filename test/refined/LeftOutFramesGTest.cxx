// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "mosaic/MosaicPasses.h"
#include "refined/RefinedPasses.h"
#include "sensornoise/StackMethod.h"
#include "helpers/LeftOutTestHelper.h"
#include "helpers/MergeTestHelper.h"
#include "helpers/RepeatedTestHelper.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <gtest/gtest.h>
#include <limits>
#include <sstream>
#include <string>
#include <vector>

// Frames that are unlike the others are left out: the result has the bits of the result of the others alone.

using namespace sensornoise;
using namespace sensornoise::test;
using namespace sensornoise::test::merge;

namespace
{
using GreyValue = unsigned short;

std::string
NamesOf(const std::vector<LeftOutFrame> & frames)
{
  std::string names;
  for (const auto & [frame, fault] : frames)
  {
    names += std::to_string(frame) + " " + NameOf(fault) + "; ";
  }
  return names;
}

constexpr double OffsetDn = 100.0;

/** Returns frames that are large enough to measure the noise of a frame within 2 %. */
Stack<GreyValue>
NoisyStack(std::size_t frames)
{
  SimulationSettings settings = FlickeringSettings(frames);
  settings.camera = { 2000.0, 0.5, OffsetDn, 3.0 };
  settings.conditions = { 0.03, 0.0, 0.0 };
  return Simulate<GreyValue>(settings, 128, 96);
}

/** Returns the first frames of a stack, and three more of another gain. */
Stack<GreyValue>
WithFramesOfAnotherGain(const Stack<GreyValue> & stack)
{
  const auto more = NoisyStack(stack.frames + 3);
  return Insert(stack,
                { { std::size_t{ 4 }, OfAnotherGain(more, stack.frames, 1.5, OffsetDn) },
                  { std::size_t{ 9 }, OfAnotherGain(more, stack.frames + 1, 1.5, OffsetDn) },
                  { std::size_t{ 20 }, OfAnotherGain(more, stack.frames + 2, 1.5, OffsetDn) } });
}

/** Returns a stack in which each frame is followed by a frame that equals it. */
Stack<GreyValue>
ShowTwice(const Stack<GreyValue> & stack)
{
  Shown shown;
  for (std::size_t t = 0; t < stack.frames; ++t)
  {
    shown.insert(shown.end(), { t, t });
  }
  return Show(stack, shown);
}

/** Runs one pass in two processes that read alternate frames. */
void
RunSharedPass(RefinedMethod<GreyValue> & one, RefinedMethod<GreyValue> & two, const Stack<GreyValue> & stack)
{
  AddPart(one, stack, 0, 2, InTurn);
  AddPart(two, stack, 1, 2, InTurn);
  std::stringstream ofOne;
  std::stringstream ofTwo;
  one.SaveSums(ofOne);
  two.SaveSums(ofTwo);
  one.MergeSums(ofTwo);
  two.MergeSums(ofOne);
  one.EndPass();
  two.EndPass();
}
} // namespace

template <typename TPixel>
class SensorNoiseLeftOutFramesOf : public ::testing::Test
{};
using PixelTypes = ::testing::Types<unsigned short, float>;
TYPED_TEST_SUITE(SensorNoiseLeftOutFramesOf, PixelTypes);

TYPED_TEST(SensorNoiseLeftOutFramesOf, AreNamedAndTheRestIsMeasuredAsWithoutThem)
{
  const auto & stack = SmallStack<TypeParam>();
  const auto   expected = Measure(stack);
  ASSERT_EQ(expected.GetReport().gain.status, EstimateStatus::Identified);
  ASSERT_EQ(NamesOf(expected.GetReport().framesLeftOut), "");
  const auto unlike = WithUnlikeFrames(stack);
  for (const std::size_t chunk : { 1, 4, 1000 })
  {
    const auto method = Measure(unlike, WithDnSettings(), chunk, Threads(chunk % 3 + 1));
    EXPECT_EQ(NamesOf(method.GetReport().framesLeftOut), "0 no-noise; 5 no-noise; 26 other-shape; ");
    ExpectResultOfOthers(method, expected);
  }
}

TEST(SensorNoiseLeftOutFrames, AreNamedInOneWarning)
{
  const auto method = Measure(WithUnlikeFrames(SmallStack<GreyValue>()));
  EXPECT_EQ(
    method.GetReport().warnings.front().message,
    "3 of 27 frames are unlike the others (frame 0: no-noise, frame 5: no-noise, frame 26: other-shape; the "
    "first is 0) and would change the variance of all pixels: all else is measured without them. Check how they "
    "were recorded");
}

TEST(SensorNoiseLeftOutFrames, OfFramesThatAreNotFiniteAreNamed)
{
  const auto &             stack = SmallStack<float>();
  const std::vector<float> unknown(stack.width * stack.height, std::numeric_limits<float>::quiet_NaN());
  const auto               method = Measure(Insert(stack, { { std::size_t{ 7 }, unknown } }));
  EXPECT_EQ(NamesOf(method.GetReport().framesLeftOut), "7 not-finite; ");
  ExpectResultOfOthers(method, Measure(stack));
}

TEST(SensorNoiseLeftOutFrames, ThatAreEqualAreLeftOutTogetherAndRepeatedOnesAreCountedOnce)
{
  const auto & stack = SmallStack<GreyValue>();
  Shown        shown = { 0, 0 };
  for (std::size_t t = 0; t < stack.frames; ++t)
  {
    shown.push_back(t + 1);
  }
  shown.push_back(9);
  const Stack<GreyValue> first = Insert(stack, { { std::size_t{ 0 }, Mirrored(stack, 3) } });
  Report                 report = Measure(Show(first, shown)).GetReport();
  EXPECT_EQ(NamesOf(report.framesLeftOut), "0 other-shape; 1 other-shape; ");
  EXPECT_EQ(report.framesDistinct, stack.frames);
  EXPECT_TRUE(HasWarning(report, WarningCode::RepeatedFrames));
  EXPECT_EQ(report.gain.value, Measure(stack).GetReport().gain.value);
}

TEST(SensorNoiseLeftOutFrames, AreUnlikeHoweverOftenTheyAreRepeated)
{
  const auto &           stack = SmallStack<GreyValue>();
  const Stack<GreyValue> first = Insert(stack, { { std::size_t{ 0 }, Mirrored(stack, 3) } });
  Shown                  shown(stack.frames, 0); // half of the frames as given
  for (std::size_t t = 0; t < stack.frames; ++t)
  {
    shown.push_back(t + 1);
  }
  const Report report = Measure(Show(first, shown)).GetReport();
  EXPECT_EQ(report.framesLeftOut.size(), stack.frames);
  EXPECT_EQ(report.framesDistinct, stack.frames);
  EXPECT_EQ(report.gain.value, Measure(stack).GetReport().gain.value);
}

TEST(SensorNoiseLeftOutFrames, OfSeveralProcessesAreThoseOfOne)
{
  const auto &             stack = SmallStack<GreyValue>();
  const auto               unlike = WithUnlikeFrames(stack);
  RefinedMethod<GreyValue> one = MethodOf(unlike);
  RefinedMethod<GreyValue> two = MethodOf(unlike);
  unsigned int             passes = 0;
  for (; !one.IsDone(); ++passes)
  {
    RunSharedPass(one, two, unlike);
  }
  EXPECT_EQ(passes, 4U); // the moments are summed twice
  EXPECT_TRUE(two.IsDone());
  const auto expected = Measure(stack);
  ExpectResultOfOthers(one, expected);
  ExpectResultOfOthers(two, expected);
}

TEST(SensorNoiseLeftOutFrames, OfAPassThatIsForgottenAreReadAgain)
{
  const auto &             stack = SmallStack<GreyValue>();
  const auto               unlike = WithUnlikeFrames(stack);
  RefinedMethod<GreyValue> method = MethodOf(unlike);
  while (!method.IsDone())
  {
    method.AddFrames(unlike.Frame(0), 10);
    method.ForgetSums();
    method.AddFrames(unlike.Frame(0), unlike.frames);
    method.EndPass();
  }
  ExpectResultOfOthers(method, Measure(stack));
}

TEST(SensorNoiseLeftOutFrames, OfThePublishedMethodAreLeftOutAlike)
{
  const auto & stack = SmallStack<GreyValue>();
  const auto   measure = [](const Stack<GreyValue> & frames) {
    PublishedSettings settings;
    settings.dnSettings = WithDnSettings().dnSettings;
    PublishedMethod<GreyValue> method(settings, GeometryOf(frames), frames.frames);
    while (!method.IsDone())
    {
      method.AddFrames(frames.Frame(0), frames.frames);
      method.EndPass();
    }
    return method;
  };
  ExpectResultOfOthers(measure(WithUnlikeFrames(stack)), measure(stack));
}

TEST(SensorNoiseLeftOutFrames, OfOnePlaneOfAMosaicAreLeftOutOfAll)
{
  // All planes show the scene, each with noise of its own. One frame has zeros in the plane of the blue pixels alone.
  std::vector<Stack<GreyValue>> stacks;
  for (const std::uint64_t seed : { 1, 2, 3, 4 })
  {
    SimulationSettings settings = FlickeringSettings(Frames);
    settings.seed = seed;
    stacks.push_back(Simulate<GreyValue>(settings, Width, Height));
  }
  const Stack<GreyValue> & plane = stacks.front();
  const MosaicGeometry     geometry{ { 2 * plane.width, 2 * plane.height, 1 }, BayerPattern::RGGB };
  constexpr std::size_t    at = 4;
  const auto               frameOf = [&](std::size_t k, std::size_t t) {
    return std::vector<GreyValue>(stacks[k].Frame(t), stacks[k].Frame(t) + plane.width * plane.height);
  };
  Stack<GreyValue> mosaic{ geometry.frame.width, geometry.frame.height, plane.frames, {} };
  for (std::size_t t = 0; t < plane.frames; ++t)
  {
    std::array<std::vector<GreyValue>, 4> planes;
    for (std::size_t k = 0; k < planes.size(); ++k)
    {
      planes[k] = frameOf(k, t);
    }
    if (t == at)
    {
      planes.at(static_cast<std::size_t>(BayerPlane::B)).assign(plane.width * plane.height, 0);
    }
    const std::vector<GreyValue> frame = geometry.Join(planes, GreyValue{ 0 }, SerialFor);
    mosaic.pixels.insert(mosaic.pixels.end(), frame.begin(), frame.end());
  }
  MosaicPasses<GreyValue, RefinedPasses<GreyValue>> method(geometry, [&](BayerPlane, const ParallelFor & parallelFor) {
    return RefinedPasses<GreyValue>(WithDnSettings(), geometry.Plane(), plane.frames, {}, parallelFor);
  });
  while (!method.IsDone())
  {
    method.AddFrames(mosaic.Frame(0), mosaic.frames);
    method.EndPass();
  }
  const std::array<Report, 4> reports = method.GetReports();
  for (std::size_t k = 0; k < reports.size(); ++k)
  {
    Stack<GreyValue> others{ plane.width, plane.height, plane.frames - 1, {} };
    for (std::size_t t = 0; t < plane.frames; ++t)
    {
      const std::vector<GreyValue> frame = frameOf(k, t);
      others.pixels.insert(others.pixels.end(), frame.begin(), t == at ? frame.begin() : frame.end());
    }
    EXPECT_EQ(NamesOf(reports[k].framesLeftOut), "4 no-noise; ");
    ExpectReportOfOthers(reports[k], Measure(others).GetReport());
  }
}

TEST(SensorNoiseLeftOutFrames, OfAnotherGainAreFoundByTheirNoise)
{
  const auto & stack = NoisyStack(40);
  const auto   expected = Measure(stack, RefinedSettings());
  ASSERT_EQ(expected.GetReport().gain.status, EstimateStatus::Identified);
  const auto unlike = WithFramesOfAnotherGain(stack);
  for (const std::size_t chunk : { 1, 7, 1000 })
  {
    const auto method = Measure(unlike, RefinedSettings(), chunk, Threads(chunk % 3 + 1));
    EXPECT_EQ(NamesOf(method.GetReport().framesLeftOut), "4 other-noise; 9 other-noise; 20 other-noise; ");
    ExpectResultOfOthers(method, expected);
  }
}

TEST(SensorNoiseLeftOutFrames, OfAnotherGainInSeveralProcessesAreThoseOfOne)
{
  const auto               unlike = WithFramesOfAnotherGain(NoisyStack(40));
  const FrameGeometry      geometry{ unlike.width, unlike.height };
  RefinedMethod<GreyValue> one(RefinedSettings(), geometry, unlike.frames);
  RefinedMethod<GreyValue> two(RefinedSettings(), geometry, unlike.frames);
  while (!one.IsDone())
  {
    RunSharedPass(one, two, unlike);
  }
  ASSERT_TRUE(two.IsDone());
  const auto whole = Measure(unlike, RefinedSettings());
  EXPECT_EQ(ToJson(one.GetReport()), ToJson(whole.GetReport()));
  EXPECT_EQ(ToJson(two.GetReport()), ToJson(whole.GetReport()));
}

TEST(SensorNoiseLeftOutFrames, OfAnotherGainAreLeftOutWithTheFramesThatEqualThem)
{
  const auto   unlike = WithFramesOfAnotherGain(NoisyStack(40));
  const Report report = Measure(ShowTwice(unlike), RefinedSettings()).GetReport();
  EXPECT_EQ(NamesOf(report.framesLeftOut),
            "8 other-noise; 9 other-noise; 18 other-noise; 19 other-noise; 40 other-noise; 41 other-noise; ");
  EXPECT_EQ(report.framesDistinct, 40U);
}

namespace
{
/** Returns a stack in which \a count frames, one in \a every, have another gain. */
Stack<GreyValue>
Mix(Stack<GreyValue> stack, std::size_t every, std::size_t count, double gain)
{
  for (std::size_t k = 0; k < count; ++k)
  {
    const std::size_t t = k * every;
    const auto        frame = OfAnotherGain(stack, t, gain, OffsetDn);
    std::copy(frame.begin(), frame.end(), stack.pixels.begin() + static_cast<std::ptrdiff_t>(t * frame.size()));
  }
  return stack;
}

Report
ReportOfMixed(const Stack<GreyValue> & stack, std::size_t every, std::size_t count, double gain)
{
  return Measure(Mix(stack, every, count, gain), RefinedSettings()).GetReport();
}
} // namespace

TEST(SensorNoiseLeftOutFrames, AreAsManyAsWithoutTheFramesThatEqualOthers)
{
  for (const std::size_t count : { 9, 12, 17 })
  {
    const auto   mixed = Mix(NoisyStack(40), 2, count, 2.0);
    const Report once = Measure(mixed, RefinedSettings()).GetReport();
    const Report twice = Measure(ShowTwice(mixed), RefinedSettings()).GetReport();
    EXPECT_EQ(twice.framesLeftOut.size(), 2 * once.framesLeftOut.size()) << count;
    EXPECT_EQ(twice.gain.value, once.gain.value) << count;
  }
}

TEST(SensorNoiseLeftOutFrames, OfSeveralGainsInHalfOfTheStackGiveNoGain)
{
  const Report report = ReportOfMixed(NoisyStack(40), 2, 20, 2.0);
  EXPECT_FALSE(report.gain.value) << *report.gain.value;
  EXPECT_TRUE(report.framesLeftOut.empty());
}

TEST(SensorNoiseLeftOutFrames, OfAStepOfTheGainAreNamedInGroups)
{
  // The halves differ by 25 %: each is within 12 % of the mean.
  const Report report = ReportOfMixed(NoisyStack(40), 1, 20, 1.25);
  EXPECT_FALSE(report.gain.value) << *report.gain.value;
  ASSERT_FALSE(report.warnings.empty());
  std::string all;
  for (const Warning & warning : report.warnings)
  {
    all += warning.message;
  }
  EXPECT_NE(all.find("in groups (frames 0 to 19"), std::string::npos) << all;
}

TEST(SensorNoiseLeftOutFrames, OfNoiseAloneMakeNoLocalIllumination)
{
  // Four times the noise variance at the same level, as in interpolated or amplified frames. The noise of a single
  // frame must not be removed as local illumination.
  auto       stack = NoisyStack(40);
  const auto others = NoisyStack(43);
  const auto pixels = stack.width * stack.height;
  for (const std::size_t t : { std::size_t{ 8 }, std::size_t{ 21 } })
  {
    for (std::size_t p = 0; p < pixels; ++p)
    {
      const double noise = static_cast<double>(others.pixels[40 * pixels + p]) -
                           static_cast<double>(others.pixels[(t == 8 ? 41 : 42) * pixels + p]);
      stack.pixels[t * pixels + p] = static_cast<GreyValue>(
        std::clamp(std::round(static_cast<double>(stack.pixels[t * pixels + p]) + 1.5 * noise), 0.0, 65535.0));
    }
  }
  const Report report = Measure(stack, RefinedSettings()).GetReport();
  EXPECT_EQ(NamesOf(report.framesLeftOut), "8 other-noise; 21 other-noise; ");
  EXPECT_FALSE(HasWarning(report, WarningCode::LocalLight));
}

TEST(SensorNoiseLeftOutFrames, OfAnotherDarkOffsetAreNamed)
{
  const auto stack = NoisyStack(40);
  const auto raised = [&](std::size_t count) {
    auto frames = stack;
    for (std::size_t k = 0; k < count; ++k)
    {
      const std::size_t first = (3 + 2 * k) * stack.width * stack.height;
      for (std::size_t p = 0; p < stack.width * stack.height; ++p)
      {
        frames.pixels[first + p] = static_cast<GreyValue>(frames.pixels[first + p] + 15);
      }
    }
    return Measure(frames, RefinedSettings()).GetReport();
  };
  EXPECT_EQ(NamesOf(raised(2).framesLeftOut), "3 other-offset; 5 other-offset; ");
  // More than a fifth of the frames: the offset is ambiguous.
  const Report report = raised(12);
  EXPECT_TRUE(report.framesLeftOut.empty());
  EXPECT_FALSE(report.offset.value) << *report.offset.value;
  EXPECT_TRUE(HasWarning(report, WarningCode::OffsetNotIdentifiable));
}
