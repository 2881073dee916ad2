// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_test_LeftOutTestHelper_h
#define sensornoise_test_LeftOutTestHelper_h

#include "sensornoise/Report.h"
#include "sensornoise/ReportText.h"
#include "helpers/ReportTestHelper.h"
#include "helpers/StackTestHelper.h"
#include "moments/FrameThumbnails.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <gtest/gtest.h>
#include <map>
#include <vector>

/** \file
 * Stacks with frames that are unlike the others, and what is measured without these. */

namespace sensornoise::test
{

/** Returns the stack with frames that are to be left out, by their places in it. */
template <typename TPixel>
Stack<TPixel>
Insert(const Stack<TPixel> & stack, const std::map<std::size_t, std::vector<TPixel>> & unlike)
{
  Stack<TPixel> other{ stack.width, stack.height, stack.frames + unlike.size(), {} };
  std::size_t   next = 0;
  for (std::size_t t = 0; t < other.frames; ++t)
  {
    const auto place = unlike.find(t);
    if (place != unlike.end())
    {
      other.pixels.insert(other.pixels.end(), place->second.begin(), place->second.end());
      continue;
    }
    other.pixels.insert(other.pixels.end(), stack.Frame(next), stack.Frame(next) + stack.width * stack.height);
    ++next;
  }
  return other;
}

/** Returns a frame of the stack, left and right exchanged: the scene in the mirror. */
template <typename TPixel>
std::vector<TPixel>
Mirrored(const Stack<TPixel> & stack, std::size_t t)
{
  std::vector<TPixel> frame(stack.Frame(t), stack.Frame(t) + stack.width * stack.height);
  for (auto row = frame.begin(); row != frame.end(); row += static_cast<std::ptrdiff_t>(stack.width))
  {
    std::reverse(row, row + static_cast<std::ptrdiff_t>(stack.width));
  }
  return frame;
}

/** Returns a frame of the stack as a camera of \a factor times its gain, and of the same offset, would record it. */
template <typename TPixel>
std::vector<TPixel>
OfAnotherGain(const Stack<TPixel> & stack, std::size_t t, double factor, double offsetDn)
{
  std::vector<TPixel> frame(stack.Frame(t), stack.Frame(t) + stack.width * stack.height);
  for (TPixel & value : frame)
  {
    value = static_cast<TPixel>(std::lround(offsetDn + factor * (static_cast<double>(value) - offsetDn)));
  }
  return frame;
}

/** Returns a stack with zeros, one level and its own mirror image among its frames: places 0, 5 and the last one. */
template <typename TPixel>
Stack<TPixel>
WithUnlikeFrames(const Stack<TPixel> & stack)
{
  const std::size_t pixels = stack.width * stack.height;
  return Insert(stack,
                { { std::size_t{ 0 }, std::vector<TPixel>(pixels, TPixel{ 0 }) },
                  { std::size_t{ 5 }, std::vector<TPixel>(pixels, TPixel{ 4095 }) },
                  { stack.frames + 2, Mirrored(stack, 3) } });
}

/** Takes the values of the frames left out away, which are not known. */
template <typename TValue, typename TIsKnown>
void
RemoveLeftOut(std::vector<TValue> & series, const std::vector<LeftOutFrame> & leftOut, TIsKnown isKnown)
{
  std::vector<TValue> kept;
  for (std::size_t t = 0; t < series.size(); ++t)
  {
    const bool isOut =
      std::any_of(leftOut.begin(), leftOut.end(), [t](const LeftOutFrame & each) { return each.frame == t; });
    EXPECT_EQ(isKnown(series[t]), !isOut) << t;
    if (!isOut)
    {
      kept.push_back(series[t]);
    }
  }
  series = kept;
}

/** Expects that \a report, of a stack with unlike frames, is \a expected, of the stack without them, but for what it
 * says of them. */
inline void
ExpectReportOfOthers(Report report, const Report & expected)
{
  ASSERT_FALSE(report.framesLeftOut.empty()) << ToJson(report);
  EXPECT_EQ(report.frames, expected.frames + report.framesLeftOut.size());
  EXPECT_EQ(report.framesDistinct, expected.framesDistinct);
  ASSERT_FALSE(report.warnings.empty());
  EXPECT_EQ(report.warnings.front().code, WarningCode::FramesLeftOut);
  report.warnings.erase(report.warnings.begin());
  report.frames = expected.frames;
  RemoveLeftOut(report.flicker, report.framesLeftOut, [](double gamma) { return std::isfinite(gamma); });
  RemoveLeftOut(
    report.motion, report.framesLeftOut, [](const auto & shift) { return std::isfinite(shift[0] + shift[1]); });
  report.framesLeftOut.clear();
  EXPECT_EQ(ToJson(report), ToJson(expected));
}

/** Expects equal results of a method, RefinedMethod or PublishedMethod. */
template <typename TMethod>
void
ExpectResultOfOthers(const TMethod & method, const TMethod & expected)
{
  ExpectReportOfOthers(method.GetReport(), expected.GetReport());
  EXPECT_TRUE(HaveSameBits(method.GetMean(), expected.GetMean()));
  EXPECT_TRUE(HaveSameBits(method.GetVariance(), expected.GetVariance()));
  EXPECT_TRUE(HaveSameBits(method.GetCorrectedVariance(), expected.GetCorrectedVariance()));
  EXPECT_EQ(method.GetPixelUse(), expected.GetPixelUse());
}

} // namespace sensornoise::test

#endif
