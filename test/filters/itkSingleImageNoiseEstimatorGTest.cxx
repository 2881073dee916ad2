// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkSingleImageNoiseEstimator.h"

#include "sensornoise/ReportText.h"
#include "helpers/PipelineTestHelper.h"
#include "helpers/SingleImageTestHelper.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <gtest/gtest.h>
#include <string>
#include <variant>
#include <vector>

namespace
{
using namespace sensornoisetest;
using namespace sensornoise;
using StackType = itk::Image<unsigned short, 3>;
using EstimatorType = itk::SingleImageNoiseEstimator<StackType>;

constexpr std::size_t Width = 220;
constexpr std::size_t Height = 200;
constexpr std::size_t Frames = 3;

const test::Stack<unsigned short> &
Simulated()
{
  static const auto stack = test::Simulate<unsigned short>(test::single::PaperSettings('B', Frames), Width, Height);
  return stack;
}

/** Returns the frames, the first one at index (-2, 5, 7). */
StackType::Pointer
StackOf(const test::Stack<unsigned short> & frames)
{
  auto image = StackType::New();
  image->SetRegions(StackType::RegionType({ { -2, 5, 7 } }, { { frames.width, frames.height, frames.frames } }));
  image->Allocate();
  std::copy(frames.pixels.begin(), frames.pixels.end(), image->GetBufferPointer());
  return image;
}

EstimatorType::Pointer
EstimatorOf(const StackType * stack)
{
  auto estimator = EstimatorType::New();
  estimator->SetInput(stack);
  return estimator;
}
} // namespace

TEST(SingleImageNoiseEstimator, HasTheBitsOfTheMethod)
{
  const auto estimator = EstimatorOf(StackOf(Simulated()));
  EXPECT_EQ(ErrorOf(estimator), "no error");
  EXPECT_FALSE(estimator->HasChannelReports());
  EXPECT_EQ(estimator->GetReportAsJson(), ToJson(test::single::Measure(Simulated())));
  EXPECT_SAYS(estimator->GetReportAsText(), "single-image");
}

TEST(SingleImageNoiseEstimator, AnyChunksAndThreadsGiveTheSameBits)
{
  const auto one = EstimatorOf(StackOf(Simulated()));
  one->SetNumberOfStreamDivisions(1);
  one->SetNumberOfWorkUnits(1);
  one->Update();
  const auto many = EstimatorOf(StackOf(Simulated()));
  many->SetNumberOfStreamDivisions(Frames);
  many->SetNumberOfWorkUnits(5);
  many->Update();
  EXPECT_EQ(many->GetReportAsJson(), one->GetReportAsJson());
}

TEST(SingleImageNoiseEstimator, MaskAndSettingsReachTheMethod)
{
  const auto estimator = EstimatorOf(StackOf(Simulated()));
  auto       mask = MaskType::New();
  mask->SetRegions(MaskType::RegionType({ { -2, 5 } }, { { Width, Height } }));
  mask->Allocate();
  std::vector<std::uint8_t> pixels(Width * Height, 1);
  std::fill(pixels.begin(), pixels.begin() + Width * 60, std::uint8_t{ 0 });
  std::copy(pixels.begin(), pixels.end(), mask->GetBufferPointer());
  estimator->SetMask(mask);
  estimator->SetClipHigh(3000.0);
  estimator->SetExcessNoiseFactor(2.0);
  EXPECT_EQ(ErrorOf(estimator), "no error");
  SingleImageSettings settings;
  settings.dnSettings.clipHighDn = 3000.0;
  settings.excessNoiseFactor = 2.0;
  EXPECT_EQ(estimator->GetReportAsJson(), ToJson(test::single::MeasureAll(Simulated(), settings, 1, pixels).front()));
}

TEST(SingleImageNoiseEstimator, AMosaicHasTheReportsOfItsPlanes)
{
  const auto estimator = EstimatorOf(StackOf(Simulated()));
  estimator->SetBayerPattern("GBRG");
  estimator->Update();
  ASSERT_TRUE(estimator->HasChannelReports());
  SingleImageSettings settings;
  settings.bayerPattern = BayerPattern::GBRG;
  const auto   planes = test::single::MeasureAll(Simulated(), settings);
  const auto & channels = std::get<ChannelReports>(estimator->GetResult()).channels;
  for (std::size_t k = 0; k < planes.size(); ++k)
  {
    EXPECT_EQ(channels[k].gain.value, planes[k].gain.value);
  }
}

TEST(SingleImageNoiseEstimator, WrongInputIsAnError)
{
  EXPECT_SAYS(ErrorOf(EstimatorType::New()), "Input");
  const auto estimator = EstimatorOf(StackOf(Simulated()));
  estimator->SetBayerPattern("RGBG");
  EXPECT_SAYS(ErrorOf(estimator), "RGBG");
  estimator->SetBayerPattern("none");
  EXPECT_EQ(ErrorOf(estimator), "no error");
}
