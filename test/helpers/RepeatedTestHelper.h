// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_test_RepeatedTestHelper_h
#define sensornoise_test_RepeatedTestHelper_h

#include "sensornoise/Report.h"
#include "sensornoise/ReportText.h"
#include "helpers/StackTestHelper.h"

#include <algorithm>
#include <cstddef>
#include <gtest/gtest.h>
#include <string>
#include <utility>
#include <vector>

/** \file
 * Stacks in which frames are equal. */

namespace sensornoise::test
{

/** The frames that a stack shows, by their numbers in another. */
using Shown = std::vector<std::size_t>;

template <typename TPixel>
Stack<TPixel>
Show(const Stack<TPixel> & stack, const Shown & shown)
{
  Stack<TPixel> other{ stack.width, stack.height, shown.size(), {} };
  for (const std::size_t t : shown)
  {
    other.pixels.insert(other.pixels.end(), stack.Frame(t), stack.Frame(t) + stack.width * stack.height);
  }
  return other;
}

/** Returns three ways: each of \a distinct frames twice, each third frame twice, and the first frame once more at the
 * end. */
inline std::vector<std::pair<std::string, Shown>>
WaysToRepeat(std::size_t distinct)
{
  std::vector<std::pair<std::string, Shown>> ways{ { "each twice", {} },
                                                   { "each third repeated", {} },
                                                   { "last equals first", {} } };
  for (std::size_t t = 0; t < distinct; ++t)
  {
    for (std::size_t way = 0; way < 3; ++way)
    {
      const bool isRepeated = way == 0 || (way == 1 && t % 3 == 2);
      ways[way].second.insert(ways[way].second.end(), isRepeated ? 2 : 1, t);
    }
  }
  ways[2].second.push_back(0);
  return ways;
}

/** Returns the values of the first \a distinct frames, if equal frames have equal values. */
template <typename TValue>
std::vector<TValue>
OfDistinct(const std::vector<TValue> & values, const Shown & shown, std::size_t distinct)
{
  std::vector<TValue> found;
  for (std::size_t t = 0; t < values.size(); ++t)
  {
    const auto first = static_cast<std::size_t>(std::find(shown.begin(), shown.end(), shown[t]) - shown.begin());
    EXPECT_EQ(values[t], values[first]) << t;
    if (first == t)
    {
      found.push_back(values[t]);
    }
  }
  EXPECT_TRUE(values.empty() || found.size() == distinct);
  return found;
}

/** Expects that \a report, of a stack that shows frames more than once, is \a expected, of these frames alone, but for
 * what it says of all frames. */
inline void
ExpectReportOfDistinct(Report report, const Report & expected, const Shown & shown)
{
  EXPECT_EQ(report.frames, shown.size());
  EXPECT_EQ(report.framesDistinct, expected.frames);
  EXPECT_EQ(report.flicker.size(), expected.flicker.empty() ? 0 : shown.size());
  EXPECT_EQ(report.motion.size(), expected.motion.empty() ? 0 : shown.size());
  ASSERT_FALSE(report.warnings.empty());
  EXPECT_EQ(report.warnings.front().code, WarningCode::RepeatedFrames);
  report.warnings.erase(report.warnings.begin());
  report.frames = expected.frames;
  report.flicker = OfDistinct(report.flicker, shown, expected.frames);
  report.flickerRows = OfDistinct(report.flickerRows, shown, expected.frames);
  report.motion = OfDistinct(report.motion, shown, expected.frames);
  EXPECT_EQ(ToJson(report), ToJson(expected));
}

/** Expects equal results of a method, RefinedMethod or PublishedMethod. */
template <typename TMethod>
void
ExpectResultOfDistinct(const TMethod & method, const TMethod & distinct, const Shown & shown)
{
  ExpectReportOfDistinct(method.GetReport(), distinct.GetReport(), shown);
  EXPECT_TRUE(HaveSameBits(method.GetMean(), distinct.GetMean()));
  EXPECT_TRUE(HaveSameBits(method.GetVariance(), distinct.GetVariance()));
  EXPECT_TRUE(HaveSameBits(method.GetCorrectedVariance(), distinct.GetCorrectedVariance()));
  EXPECT_TRUE(HaveSameBits(method.GetPixelUse(), distinct.GetPixelUse()));
}

} // namespace sensornoise::test

#endif
