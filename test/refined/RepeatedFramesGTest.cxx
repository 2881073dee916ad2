// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/StackMethod.h"
#include "helpers/MergeTestHelper.h"
#include "helpers/RepeatedTestHelper.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <gtest/gtest.h>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

// Equal frames are counted once: the result has the bits of the result of the distinct frames.

using namespace sensornoise;
using namespace sensornoise::test;
using namespace sensornoise::test::merge;

namespace
{
using GreyValue = unsigned short;

/** Returns the small stack with each frame twice. */
Stack<GreyValue>
Doubled(Shown & shown)
{
  shown = WaysToRepeat(Frames).front().second;
  return Show(SmallStack<GreyValue>(), shown);
}

std::string
SumsOf(const RefinedMethod<GreyValue> & method)
{
  std::ostringstream out;
  method.SaveSums(out);
  return out.str();
}

void
MergeText(RefinedMethod<GreyValue> & method, const std::string & sums)
{
  std::istringstream in(sums);
  method.MergeSums(in);
}

/** Measures with two processes. The first reads frame t if \a isFirst(t). */
template <typename TIsFirst>
void
RunPass(RefinedMethod<GreyValue> & one,
        RefinedMethod<GreyValue> & two,
        const Stack<GreyValue> &   stack,
        TIsFirst                   isFirst)
{
  for (std::size_t t = 0; t < stack.frames; ++t)
  {
    isFirst(t) ? one.AddFrames(stack.Frame(t), 1) : one.SkipFrames(1);
    isFirst(t) ? two.SkipFrames(1) : two.AddFrames(stack.Frame(t), 1);
  }
  const std::string sums = SumsOf(one);
  MergeText(one, SumsOf(two));
  MergeText(two, sums);
  one.EndPass();
  two.EndPass();
}
} // namespace

template <typename TPixel>
class SensorNoiseRepeatedFramesOf : public ::testing::Test
{};
using PixelTypes = ::testing::Types<unsigned short, float>;
TYPED_TEST_SUITE(SensorNoiseRepeatedFramesOf, PixelTypes);

TYPED_TEST(SensorNoiseRepeatedFramesOf, AnyWayGiveTheResultOfTheDistinctOnes)
{
  Stack<TypeParam> stack = SmallStack<TypeParam>();
  if (std::numeric_limits<TypeParam>::has_quiet_NaN)
  {
    for (std::size_t t = 0; t < Frames; ++t) // NaN is compared by its bytes
    {
      stack.pixels[t * Width * Height + 1000] = std::numeric_limits<TypeParam>::quiet_NaN();
    }
  }
  const auto expected = Measure(stack);
  ASSERT_EQ(expected.GetReport().gain.status, EstimateStatus::Identified);
  for (const auto & [name, shown] : WaysToRepeat(Frames))
  {
    SCOPED_TRACE(name);
    ExpectResultOfDistinct(Measure(Show(stack, shown)), expected, shown);
  }
}

TYPED_TEST(SensorNoiseRepeatedFramesOf, AnyChunksAndThreadsGiveTheSameBits)
{
  const auto & stack = SmallStack<TypeParam>();
  const auto   expected = Measure(stack);
  const Shown  shown = WaysToRepeat(Frames)[1].second;
  const auto   repeated = Show(stack, shown);
  for (const std::size_t chunk : { 1, 2, 7 })
  {
    ExpectResultOfDistinct(Measure(repeated, WithDnSettings(), chunk, Threads(chunk)), expected, shown);
  }
}

TEST(SensorNoiseRepeatedFrames, AreNamedInOneWarning)
{
  Shown      shown;
  const auto twice = Measure(Doubled(shown));
  EXPECT_EQ(
    twice.GetReport().warnings.front().message,
    "24 of 48 frames are equal to an earlier one (frame 1 equals frame 0, frame 3 equals frame 2, ...; the first "
    "is 0): each is counted once, because a repetition has no new noise. Set the recorder to the frame rate of the "
    "camera");
  const auto last = Measure(Show(SmallStack<GreyValue>(), WaysToRepeat(Frames)[2].second));
  EXPECT_EQ(last.GetReport().warnings.front().message,
            "1 of 25 frames is equal to an earlier one (frame 24 equals frame 0; the first is 0): each is counted "
            "once, because "
            "a repetition has no new noise. Set the recorder to the frame rate of the camera");
  EXPECT_FALSE(HasWarning(Measure(SmallStack<GreyValue>()).GetReport(), WarningCode::RepeatedFrames));
}

TEST(SensorNoiseRepeatedFrames, ThatOneProcessReadsAreCountedOnceByAll)
{
  Shown      shown;
  const auto stack = Doubled(shown);
  const auto whole = Measure(stack);
  for (const std::size_t run : { 2, 16, 24 })
  {
    auto one = MethodOf(stack);
    auto two = MethodOf(stack);
    // In pass 1 one process reads all equal frames. Later any process may read them.
    RunPass(one, two, stack, [run](std::size_t t) { return t / run % 2 == 0; });
    RunPass(one, two, stack, [](std::size_t t) { return t % 2 == 0; });
    RunPass(one, two, stack, [](std::size_t t) { return t % 3 == 0; });
    EXPECT_EQ(ToJson(one.GetReport()), ToJson(whole.GetReport()));
    EXPECT_EQ(ToJson(two.GetReport()), ToJson(whole.GetReport()));
    EXPECT_TRUE(HaveSameBits(one.GetCorrectedVariance(), whole.GetCorrectedVariance()));
  }
}

TEST(SensorNoiseRepeatedFrames, ThatTwoProcessesCountedAreRefusedByNameAndChangeNothing)
{
  Shown      shown;
  const auto stack = Doubled(shown);
  auto       one = MethodOf(stack);
  auto       two = MethodOf(stack);
  AddPart(one, stack, 0, 2, [](std::size_t t, std::size_t) -> std::size_t { return t < 7 ? 0 : 1; });
  AddPart(two, stack, 1, 2, [](std::size_t t, std::size_t) -> std::size_t { return t < 7 ? 0 : 1; });
  const std::string before = SumsOf(one);
  try
  {
    MergeText(one, SumsOf(two));
    FAIL();
  }
  catch (const std::runtime_error & error)
  {
    EXPECT_NE(std::string(error.what()).find("frame 7 equals frame 6"), std::string::npos) << error.what();
  }
  EXPECT_EQ(SumsOf(one), before);
  EXPECT_THROW(MergeText(two, before), std::runtime_error);
}

TEST(SensorNoiseRepeatedFrames, OfSumsThatWereMergedBeforeAreNotCountedAgain)
{
  // The second process reads the later half, which has the same frames. The first process detects this.
  Shown shown(2 * Frames);
  for (std::size_t t = 0; t < shown.size(); ++t)
  {
    shown[t] = t % Frames;
  }
  const auto stack = Show(SmallStack<GreyValue>(), shown);
  auto       one = MethodOf(stack);
  auto       two = MethodOf(stack);
  two.SkipFrames(Frames);
  two.AddFrames(stack.Frame(Frames), Frames);
  MergeText(one, SumsOf(two));
  one.AddFrames(stack.Frame(0), Frames);
  one.EndPass();
  while (!one.IsDone())
  {
    one.AddFrames(stack.Frame(0), stack.frames);
    one.EndPass();
  }
  ExpectResultOfDistinct(one, Measure(SmallStack<GreyValue>()), shown);
}

TEST(SensorNoiseRepeatedFrames, ThatOneProcessLeavesToTheOtherAreCountedOnce)
{
  Shown      shown;
  const auto stack = Doubled(shown);
  const auto whole = Measure(stack);
  auto       one = MethodOf(stack);
  auto       two = MethodOf(stack);
  // Process one reads the frames of even numbers, process two the odd ones, each equal to the previous frame.
  std::vector<std::uint8_t> elsewhere(stack.frames);
  for (std::size_t t = 1; t < stack.frames; t += 2)
  {
    elsewhere[t] = 1;
  }
  two.SetCountedElsewhere(elsewhere);
  while (!one.IsDone())
  {
    RunPass(one, two, stack, [](std::size_t t) { return t % 2 == 0; });
  }
  EXPECT_EQ(ToJson(one.GetReport()), ToJson(whole.GetReport()));
  EXPECT_EQ(ToJson(two.GetReport()), ToJson(whole.GetReport()));
  EXPECT_TRUE(HaveSameBits(one.GetCorrectedVariance(), whole.GetCorrectedVariance()));
}

TEST(SensorNoiseRepeatedFrames, TooFewDistinctOnesAreRefused)
{
  for (const std::size_t distinct : { 1, 2, 4 })
  {
    Shown shown(40);
    for (std::size_t t = 0; t < shown.size(); ++t)
    {
      shown[t] = t % distinct;
    }
    const Report report = Measure(Show(SmallStack<GreyValue>(), shown)).GetReport();
    EXPECT_FALSE(report.IsUsable());
    EXPECT_EQ(report.frames, 40U);
    EXPECT_EQ(report.framesDistinct, distinct);
    EXPECT_TRUE(HasWarning(report, WarningCode::RepeatedFrames));
    EXPECT_EQ(report.warnings.back().code, WarningCode::NothingToMeasure);
    const std::string found =
      "only " + std::to_string(distinct) + (distinct == 1 ? " distinct frame is" : " distinct frames");
    EXPECT_NE(report.warnings.back().message.find(found), std::string::npos) << report.warnings.back().message;
    EXPECT_NE(report.warnings.back().message.find("expected at least 5"), std::string::npos);
  }
  // Five distinct frames are measured, as five frames without repetition.
  Shown shown{ 0, 1, 2, 3, 4, 0, 1, 2, 3, 4 };
  ExpectResultOfDistinct(Measure(Show(SmallStack<GreyValue>(), shown)),
                         Measure(Show(SmallStack<GreyValue>(), Shown{ 0, 1, 2, 3, 4 })),
                         shown);
}
