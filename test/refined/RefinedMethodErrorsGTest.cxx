// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/StackMethod.h"
#include "helpers/MergeTestHelper.h"

#include <cstddef>
#include <cstdint>
#include <gtest/gtest.h>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

using namespace sensornoise;
using namespace sensornoise::test;
using namespace sensornoise::test::merge;

namespace
{
using GreyValue = unsigned short;

/** Runs \a function and returns the message of its exception. */
template <typename TError, typename TFunction>
std::string
MessageOf(TFunction function)
{
  try
  {
    function();
  }
  catch (const TError & error)
  {
    return error.what();
  }
  return "nothing was thrown";
}

} // namespace

TEST(SensorNoiseRefinedMethodErrors, SumsThatDoNotFitAreRefusedAndChangeNothing)
{
  const auto & stack = SmallStack<GreyValue>();
  const auto   save = [](const auto & method) {
    std::ostringstream out;
    method.SaveSums(out);
    return out.str();
  };
  auto method = MethodOf(stack);
  AddPart(method, stack, 0, 2, InRuns);
  const std::string before = save(method);
  const auto        complaint = [&](const std::string & sums) {
    return MessageOf<std::runtime_error>([&] {
      std::istringstream in(sums);
      method.MergeSums(in);
    });
  };
  const auto has = [](const std::string & text, const std::string & part) { return text.find(part) != text.npos; };

  EXPECT_TRUE(has(complaint(before), "frame 0")); // its own frame
  auto other = MethodOf(stack);
  AddPart(other, stack, 1, 2, InRuns);
  const std::string good = save(other);
  for (const std::size_t size : { std::size_t{ 0 }, std::size_t{ 20 }, std::size_t{ 60 }, good.size() - 1 })
  {
    EXPECT_TRUE(has(complaint(good.substr(0, size)), "ends early")) << size;
  }
  EXPECT_TRUE(has(complaint("some text, which is long enough to be a header of sums"), "expected \"RefinedMethod"));
  EXPECT_TRUE(has(complaint(save(MethodOf(SmallStack<float>()))), "found \"RefinedMethod float\""));
  EXPECT_TRUE(has(complaint(save(RefinedMethod<GreyValue>({}, { Width, Height + 1, 1 }, Frames))), "pixels"));
  EXPECT_TRUE(has(complaint(save(RefinedMethod<GreyValue>({}, { Height, Width, 1 }, Frames))), "other settings"));
  EXPECT_TRUE(has(complaint(save(RefinedMethod<GreyValue>({}, { Width, Height, 1 }, Frames + 1))), "25 frames"));
  const std::vector<std::uint8_t> mask(Width * Height, 1);
  EXPECT_TRUE(has(complaint(save(RefinedMethod<GreyValue>({}, { Width, Height, 1 }, Frames, mask))), "another mask"));
  auto second = MethodOf(stack);
  second.AddFrames(stack.Frame(0), Frames);
  second.EndPass();
  EXPECT_TRUE(has(complaint(save(second)), "pass"));
  EXPECT_EQ(save(method), before);

  std::istringstream in(good);
  method.MergeSums(in);
  EXPECT_NO_THROW(method.EndPass());
}

TEST(SensorNoiseRefinedMethodErrors, SumsOfOtherPassesBeforeAreRefused)
{
  const auto & stack = SmallStack<GreyValue>();
  const auto   brighter = stack.Map([](GreyValue u) { return u + 1; });
  auto         method = MethodOf(stack);
  auto         other = MethodOf(stack);
  method.AddFrames(stack.Frame(0), Frames);
  other.AddFrames(brighter.Frame(0), Frames);
  for (const auto * const process : { &method, &other }) // the sums of the first pass are not kept for the second
  {
    std::ostringstream ofFirstPass;
    process->SaveSums(ofFirstPass);
  }
  method.EndPass();
  other.EndPass();
  std::stringstream sums;
  other.SaveSums(sums);
  EXPECT_THROW(method.MergeSums(sums), std::runtime_error);
}

TEST(SensorNoiseRefinedMethodErrors, MissingAndRepeatedFramesAreRefused)
{
  const auto & stack = SmallStack<GreyValue>();
  auto         method = MethodOf(stack);
  AddPart(method, stack, 0, 2, InRuns);
  EXPECT_THROW(method.SkipFrames(1), std::logic_error);
  EXPECT_THROW(method.EndPass(), std::logic_error);
  auto other = MethodOf(stack);
  AddPart(other, stack, 1, 2, InRuns);
  std::stringstream sums;
  method.SaveSums(sums);
  other.MergeSums(sums);
  EXPECT_NO_THROW(other.EndPass());
  other.AddFrames(stack.Frame(0), 1);
  EXPECT_THROW(other.AddFrames(stack.Frame(0), Frames), std::logic_error);

  auto late = MethodOf(stack); // frame 0 is merged with the sums, and then read
  sums.clear();
  sums.seekg(0);
  late.MergeSums(sums);
  EXPECT_THROW(late.AddFrames(stack.Frame(0), 1), std::logic_error);
}
