// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkSensorNoiseSums.h"
#include "helpers/SensorNoiseEstimatorTestHelper.h"

#include "sensornoise/ReportText.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <string>
#include <vector>

// Several processes exchange the sums of the estimator.

using namespace sensornoisetest;
using namespace sensornoisetest::estimator;

namespace
{
template <typename TStack>
using Sums = itk::SensorNoiseSums<TStack>;

/** Returns the size of a stack, without pixels. */
template <typename TStack>
typename TStack::Pointer
SizeOf(const TStack * stack)
{
  auto size = TStack::New();
  size->SetRegions(stack->GetLargestPossibleRegion());
  return size;
}

/** Frames first ... first + count - 1, in memory. */
template <typename TStack>
typename TStack::Pointer
FramesOf(const TStack * stack, itk::SizeValueType first, itk::SizeValueType count)
{
  auto region = stack->GetLargestPossibleRegion();
  region.SetSize(2, count);
  auto frames = TStack::New();
  frames->SetRegions(region);
  frames->Allocate();
  const auto   pixels = region.GetSize(0) * region.GetSize(1);
  const auto * from = stack->GetBufferPointer() + first * pixels;
  std::copy(from, from + count * pixels, frames->GetBufferPointer());
  return frames;
}

template <typename TStack>
struct Process
{
  typename TStack::Pointer                            size;
  typename itk::SensorNoiseEstimator<TStack>::Pointer estimator;
  typename Sums<TStack>::Pointer                      sums;

  explicit Process(const TStack * stack, const std::string & method = "refined", const std::string & pattern = "none")
    : size(SizeOf(stack))
    , estimator(EstimatorOf<TStack>(size.GetPointer(), method))
    , sums(Sums<TStack>::New())
  {
    estimator->SetBayerPattern(pattern);
    sums->Start(estimator, "");
  }
};

/** Runs two processes that read frames in turn, three at a time, the second backwards. */
template <typename TStack>
void
RunTwo(Process<TStack> & one, Process<TStack> & two, const TStack * stack)
{
  const auto all = stack->GetLargestPossibleRegion().GetSize(2);
  while (!one.sums->IsDone())
  {
    std::vector<itk::SizeValueType> firsts;
    for (itk::SizeValueType first = 0; first < all; first += 3)
    {
      firsts.push_back(first);
    }
    for (std::size_t i = 0; i < firsts.size(); i += 2)
    {
      one.sums->AddFrames(FramesOf(stack, firsts[i], std::min<itk::SizeValueType>(3, all - firsts[i])), firsts[i]);
    }
    std::reverse(firsts.begin(), firsts.end());
    for (const auto first : firsts)
    {
      if (first / 3 % 2 == 1)
      {
        two.sums->AddFrames(FramesOf(stack, first, std::min<itk::SizeValueType>(3, all - first)), first);
      }
    }
    const auto ofOne = one.sums->GetSums();
    EXPECT_TRUE(one.sums->MergeSums(two.sums->GetSums()));
    EXPECT_FALSE(one.sums->MergeSums(two.sums->GetSums())); // handed over twice
    EXPECT_TRUE(two.sums->MergeSums(ofOne));
    one.sums->EndPass();
    two.sums->EndPass();
  }
}
} // namespace

template <typename TPixel>
class SensorNoiseSumsOf : public ::testing::Test
{};
using IntegerTypes = ::testing::Types<unsigned char, unsigned short, short>;
TYPED_TEST_SUITE(SensorNoiseSumsOf, IntegerTypes);

TYPED_TEST(SensorNoiseSumsOf, TwoProcessesHaveTheBitsOfOne)
{
  using Stack = itk::Image<TypeParam, 3>;
  const auto stack = TargetStack<Stack>(Width, Height, Frames);
  for (const std::string method : { "refined", "published" })
  {
    const auto whole = EstimatorOf<Stack>(stack, method);
    whole->Update();
    Process<Stack> one(stack, method);
    Process<Stack> two(stack, method);
    RunTwo<Stack>(one, two, stack);
    for (const auto & process : { one, two })
    {
      EXPECT_EQ(sensornoise::ToJson(process.estimator->GetReport()), sensornoise::ToJson(whole->GetReport()));
      ExpectTheSameMaps(process.estimator, whole);
    }
    EXPECT_EQ(one.estimator->GetReportAsHtml(), whole->GetReportAsHtml());
  }
}

TEST(SensorNoiseSums, OfAMosaicHaveTheBitsOfOneProcess)
{
  const auto stack = SimulatedStack();
  const auto whole = EstimatorOf<StackType>(stack);
  whole->SetBayerPattern("GRBG");
  whole->Update();
  Process<StackType> one(stack, "refined", "GRBG");
  Process<StackType> two(stack, "refined", "GRBG");
  EXPECT_EQ(one.sums->GetNumberOfPlanes(), 4u);
  RunTwo<StackType>(one, two, stack);
  EXPECT_EQ(one.estimator->GetReportAsJson(), whole->GetReportAsJson());
  ExpectTheSameMaps(two.estimator, whole);
}

TEST(SensorNoiseSums, PatternByTheLevelsOfTheFirstFrame)
{
  const auto stack = SimulatedStack();
  const auto size = SizeOf<StackType>(stack);
  EXPECT_EQ(Sums<StackType>::RecogniseBayerPattern(stack), "none");
  const auto estimator = EstimatorOf<StackType>(size);
  estimator->SetBayerPattern("auto");
  const auto sums = Sums<StackType>::New();
  EXPECT_THROW(sums->Start(estimator), itk::ExceptionObject);
  sums->Start(estimator, "RGGB");
  while (!sums->IsDone())
  {
    sums->AddFrames(stack, 0);
    sums->EndPass();
  }
  EXPECT_NE(estimator->GetReportAsJson().find("\"levels\""), std::string::npos);
}

TEST(SensorNoiseSums, EqualFramesOfTwoProcessesAreCountedOnce)
{
  const auto stack = FramesOf<StackType>(SimulatedStack(), 0, Frames);
  const auto pixels = Width * Height;
  std::copy_n(stack->GetBufferPointer() + 4 * pixels, pixels, stack->GetBufferPointer() + 20 * pixels);
  const auto whole = EstimatorOf<StackType>(stack);
  whole->Update();
  Process<StackType> one(stack);
  Process<StackType> two(stack);
  one.sums->AddFrames(FramesOf<StackType>(stack, 0, 10), 0);
  two.sums->AddFrames(FramesOf<StackType>(stack, 10, Frames - 10), 10);
  EXPECT_THROW(one.sums->MergeSums(two.sums->GetSums()), itk::ExceptionObject);

  const auto ofOne = one.sums->GetFingerprints(); // fingerprints of frames 0 ... 9
  const auto ofTwo = two.sums->GetFingerprints(); // fingerprints of frames 10 ... 24
  EXPECT_TRUE(std::equal(
    ofOne->GetBufferPointer() + 4 * 16, ofOne->GetBufferPointer() + 5 * 16, ofTwo->GetBufferPointer() + 160));
  EXPECT_FALSE(std::equal(
    ofOne->GetBufferPointer() + 3 * 16, ofOne->GetBufferPointer() + 4 * 16, ofTwo->GetBufferPointer() + 160));

  auto flags = Sums<StackType>::BytesType::New();
  flags->SetRegions(Sums<StackType>::BytesType::SizeType{ { Frames, 1 } });
  flags->Allocate(true);
  flags->SetPixel({ { 20, 0 } }, 1);
  two.sums->ForgetSums();
  two.sums->SetCountedElsewhere(flags);
  two.sums->AddFrames(FramesOf<StackType>(stack, 10, Frames - 10), 10);
  EXPECT_TRUE(one.sums->MergeSums(two.sums->GetSums()));
  one.sums->EndPass();
  while (!one.sums->IsDone())
  {
    one.sums->AddFrames(stack, 0);
    one.sums->EndPass();
  }
  EXPECT_EQ(sensornoise::ToJson(one.estimator->GetReport()), sensornoise::ToJson(whole->GetReport()));
}

TEST(SensorNoiseSums, WhatDoesNotFitIsRefusedAndChangesNothing)
{
  const auto         stack = SimulatedStack();
  Process<StackType> one(stack);
  Process<StackType> two(stack);
  one.sums->AddFrames(FramesOf<StackType>(stack, 0, 10), 0);
  const auto before = one.sums->GetSums();
  EXPECT_THROW(one.sums->AddFrames(FramesOf<StackType>(stack, 0, 5), 8), itk::ExceptionObject); // 8 and 9 are in
  EXPECT_THROW(one.sums->AddFrames(FramesOf<StackType>(stack, 0, 5), 21), itk::ExceptionObject);
  const auto withoutPixels = SizeOf<StackType>(stack);
  EXPECT_SAYS(ErrorWhen([&] { two.sums->AddFrames(withoutPixels, 0); }),
              "the image of frames has a size but no pixels");
  EXPECT_SAYS(ErrorWhen([&] { Sums<StackType>::RecogniseBayerPattern(withoutPixels); }), "the image has no pixels");
  EXPECT_THROW(one.sums->EndPass(), itk::ExceptionObject);
  two.sums->AddFrames(FramesOf<StackType>(stack, 9, 16), 9);
  EXPECT_THROW(one.sums->MergeSums(two.sums->GetSums()), itk::ExceptionObject); // both hold frame 9
  const auto after = one.sums->GetSums();
  EXPECT_TRUE(HaveTheSameBits(after.GetPointer(), before.GetPointer()));
  EXPECT_THROW(Sums<StackType>::New()->EndPass(), itk::ExceptionObject);
  EXPECT_THROW(Sums<StackType>::New()->Start(nullptr), itk::ExceptionObject);
}
