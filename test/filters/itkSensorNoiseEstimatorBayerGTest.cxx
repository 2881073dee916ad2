// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/ReportText.h"
#include "sensornoise/Simulator.h"
#include "itkBayerPlaneImageFilter.h"
#include "itkImage.h"
#include "itkCastImageFilter.h"
#include "itkSensorNoiseEstimator.h"
#include "itkSensorNoiseMetaData.h"
#include "helpers/PipelineTestHelper.h"
#include "helpers/SensorNoiseEstimatorTestHelper.h"

#include <gtest/gtest.h>
#include <string>

/** \file
 * A stack behind a Bayer mosaic through the filter. */

namespace
{
using namespace sensornoisetest;
using namespace sensornoisetest::estimator;
using sensornoise::BayerPlane;
using sensornoise::BayerPlanes;
using sensornoise::WarningCode;
using BayerFilter = itk::BayerPlaneImageFilter<StackType>;

constexpr unsigned int Side = 96;

StackType::Pointer
MakeMosaicStack(bool isDark = false, unsigned int frames = 24, std::size_t side = Side)
{
  sensornoise::SimulationSettings settings;
  settings.conditions = { 0.05, 0.05, 0.02 };
  settings.frames = frames;
  settings.isDark = isDark;
  settings.flaws.filters = { sensornoise::BayerPattern::GRBG, 0.6, 1.0, 0.4 };
  const sensornoise::StackSimulator simulator(sensornoise::MakeTargetScene(side, side), side, side, settings);
  const auto                        stack = StackType::New();
  stack->SetRegions(StackType::SizeType{ { side, side, frames } });
  stack->Allocate();
  for (std::size_t t = 0; t < frames; ++t)
  {
    simulator.RenderFrame(t, stack->GetBufferPointer() + t * side * side);
  }
  return stack;
}

StackType::Pointer
MosaicStack()
{
  static const StackType::Pointer stack = MakeMosaicStack();
  return stack;
}

StackType::Pointer
PlaneOf(const StackType * stack, BayerPlane plane)
{
  const auto filter = BayerFilter::New();
  filter->SetInput(stack);
  filter->SetPattern("GRBG");
  filter->SetPlane(NameOf(plane));
  filter->Update();
  return filter->GetOutput();
}

/** Returns the record without the members of the channel and of the digital numbers, which are common to all channels.
 */
std::string
Numbers(sensornoise::Report report)
{
  report.settings.clear();
  report.channel = "mono";
  report.bitDepth.reset();
  for (auto * const quantity : { &report.vibrationSdX, &report.vibrationSdY, &report.vibrationCovariance })
  {
    quantity->standardError.reset(); // knows what the other planes found
    quantity->interval95.reset();
  }
  return ToJson(report);
}
} // namespace

TEST(SensorNoiseEstimatorBayer, ChannelsAreThoseOfThePlanes)
{
  for (const char * method : { "refined", "published" })
  {
    const auto estimator = EstimatorOf<StackType>(MosaicStack(), method);
    estimator->SetBayerPattern("GRBG");
    estimator->Update();
    ASSERT_TRUE(estimator->HasChannelReports());
    for (const BayerPlane plane : BayerPlanes)
    {
      const auto alone = EstimatorOf<StackType>(PlaneOf(MosaicStack(), plane), method);
      alone->Update();
      EXPECT_EQ(Numbers(estimator->GetChannelReports().Of(plane)), Numbers(alone->GetReport())) << NameOf(plane);
      EXPECT_EQ(estimator->GetChannelReports().Of(plane).channel, NameOf(plane));
    }
    EXPECT_EQ(estimator->GetMean()->GetLargestPossibleRegion().GetSize(0), Side);
    EXPECT_THROW(estimator->GetReport(), itk::ExceptionObject);
    EXPECT_NE(estimator->GetReportAsJson().find(R"("channels": [{)"), std::string::npos);
    EXPECT_NE(estimator->GetChannelReportAsJson("G2").find(R"("channel": "G2")"), std::string::npos);
    EXPECT_NE(estimator->GetReportAsText().find("\nchannel"), std::string::npos);
    EXPECT_THROW(estimator->GetChannelReportAsJson("green"), itk::ExceptionObject);
    estimator->SetBayerPattern("none");
    estimator->Update();
    EXPECT_FALSE(estimator->HasChannelReports());
    EXPECT_TRUE(WarnsOf(estimator->GetReport(), WarningCode::Mosaic)) << method;
    EXPECT_THROW(estimator->GetChannelReports(), itk::ExceptionObject);
  }
}

TEST(SensorNoiseEstimatorBayer, AutoGoesByTheLevels)
{
  const auto estimator = EstimatorOf<StackType>(MosaicStack());
  estimator->SetBayerPattern("auto");
  estimator->Update();
  ASSERT_TRUE(estimator->HasChannelReports());
  EXPECT_EQ(estimator->GetChannelReports().pattern, sensornoise::BayerPattern::GRBG);
  EXPECT_EQ(estimator->GetChannelReports().source, sensornoise::BayerSource::Levels);
  const auto mono = EstimatorOf<StackType>(SimulatedStack());
  mono->SetBayerPattern("auto");
  mono->Update();
  EXPECT_FALSE(mono->HasChannelReports());
  EXPECT_EQ(Numbers(mono->GetReport()), Numbers([] {
              const auto plain = EstimatorOf<StackType>(SimulatedStack());
              plain->Update();
              return plain->GetReport();
            }()));
  EXPECT_FALSE(WarnsOf(mono->GetReport(), WarningCode::Mosaic));
}

TEST(SensorNoiseEstimatorBayer, AutoGoesByTheFileFirst)
{
  const auto                  stack = MakeMosaicStack();
  sensornoise::CameraSettings camera;
  camera.bayerPattern = "GBRG"; // the levels say GRBG
  sensornoise::SetCameraSettings(stack->GetMetaDataDictionary(), camera);
  const auto estimator = EstimatorOf<StackType>(stack);
  estimator->SetBayerPattern("auto");
  estimator->Update();
  EXPECT_EQ(estimator->GetChannelReports().pattern, sensornoise::BayerPattern::GBRG);
  EXPECT_EQ(estimator->GetChannelReports().source, sensornoise::BayerSource::File);
  estimator->SetBayerPattern("GRBG");
  estimator->Update();
  EXPECT_EQ(estimator->GetChannelReports().source, sensornoise::BayerSource::Given);
}

TEST(SensorNoiseEstimatorBayer, DarkFramesAndMaskAreMosaicsToo)
{
  const auto dark = MakeMosaicStack(true, 12);
  const auto mask = itk::Image<unsigned char, 2>::New();
  mask->SetRegions(itk::Image<unsigned char, 2>::SizeType{ { Side, Side } });
  mask->Allocate();
  mask->FillBuffer(1);
  for (int x = 0; x < 20; ++x)
  {
    mask->SetPixel({ { x, 3 } }, 0);
  }
  const auto estimator = EstimatorOf<StackType>(MosaicStack());
  estimator->SetBayerPattern("GRBG");
  estimator->SetDark(dark);
  estimator->SetMask(mask);
  estimator->Update();
  for (const BayerPlane plane : BayerPlanes)
  {
    const auto planeOfMask = itk::BayerPlaneImageFilter<itk::Image<unsigned char, 2>>::New();
    planeOfMask->SetInput(mask);
    planeOfMask->SetPattern("GRBG");
    planeOfMask->SetPlane(NameOf(plane));
    planeOfMask->Update();
    const auto alone = EstimatorOf<StackType>(PlaneOf(MosaicStack(), plane));
    alone->SetDark(PlaneOf(dark, plane));
    alone->SetMask(planeOfMask->GetOutput());
    alone->Update();
    EXPECT_EQ(Numbers(estimator->GetChannelReports().Of(plane)), Numbers(alone->GetReport())) << NameOf(plane);
    const auto * const joined = estimator->GetPixelOffset();
    const auto * const ofPlane = alone->GetPixelOffset();
    const auto         corner = CornerOf(sensornoise::BayerPattern::GRBG, plane);
    const auto         x = static_cast<itk::IndexValueType>(corner[0]);
    const auto         y = static_cast<itk::IndexValueType>(corner[1]);
    EXPECT_EQ(joined->GetPixel({ { 2 * 30 + x, 2 * 11 + y } }), ofPlane->GetPixel({ { 30, 11 } }));
  }
}

TEST(SensorNoiseEstimatorBayer, EachPassReadsTheStackOnce)
{
  const auto reader = StackReader<StackType>::Of(MosaicStack());
  const auto estimator = EstimatorOf<StackType>(reader->GetOutput());
  estimator->SetNumberOfStreamDivisions(4);
  estimator->SetBayerPattern("GRBG");
  estimator->Update();
  EXPECT_EQ(reader->Reads(), 3U * 4U);
  EXPECT_EQ(reader->WholeReads(), 0U);
  estimator->SetBayerPattern("auto");
  estimator->Update();
  EXPECT_EQ(reader->Reads(), 2U * 3U * 4U); // the first chunk is there already when the first pass begins
}

TEST(SensorNoiseEstimatorBayer, RowsOfLargeFramesTakeTurnsAndFindTheSame)
{
  // On the target there are 9 series or more, whose sums have more than 32 MiB, and 72 bytes for a pixel of floats.
  using FloatStack = itk::Image<float, 3>;
  constexpr unsigned int frames = 24;
  const auto             cast = itk::CastImageFilter<StackType, FloatStack>::New();
  cast->SetInput(MakeMosaicStack(false, frames, 720));
  cast->Update();
  const FloatStack::Pointer stack = cast->GetOutput();
  const auto                reader = StackReader<FloatStack>::Of(stack);
  const auto                inTurns = EstimatorOf<FloatStack>(reader->GetOutput());
  inTurns->SetNumberOfStreamDivisions(4);
  inTurns->SetBayerPattern("GRBG");
  inTurns->Update();
  EXPECT_EQ(reader->Reads(), (3U + 1U) * 4U);
  const auto again = StackReader<FloatStack>::Of(stack);
  const auto together = EstimatorOf<FloatStack>(again->GetOutput());
  together->SetNumberOfStreamDivisions(4);
  together->SetBayerPattern("GRBG");
  together->SetMemoryLimit(1'000'000'000);
  together->Update();
  EXPECT_EQ(again->Reads(), 3U * 4U);
  EXPECT_EQ(inTurns->GetReportAsJson(), together->GetReportAsJson());
}

TEST(SensorNoiseEstimatorBayer, AnUnknownPatternIsRefused)
{
  const auto estimator = itk::SensorNoiseEstimator<StackType>::New();
  EXPECT_EQ(estimator->GetBayerPattern(), "none");
  EXPECT_THROW(estimator->SetBayerPattern("BAYER"), itk::ExceptionObject);
}
