// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/StackMethod.h"

#include "sensornoise/ReportText.h"
#include "helpers/MergeTestHelper.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <gtest/gtest.h>
#include <set>
#include <sstream>
#include <utility>
#include <vector>

/** \file
 * Tests of the exchange between processes through the public interface: fingerprints and sums. */

using namespace sensornoise;
using namespace sensornoise::test;
using namespace sensornoise::test::merge;

namespace
{
using GreyValue = unsigned short;

constexpr std::size_t Half = Frames / 2;

/** Adds a half of the frames in process \a k, the last frame first. */
void
AddHalf(RefinedMethod<GreyValue> & method, const Stack<GreyValue> & stack, std::size_t k)
{
  for (std::size_t t = (k + 1) * Half; t-- > k * Half;)
  {
    method.GoTo(t);
    method.AddFrames(stack.Frame(t), 1);
  }
}
} // namespace

TEST(SensorNoiseStackMethod, ProcessesLeaveEqualFramesToEachOther)
{
  Stack<GreyValue> stack = SmallStack<GreyValue>();
  std::copy_n(stack.Frame(3), Width * Height, stack.pixels.begin() + (Half + 5) * Width * Height);
  const auto               whole = Measure(stack);
  RefinedMethod<GreyValue> made = MethodOf(stack);
  RefinedMethod<GreyValue> one = std::move(made);
  RefinedMethod<GreyValue> two = MethodOf(stack);
  AddHalf(one, stack, 0);
  AddHalf(two, stack, 1);
  std::set<StackMethod<GreyValue>::FrameFingerprint> known;
  for (const auto & frame : one.GetFingerprints())
  {
    known.insert(frame.second);
  }
  EXPECT_EQ(known.size(), Half);
  std::vector<std::uint8_t> areCountedElsewhere(Frames, 0);
  for (const auto & [t, fingerprint] : two.GetFingerprints())
  {
    areCountedElsewhere.at(t) = known.count(fingerprint) != 0 ? 1 : 0;
  }
  EXPECT_EQ(std::count(areCountedElsewhere.begin(), areCountedElsewhere.end(), 1), 1);
  EXPECT_EQ(areCountedElsewhere[Half + 5], 1);
  two.ForgetSums();
  EXPECT_EQ(std::count(two.GetHas().begin(), two.GetHas().end(), 1), 0);
  two.SetCountedElsewhere(areCountedElsewhere);
  AddHalf(two, stack, 1);
  for (;;)
  {
    std::stringstream sums[2];
    one.SaveSums(sums[0]);
    two.SaveSums(sums[1]);
    one.MergeSums(sums[1]);
    two.MergeSums(sums[0]);
    one.FoldSums();
    one.EndPass();
    two.EndPass();
    if (one.IsDone())
    {
      break;
    }
    AddHalf(one, stack, 0);
    AddHalf(two, stack, 1);
  }
  EXPECT_EQ(ToJson(one.GetReport()), ToJson(whole.GetReport()));
  EXPECT_EQ(ToJson(two.GetReport()), ToJson(whole.GetReport()));
  EXPECT_EQ(one.TakeMean(), whole.GetMean());
  EXPECT_EQ(one.TakePixelUse(), whole.GetPixelUse());
}
