// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/Simulator.h"
#include "sensornoise/SimulationSettings.h"
#include "itkSensorNoiseStackSource.h"
#include "itkImageRegionConstIterator.h"
#include "itkPipelineMonitorImageFilter.h"
#include "itkStreamingImageFilter.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <limits>
#include <sstream>
#include <string>
#include <vector>

namespace
{
using ReferenceType = itk::Image<double, 2>;
using StackType = itk::Image<unsigned short, 3>;
using SourceType = itk::SensorNoiseStackSource<StackType>;
constexpr unsigned int Width = 32;
constexpr unsigned int Height = 20;
constexpr unsigned int Frames = 9;

/** Returns sixteen bars, with a geometry that is not the default. */
ReferenceType::Pointer
MakeReference()
{
  ReferenceType::RegionType region;
  region.SetIndex(0, 5);
  region.SetIndex(1, -3);
  region.SetSize(0, Width);
  region.SetSize(1, Height);
  ReferenceType::SpacingType   spacing;
  ReferenceType::PointType     origin;
  ReferenceType::DirectionType direction;
  spacing[0] = 0.5;
  spacing[1] = 0.25;
  origin[0] = 10.0;
  origin[1] = -4.0;
  direction(0, 0) = 0.0;
  direction(0, 1) = -1.0;
  direction(1, 0) = 1.0;
  direction(1, 1) = 0.0;
  auto image = ReferenceType::New();
  image->SetRegions(region);
  image->SetSpacing(spacing);
  image->SetOrigin(origin);
  image->SetDirection(direction);
  image->Allocate();
  const auto scene = sensornoise::MakeBarsScene(Width, Height);
  std::copy(scene.begin(), scene.end(), image->GetBufferPointer());
  return image;
}

template <typename TStack = StackType>
typename itk::SensorNoiseStackSource<TStack>::Pointer
MakeSource()
{
  auto source = itk::SensorNoiseStackSource<TStack>::New();
  source->SetReference(MakeReference());
  source->SetNumberOfFrames(Frames);
  return source;
}

template <typename TStack>
std::vector<typename TStack::PixelType>
PixelsOf(const TStack * stack, const typename TStack::RegionType & region)
{
  std::vector<typename TStack::PixelType> pixels;
  for (itk::ImageRegionConstIterator<TStack> it(stack, region); !it.IsAtEnd(); ++it)
  {
    pixels.push_back(it.Get());
  }
  return pixels;
}

template <typename TStack>
std::vector<typename TStack::PixelType>
PixelsOf(const TStack * stack)
{
  return PixelsOf(stack, stack->GetLargestPossibleRegion());
}

std::string
ErrorOf(SourceType * source)
{
  try
  {
    source->Update();
  }
  catch (const itk::ExceptionObject & error)
  {
    return error.GetDescription();
  }
  return "no error";
}

/** Expects the stack that the simulator draws, row by row. */
template <typename TPixel>
void
CheckAgainstSimulator()
{
  using PixelStackType = itk::Image<TPixel, 3>;
  const auto source = MakeSource<PixelStackType>();
  source->Update();
  sensornoise::SimulationSettings settings;
  settings.frames = Frames;
  settings.bitDepth = sizeof(TPixel) == 1 ? 8 : 12;
  const sensornoise::StackSimulator simulator(sensornoise::MakeBarsScene(Width, Height), Width, Height, settings);
  std::vector<TPixel>               expected;
  std::vector<TPixel>               row(Width);
  for (unsigned int frame = 0; frame < Frames; ++frame)
  {
    for (unsigned int y = 0; y < Height; ++y)
    {
      simulator.RenderRow(frame, y, row.data());
      expected.insert(expected.end(), row.begin(), row.end());
    }
  }
  EXPECT_EQ(PixelsOf<PixelStackType>(source->GetOutput()), expected);
  EXPECT_EQ(source->GetTruth().series.gamma, simulator.GetTruth().series.gamma);
}
} // namespace

template class itk::SensorNoiseStackSource<itk::Image<unsigned char, 3>>;
template class itk::SensorNoiseStackSource<itk::Image<short, 3>>;
template class itk::SensorNoiseStackSource<itk::Image<float, 3>>;

TEST(SensorNoiseStackSource, DrawsWhatTheSimulatorDrawsForEachPixelType)
{
  CheckAgainstSimulator<unsigned char>();
  CheckAgainstSimulator<unsigned short>();
  CheckAgainstSimulator<short>();
  CheckAgainstSimulator<float>();
  CheckAgainstSimulator<double>();
}

TEST(SensorNoiseStackSource, OutputTakesTheGeometryOfTheReference)
{
  const auto source = MakeSource();
  source->UpdateOutputInformation();
  const auto * stack = source->GetOutput();
  const auto   region = stack->GetLargestPossibleRegion();
  EXPECT_EQ(region.GetIndex(), (StackType::IndexType{ { 5, -3, 0 } }));
  EXPECT_EQ(region.GetSize(), (StackType::SizeType{ { Width, Height, Frames } }));
  EXPECT_EQ(stack->GetSpacing()[0], 0.5);
  EXPECT_EQ(stack->GetSpacing()[1], 0.25);
  EXPECT_EQ(stack->GetSpacing()[2], 1.0);
  EXPECT_EQ(stack->GetOrigin()[0], 10.0);
  EXPECT_EQ(stack->GetOrigin()[1], -4.0);
  EXPECT_EQ(stack->GetOrigin()[2], 0.0);
  EXPECT_EQ(stack->GetDirection()(0, 1), -1.0);
  EXPECT_EQ(stack->GetDirection()(1, 0), 1.0);
  EXPECT_EQ(stack->GetDirection()(2, 2), 1.0);
  EXPECT_EQ(stack->GetDirection()(0, 0) + stack->GetDirection()(2, 0) + stack->GetDirection()(0, 2), 0.0);
}

TEST(SensorNoiseStackSource, TruthIsKnownBeforeAnyPixel)
{
  const auto source = MakeSource();
  source->SetConditions(1);
  source->UpdateOutputInformation();
  EXPECT_EQ(source->GetTruth().series.gamma.size(), Frames);
  EXPECT_EQ(source->GetTruth().settings.conditions.flickerSd, 0.1);
  EXPECT_GT(source->GetTruth().realisedFlickerSd, 0.0);
  EXPECT_EQ(source->GetSimulator(), nullptr);
  source->Update();
  EXPECT_EQ(source->GetSimulator()->GetTruth().series.gamma, source->GetTruth().series.gamma);
}

TEST(SensorNoiseStackSource, SameBitsForAnyNumberOfWorkUnits)
{
  const auto one = MakeSource();
  one->SetNumberOfWorkUnits(1);
  one->Update();
  const auto seven = MakeSource();
  seven->SetNumberOfWorkUnits(7);
  seven->Update();
  EXPECT_EQ(PixelsOf<StackType>(one->GetOutput()), PixelsOf<StackType>(seven->GetOutput()));
}

TEST(SensorNoiseStackSource, StreamsWithTheSameBitsForAnyChunks)
{
  const auto whole = MakeSource();
  whole->Update();
  const auto expected = PixelsOf<StackType>(whole->GetOutput());
  for (const unsigned int chunks : { 1u, 3u, Frames })
  {
    const auto source = MakeSource();
    const auto monitor = itk::PipelineMonitorImageFilter<StackType>::New();
    monitor->SetInput(source->GetOutput());
    const auto streamer = itk::StreamingImageFilter<StackType, StackType>::New();
    streamer->SetInput(monitor->GetOutput());
    streamer->SetNumberOfStreamDivisions(chunks);
    streamer->Update();
    EXPECT_TRUE(monitor->VerifyAllInputCanStream(static_cast<int>(chunks)));
    EXPECT_EQ(PixelsOf<StackType>(streamer->GetOutput()), expected) << chunks;
  }
}

TEST(SensorNoiseStackSource, AnyRegionIsThatPartOfTheWhole)
{
  const auto whole = MakeSource();
  whole->Update();
  StackType::RegionType region;
  region.SetIndex({ { 9, 1, 2 } });
  region.SetSize({ { 7, 3, 4 } });
  const auto source = MakeSource();
  source->GetOutput()->SetRequestedRegion(region);
  source->GetOutput()->Update();
  EXPECT_EQ(source->GetOutput()->GetBufferedRegion(), region);
  EXPECT_EQ(PixelsOf<StackType>(source->GetOutput(), region), PixelsOf<StackType>(whole->GetOutput(), region));
}

TEST(SensorNoiseStackSource, AsksForTheWholeReference)
{
  const auto monitor = itk::PipelineMonitorImageFilter<ReferenceType>::New();
  monitor->SetInput(MakeReference());
  monitor->UpdateOutputInformation();
  ReferenceType::RegionType corner = monitor->GetOutput()->GetLargestPossibleRegion();
  corner.SetSize({ { 2, 2 } });
  monitor->GetOutput()->SetRequestedRegion(corner);
  const auto source = MakeSource();
  source->SetReference(monitor->GetOutput());
  source->Update();
  EXPECT_TRUE(monitor->VerifyInputFilterRequestedLargestRegion());
  EXPECT_EQ(monitor->GetOutput()->GetRequestedRegion(), monitor->GetOutput()->GetLargestPossibleRegion());
}

TEST(SensorNoiseStackSource, SimulatorIsRebuiltOnlyWhenSomethingChanged)
{
  const auto monitor = itk::PipelineMonitorImageFilter<ReferenceType>::New();
  monitor->SetInput(MakeReference());
  const auto source = MakeSource();
  source->SetInput(monitor->GetOutput());
  source->UpdateOutputInformation();
  StackType::RegionType frame = source->GetOutput()->GetLargestPossibleRegion();
  frame.SetSize(2, 1);
  const auto updateFrame = [&](int number) {
    frame.SetIndex(2, number);
    source->GetOutput()->SetRequestedRegion(frame);
    source->GetOutput()->Update();
    return source->GetSimulator();
  };
  const auto * first = updateFrame(0);
  EXPECT_EQ(updateFrame(3), first);
  EXPECT_EQ(updateFrame(3), first);
  EXPECT_EQ(monitor->GetNumberOfUpdates(), 1u);

  const auto before = PixelsOf<StackType>(source->GetOutput(), frame);
  source->SetGain(0.5);
  updateFrame(3);
  EXPECT_EQ(source->GetSimulator()->GetTruth().settings.camera.gainDnPerElectron, 0.5);
  EXPECT_NE(PixelsOf<StackType>(source->GetOutput(), frame), before);
  source->SetGain(1.0);
  updateFrame(3);
  EXPECT_EQ(PixelsOf<StackType>(source->GetOutput(), frame), before);

  const auto flat = MakeReference();
  flat->FillBuffer(1.0);
  monitor->SetInput(flat);
  updateFrame(3);
  EXPECT_NE(PixelsOf<StackType>(source->GetOutput(), frame), before);
}

TEST(SensorNoiseStackSource, ParametersReachTheSimulator)
{
  const auto source = MakeSource();
  source->SetCamera('C');
  source->SetConditions(2);
  source->SetBitDepth(14);
  source->SetSeed(77);
  source->SetOpticalBlur(0.7);
  source->SetRollingShutterPeriod(12.0);
  source->SetClipLow(3.0);
  source->SetClipHigh(3000.0);
  source->SetPrnuSd(0.01);
  source->SetDsnuSd(0.5);
  source->SetHotPixelFraction(0.001);
  source->SetHotPixelNoiseFactor(20.0);
  source->UpdateOutputInformation();
  const sensornoise::SimulationSettings & settings = source->GetTruth().settings;
  EXPECT_EQ(settings.camera.electrons, 10000.0);
  EXPECT_EQ(settings.camera.gainDnPerElectron, 0.3);
  EXPECT_EQ(settings.camera.offsetDn, 40.0);
  EXPECT_EQ(settings.camera.readNoiseDn, 3.0);
  EXPECT_EQ(settings.conditions.flickerSd, 0.01);
  EXPECT_EQ(settings.conditions.vibrationSdXPixels, 0.1);
  EXPECT_EQ(settings.conditions.vibrationSdYPixels, 0.05);
  EXPECT_EQ(settings.frames, Frames);
  EXPECT_EQ(settings.bitDepth, 14u);
  EXPECT_EQ(settings.seed, 77u);
  EXPECT_EQ(settings.opticalBlurPixels, 0.7);
  EXPECT_EQ(settings.rollingShutterPeriodRows, 12.0);
  EXPECT_EQ(settings.clipLowDn, 3.0);
  EXPECT_EQ(settings.clipHighDn, 3000.0);
  EXPECT_EQ(settings.prnuSd, 0.01);
  EXPECT_EQ(settings.dsnuSdDn, 0.5);
  EXPECT_EQ(settings.hotPixelFraction, 0.001);
  EXPECT_EQ(settings.hotPixelNoiseFactor, 20.0);
  std::ostringstream text;
  source->Print(text);
  EXPECT_NE(text.str().find("RollingShutterPeriod: 12"), std::string::npos);
  EXPECT_STREQ(source->GetNameOfClass(), "SensorNoiseStackSource");
}

TEST(SensorNoiseStackSource, ErrorsSayWhatWasFoundAndExpected)
{
  const auto source = MakeSource();
  EXPECT_NE(ErrorOf(SourceType::New()).find("Reference"), std::string::npos);
  source->SetBitDepth(17);
  EXPECT_NE(ErrorOf(source).find("the bit depth is 17; the pixel type holds at most 16 bits"), std::string::npos);
  source->SetBitDepth(12);
  source->SetNumberOfFrames(0);
  EXPECT_NE(ErrorOf(source).find("the number of frames is 0; expected at least 1"), std::string::npos);
  EXPECT_THROW(source->SetCamera('b'), itk::ExceptionObject);
  EXPECT_THROW(source->SetConditions(0), itk::ExceptionObject);
  EXPECT_THROW(source->SetInput(1, MakeReference()), itk::ExceptionObject);
}

TEST(SensorNoiseStackSource, ThrowsUntilTheReferenceIsMended)
{
  const auto reference = MakeReference();
  const auto source = MakeSource();
  source->SetInput(0, reference);
  EXPECT_EQ(ErrorOf(source), "no error");
  reference->Modified();
  reference->GetBufferPointer()[7] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(ErrorOf(source).find("not finite"), std::string::npos);
  EXPECT_NE(ErrorOf(source).find("not finite"), std::string::npos);
  EXPECT_EQ(source->GetSimulator(), nullptr);
  reference->GetBufferPointer()[7] = 0.5;
  reference->Modified();
  EXPECT_EQ(ErrorOf(source), "no error");
}

namespace
{
/** Upstream filter that fails while a flag is set. */
class FailingSource : public itk::ImageSource<ReferenceType>
{
public:
  using Self = FailingSource;
  using Pointer = itk::SmartPointer<Self>;
  itkNewMacro(Self);
  bool fails{ true };

protected:
  void
  GenerateOutputInformation() override
  {
    this->GetOutput()->CopyInformation(MakeReference());
  }
  void
  GenerateData() override
  {
    if (fails)
    {
      itkExceptionMacro("no light");
    }
    this->GraftOutput(MakeReference());
  }
};
} // namespace

TEST(SensorNoiseStackSource, ThrowsAgainAfterAFailureUpstream)
{
  const auto upstream = FailingSource::New();
  const auto source = MakeSource();
  source->SetReference(upstream->GetOutput());
  EXPECT_NE(ErrorOf(source).find("no light"), std::string::npos);
  EXPECT_NE(ErrorOf(source).find("no light"), std::string::npos);
  upstream->fails = false;
  upstream->Modified();
  EXPECT_EQ(ErrorOf(source), "no error");
  const auto expected = MakeSource();
  expected->Update();
  EXPECT_EQ(PixelsOf<StackType>(source->GetOutput()), PixelsOf<StackType>(expected->GetOutput()));
}
