// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkSensorNoiseEstimator.h"
#include "base/FreeMemory.h"
#include "pixels/ProjectionSums.h"
#include "refined/PixelProjections.h"
#include "helpers/PipelineTestHelper.h"
#include "helpers/SensorNoiseEstimatorTestHelper.h"

#include <gtest/gtest.h>
#include <string>
#include <vector>

namespace
{
using namespace sensornoisetest;
using namespace sensornoisetest::estimator;

constexpr unsigned int LargeWidth = 1100;
constexpr unsigned int LargeHeight = 1000;
constexpr unsigned int FewFrames = 14;
constexpr std::size_t  LargePixels = std::size_t{ LargeWidth } * LargeHeight;
static_assert(LargePixels > 2 * sensornoise::ProjectionSums::SlabPixels, "the frames have three slabs");
} // namespace

TEST(SensorNoiseEstimatorMemory, ALimitReadsTheStackMoreOftenAndChangesNoBit)
{
  // Whole numbers whose sums need 8 bytes: the sums of integer pixels fit within the least memory.
  using FloatStack = itk::Image<float, 3>;
  const auto reader = StackReader<FloatStack>::Of(TargetStack<FloatStack>(LargeWidth, LargeHeight, FewFrames));
  const auto limited = EstimatorOf<FloatStack>(reader->GetOutput());
  limited->SetNumberOfStreamDivisions(2);
  limited->SetMemoryLimit(static_cast<itk::SizeValueType>(sensornoise::MemoryNeed{ LargePixels, FewFrames }.Least()) +
                          1);
  float progress = 0.0F;
  bool  hasGrown = true;
  limited->AddObserver(itk::ProgressEvent(), [&](const itk::EventObject &) {
    hasGrown = hasGrown && limited->GetProgress() >= progress && limited->GetProgress() <= 1.0F;
    progress = limited->GetProgress();
  });
  const std::string json = JsonOf(limited);
  EXPECT_GT(reader->Reads(), 3U * 2U);
  EXPECT_EQ(reader->Reads() % 2, 0U);
  const auto expected = EstimatorOf<FloatStack>(reader->GetOutput());
  EXPECT_EQ(JsonOf(expected), json);
  ExpectTheSameMaps(limited, expected);
  EXPECT_TRUE(hasGrown);
}

TEST(SensorNoiseEstimatorMemory, ALimitBelowTheNeedIsRefused)
{
  const auto estimator = EstimatorOf<StackType>(SimulatedStack());
  estimator->SetMemoryLimit(1000);
  EXPECT_SAYS(ErrorOf(estimator), "the memory limit is 0.001 MB; expected at least ");
  EXPECT_SAYS(ErrorOf(estimator), " for frames of 65 x 63 pixels");
  const sensornoise::MemoryNeed ofPlane{ 32 * 31, Frames };
  estimator->SetBayerPattern("RGGB");
  EXPECT_SAYS(ErrorOf(estimator),
              "the memory limit is 0.001 MB; expected at least " + sensornoise::TextOfBytes(4.0 * ofPlane.Least()) +
                " for 4 planes of 32 x 31 pixels");
  estimator->SetBayerPattern("none");
  estimator->SetMethod("published");
  EXPECT_SAYS(ErrorOf(estimator), "the memory limit is 0.001 MB; expected at least 0.164 MB for the method published");
  estimator->SetMemoryLimit(0);
  EXPECT_EQ(ErrorOf(estimator), "no error");
}

TEST(SensorNoiseEstimatorMemory, MapsOutliveTheEstimator)
{
  auto       estimator = EstimatorOf<StackType>(SimulatedStack());
  const auto expected = EstimatorOf<StackType>(SimulatedStack());
  expected->Update();
  estimator->Update();
  const auto                               mean = FrameType::Pointer(estimator->GetMean());
  const FrameType::PixelContainer::Pointer before = mean->GetPixelContainer();
  const std::vector<double>                values = PixelsOf(mean.GetPointer());
  estimator->Modified();
  estimator->Update(); // the maps of another run have their own memory
  EXPECT_NE(mean->GetPixelContainer(), before.GetPointer());
  estimator = nullptr;
  EXPECT_TRUE(HaveTheSameBits(mean.GetPointer(), expected->GetMean()));
  EXPECT_TRUE(HaveTheSameBits(
    std::vector<double>(before->GetBufferPointer(), before->GetBufferPointer() + before->Size()), values));
}
