// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/ReportText.h"
#include "sensornoise/StackMethod.h"
#include "sensornoise/Report.h"
#include "helpers/MergeTestHelper.h"

#include <cmath>
#include <cstddef>
#include <gtest/gtest.h>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

using namespace sensornoise;
using namespace sensornoise::test;
using namespace sensornoise::test::merge;

namespace
{
using GreyValue = unsigned short;

/** Measures with several processes. Each reads a part of the frames and merges the sums of the others in another order.
 */
template <typename TPixel>
std::vector<std::unique_ptr<RefinedMethod<TPixel>>>
MeasureInParts(const Stack<TPixel> & stack, std::size_t count, Reader of)
{
  std::vector<std::unique_ptr<RefinedMethod<TPixel>>> processes;
  for (std::size_t i = 0; i < count; ++i)
  {
    processes.push_back(std::make_unique<RefinedMethod<TPixel>>(WithDnSettings(), GeometryOf(stack), stack.frames));
  }
  while (!processes[0]->IsDone())
  {
    std::vector<std::string> sums;
    for (std::size_t i = 0; i < count; ++i)
    {
      AddPart(*processes[i], stack, i, count, of);
      std::ostringstream out;
      processes[i]->SaveSums(out);
      sums.push_back(out.str());
    }
    for (std::size_t i = 0; i < count; ++i)
    {
      for (std::size_t k = 1; k < count; ++k)
      {
        std::istringstream in(sums[(i % 2 == 0 ? i + k : i + count - k) % count]);
        processes[i]->MergeSums(in);
      }
      processes[i]->EndPass();
    }
  }
  return processes;
}

template <typename TPixel>
void
ExpectSameBits(const RefinedMethod<TPixel> & a, const RefinedMethod<TPixel> & b)
{
  EXPECT_EQ(ToJson(a.GetReport()), ToJson(b.GetReport()));
  EXPECT_TRUE(HaveSameBits(a.GetMean(), b.GetMean()));
  EXPECT_TRUE(HaveSameBits(a.GetVariance(), b.GetVariance()));
  EXPECT_TRUE(HaveSameBits(a.GetCorrectedVariance(), b.GetCorrectedVariance()));
  EXPECT_TRUE(HaveSameBits(a.GetPixelUse(), b.GetPixelUse()));
}

template <typename TPixel>
void
ExpectNear(const Quantity & a, const Quantity & b, double relative)
{
  EXPECT_NEAR(ValueOf(a), ValueOf(b), relative * std::abs(ValueOf(b)));
  EXPECT_NEAR(*a.standardError, *b.standardError, 1e-6 * *b.standardError);
}
} // namespace

TEST(SensorNoiseRefinedMethodMerge, PartsOfIntegerFramesGiveTheWholesBits)
{
  const auto & stack = SmallStack<GreyValue>();
  const auto   whole = Measure(stack);
  ASSERT_EQ(whole.GetReport().gain.status, EstimateStatus::Identified);
  ASSERT_TRUE(whole.GetReport().noiseCorrelation); // every digit is compared
  for (const Reader reader : { InRuns, InTurn })
  {
    for (const std::size_t processes : { 2, 3 })
    {
      for (const auto & method : MeasureInParts(stack, processes, reader))
      {
        ExpectSameBits(*method, whole);
      }
    }
  }
}

TEST(SensorNoiseRefinedMethodMerge, PartsOfFloatingPointFramesAgreeWithTheWholeAndBitByBitAmongThemselves)
{
  const auto & stack = SmallStack<float>();
  const auto   wholeMethod = Measure(stack);
  const auto & whole = wholeMethod.GetReport();
  for (const Reader reader : { InRuns, InTurn })
  {
    for (const std::size_t processes : { 2, 3 })
    {
      const auto   methods = MeasureInParts(stack, processes, reader);
      const auto & report = methods[0]->GetReport();
      ExpectNear<float>(report.gain, whole.gain, 1e-7);
      ExpectNear<float>(report.offset, whole.offset, 1e-7);
      ExpectNear<float>(report.readNoise, whole.readNoise, 1e-7);
      ExpectNear<float>(report.intercept, whole.intercept, 1e-7);
      ExpectNear<float>(report.flickerSd, whole.flickerSd, 1e-7);
      ExpectNear<float>(report.vibrationSdX, whole.vibrationSdX, 1e-7);
      ExpectNear<float>(report.vibrationSdY, whole.vibrationSdY, 1e-7);
      EXPECT_TRUE(HaveSameBits(methods[0]->GetPixelUse(), wholeMethod.GetPixelUse()));
      // Means and temporal components, on which the next pass of all processes depends, must have the same bits.
      for (const auto & method : methods)
      {
        EXPECT_TRUE(HaveSameBits(method->GetMean(), methods[0]->GetMean()));
        EXPECT_EQ(method->GetReport().offset.value, report.offset.value);
      }
    }
  }
}

TEST(SensorNoiseRefinedMethodMerge, SavedSumsHoldTheMergedOnes)
{
  // A chain instead of an exchange of all with all: process 0 sends its sums to 1, and 1 sends both to 2.
  const auto & stack = SmallStack<float>();
  const auto   expected = MeasureInParts(stack, 3, InRuns);
  auto         method = MethodOf(stack);
  std::string  sums;
  for (std::size_t i = 0; i < 2; ++i)
  {
    auto link = MethodOf(stack);
    AddPart(link, stack, i, 3, InRuns);
    if (!sums.empty())
    {
      std::istringstream in(sums);
      link.MergeSums(in);
    }
    std::ostringstream out;
    link.SaveSums(out);
    sums = out.str();
  }
  std::istringstream in(sums);
  method.MergeSums(in);
  AddPart(method, stack, 2, 3, InRuns);
  method.EndPass();
  EXPECT_TRUE(HaveSameBits(method.GetMean(), expected[0]->GetMean()));
  EXPECT_TRUE(HaveSameBits(method.GetVariance(), expected[0]->GetVariance()));
}

TEST(SensorNoiseRefinedMethodMerge, SumsThatAreForgottenLeaveNothingAndFramesMayComeInAnyOrder)
{
  const auto & stack = SmallStack<GreyValue>();
  const auto   whole = Measure(stack);
  auto         method = MethodOf(stack);
  while (!method.IsDone())
  {
    method.AddFrames(stack.Frame(3), 7);
    method.ForgetSums();
    for (std::size_t t = Frames; t-- > 0;)
    {
      method.GoTo(t);
      method.AddFrames(stack.Frame(t), 1);
    }
    method.EndPass();
  }
  ExpectSameBits(method, whole);
}

TEST(SensorNoiseRefinedMethodMerge, FoldedPartsOfFloatingPointFramesAreThoseInOrder)
{
  // Two parts are merged in the order of their frames: folding changes no bit, and leaves one part to write.
  const auto &             stack = SmallStack<float>();
  const auto               expected = MeasureInParts(stack, 2, InRuns);
  std::vector<std::string> sums;
  std::vector<std::size_t> sizes;
  RefinedMethod<float>     method = MethodOf(stack);
  for (std::size_t i = 0; i < 2; ++i)
  {
    auto part = MethodOf(stack);
    AddPart(part, stack, i, 2, InRuns);
    std::stringstream out;
    part.SaveSums(out);
    method.MergeSums(out);
    method.FoldSums();
    std::ostringstream folded;
    method.SaveSums(folded);
    sizes.push_back(folded.str().size());
  }
  EXPECT_LT(sizes[1], sizes[0] + 16 * Width * Height); // another part would have 32 bytes per pixel
  method.EndPass();
  EXPECT_TRUE(HaveSameBits(method.GetMean(), expected[0]->GetMean()));
  EXPECT_TRUE(HaveSameBits(method.GetVariance(), expected[0]->GetVariance()));
}

TEST(SensorNoiseRefinedMethodMerge, ProcessWithoutFramesMayTakePart)
{
  const auto & stack = SmallStack<GreyValue>();
  const auto   whole = Measure(stack);
  auto         reader = MethodOf(stack);
  auto         idle = MethodOf(stack);
  while (!reader.IsDone())
  {
    reader.AddFrames(stack.Frame(0), Frames);
    for (auto * const from : { &idle, &reader }) // nothing is merged into the reader, everything into the idle process
    {
      std::stringstream sums;
      from->SaveSums(sums);
      (from == &idle ? reader : idle).MergeSums(sums);
    }
    reader.EndPass();
    idle.EndPass();
  }
  ExpectSameBits(reader, whole);
  ExpectSameBits(idle, whole);
}
