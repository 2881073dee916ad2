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
#include <sstream>
#include <string>
#include <vector>

// Flaws of the sensor and processing in the camera, set on the filter.

namespace
{
using ReferenceType = itk::Image<double, 2>;
using StackType = itk::Image<unsigned short, 3>;
using SourceType = itk::SensorNoiseStackSource<StackType>;
constexpr unsigned int Width = 32;
constexpr unsigned int Height = 20;
constexpr unsigned int Frames = 7;

SourceType::Pointer
MakeSource()
{
  const auto reference = ReferenceType::New();
  reference->SetRegions(ReferenceType::SizeType{ { Width, Height } });
  reference->Allocate();
  const auto scene = sensornoise::MakeBarsScene(Width, Height);
  std::copy(scene.begin(), scene.end(), reference->GetBufferPointer());
  auto source = SourceType::New();
  source->SetReference(reference);
  source->SetNumberOfFrames(Frames);
  return source;
}

/** Rows that need others, and frames that need others. */
SourceType::Pointer
MakeMixedSource()
{
  auto source = MakeSource();
  source->SetCouplingFraction(0.02);
  source->SetSmoothingSd(0.5);
  source->SetTemporalFilterWeight(0.5);
  return source;
}

std::vector<unsigned short>
PixelsOf(const StackType * stack, const StackType::RegionType & region)
{
  std::vector<unsigned short> pixels;
  for (itk::ImageRegionConstIterator<StackType> it(stack, region); !it.IsAtEnd(); ++it)
  {
    pixels.push_back(it.Get());
  }
  return pixels;
}

std::vector<unsigned short>
PixelsOf(SourceType * source)
{
  source->Update();
  return PixelsOf(source->GetOutput(), source->GetOutput()->GetLargestPossibleRegion());
}
} // namespace

TEST(SensorNoiseStackSourceFlaws, DrawsTheSimulatorsFrames)
{
  const auto                      source = MakeMixedSource();
  sensornoise::SimulationSettings settings;
  settings.frames = Frames;
  settings.flaws.coupling.fraction = 0.02;
  settings.flaws.smoothing.sdPixels = 0.5;
  settings.flaws.temporalFilter.weight = 0.5;
  const sensornoise::StackSimulator simulator(sensornoise::MakeBarsScene(Width, Height), Width, Height, settings);
  std::vector<unsigned short>       expected(Width * Height * Frames);
  for (unsigned int frame = 0; frame < Frames; ++frame)
  {
    simulator.RenderFrame(frame, expected.data() + frame * Width * Height);
  }
  EXPECT_EQ(PixelsOf(source), expected);
}

TEST(SensorNoiseStackSourceFlaws, WholeFramesHaveTheSameBitsForAnyWorkUnitsAndChunks)
{
  const auto expected = PixelsOf(MakeMixedSource());
  const auto seven = MakeMixedSource();
  seven->SetNumberOfWorkUnits(7);
  EXPECT_EQ(PixelsOf(seven), expected);
  for (const unsigned int chunks : { 1u, 3u, Frames })
  {
    const auto source = MakeMixedSource();
    const auto monitor = itk::PipelineMonitorImageFilter<StackType>::New();
    monitor->SetInput(source->GetOutput());
    const auto streamer = itk::StreamingImageFilter<StackType, StackType>::New();
    streamer->SetInput(monitor->GetOutput());
    streamer->SetNumberOfStreamDivisions(chunks);
    streamer->Update();
    EXPECT_TRUE(monitor->VerifyAllInputCanStream(static_cast<int>(chunks)));
    EXPECT_EQ(PixelsOf(streamer->GetOutput(), streamer->GetOutput()->GetLargestPossibleRegion()), expected) << chunks;
  }
}

TEST(SensorNoiseStackSourceFlaws, AnyRegionOfWholeFramesIsThatPartOfTheWhole)
{
  const auto whole = MakeMixedSource();
  whole->Update();
  StackType::RegionType region;
  region.SetIndex({ { 9, 1, 2 } });
  region.SetSize({ { 7, 3, 4 } });
  const auto source = MakeMixedSource();
  source->GetOutput()->SetRequestedRegion(region);
  source->GetOutput()->Update();
  EXPECT_EQ(source->GetOutput()->GetBufferedRegion(), region);
  EXPECT_EQ(PixelsOf(source->GetOutput(), region), PixelsOf(whole->GetOutput(), region));
}

TEST(SensorNoiseStackSourceFlaws, ParametersReachTheSimulator)
{
  const auto source = MakeSource();
  source->DarkOn();
  source->SetBayerPattern("GBRG");
  source->SetTransmissionR(0.4);
  source->SetTransmissionG(0.9);
  source->SetTransmissionB(0.3);
  source->SetGainSd(0.011);
  source->SetColumnGainSd(0.012);
  source->SetColumnEfficiencySd(0.013);
  source->SetColumnOffsetSd(1.4);
  source->SetBrighterFatterPerElectron(1.5e-6);
  source->SetCouplingFraction(0.016);
  source->SetReadNoiseSpread(0.17);
  source->SetReadNoiseTailFraction(0.018);
  source->SetReadNoiseTailSpread(1.9);
  source->SetResponseShape("wave");
  source->SetResponseSize(-0.02);
  source->SetResponseFullScale(2100.0);
  source->SetRowNoiseSd(2.2);
  source->SetColumnNoiseSd(2.3);
  source->SetBandingAmplitude(2.4);
  source->SetBandingPeriod(25.0);
  source->SetDefectThresholdSd(2.6);
  source->SetTemporalFilterWeight(0.27);
  source->SetMedianRadius(1);
  source->SetSmoothingSd(0.28);
  source->SetBinningFactor(3);
  source->SetBinningInterpolation("linear");
  source->SetResamplingShiftX(0.29);
  source->SetResamplingShiftY(-0.30);
  source->SetResamplingInterpolation("cubic");
  source->SetBlockQuality(91);
  source->SetCompandingBits(10);
  source->SetRepeatCount(2);
  source->SetRepeatPeriod(3);
  source->UpdateOutputInformation();
  EXPECT_TRUE(source->GetTruth().settings.isDark);
  const sensornoise::SensorFlaws & flaws = source->GetTruth().settings.flaws;
  EXPECT_EQ(flaws.filters.pattern, sensornoise::BayerPattern::GBRG);
  EXPECT_EQ(flaws.filters.transmissionR, 0.4);
  EXPECT_EQ(flaws.filters.transmissionG, 0.9);
  EXPECT_EQ(flaws.filters.transmissionB, 0.3);
  EXPECT_EQ(flaws.pattern.gainSd, 0.011);
  EXPECT_EQ(flaws.pattern.columnGainSd, 0.012);
  EXPECT_EQ(flaws.pattern.columnEfficiencySd, 0.013);
  EXPECT_EQ(flaws.pattern.columnOffsetSdDn, 1.4);
  EXPECT_EQ(flaws.brighterFatter.perElectron, 1.5e-6);
  EXPECT_EQ(flaws.coupling.fraction, 0.016);
  EXPECT_EQ(flaws.readNoise.spread, 0.17);
  EXPECT_EQ(flaws.readNoise.tailFraction, 0.018);
  EXPECT_EQ(flaws.readNoise.tailSpread, 1.9);
  EXPECT_EQ(flaws.response.shape, sensornoise::ResponseShape::Wave);
  EXPECT_EQ(flaws.response.size, -0.02);
  EXPECT_EQ(flaws.response.fullScaleElectrons, 2100.0);
  EXPECT_EQ(flaws.lineNoise.rowNoiseSdDn, 2.2);
  EXPECT_EQ(flaws.lineNoise.columnNoiseSdDn, 2.3);
  EXPECT_EQ(flaws.lineNoise.bandingAmplitudeDn, 2.4);
  EXPECT_EQ(flaws.lineNoise.bandingPeriodRows, 25.0);
  EXPECT_EQ(flaws.defectCorrection.thresholdSd, 2.6);
  EXPECT_EQ(flaws.temporalFilter.weight, 0.27);
  EXPECT_EQ(flaws.median.radiusPixels, 1u);
  EXPECT_EQ(flaws.smoothing.sdPixels, 0.28);
  EXPECT_EQ(flaws.binning.factor, 3u);
  EXPECT_EQ(flaws.binning.interpolation, sensornoise::Interpolation::Linear);
  EXPECT_EQ(flaws.resampling.shiftXPixels, 0.29);
  EXPECT_EQ(flaws.resampling.shiftYPixels, -0.30);
  EXPECT_EQ(flaws.resampling.interpolation, sensornoise::Interpolation::Cubic);
  EXPECT_EQ(flaws.blocks.quality, 91u);
  EXPECT_EQ(flaws.companding.bits, 10u);
  EXPECT_EQ(flaws.repetition.count, 2u);
  EXPECT_EQ(flaws.repetition.period, 3u);
  EXPECT_EQ(source->GetResponseShape(), "wave");
  EXPECT_EQ(source->GetRepeatCount(), 2u);
  std::ostringstream text;
  source->Print(text);
  EXPECT_NE(text.str().find("ResponseShape: wave"), std::string::npos);
  EXPECT_NE(text.str().find("BandingPeriod: 25"), std::string::npos);
  EXPECT_NE(text.str().find("ResamplingInterpolation: cubic"), std::string::npos);
}

TEST(SensorNoiseStackSourceFlaws, ReadNoiseOfThePixelsIsKnownBeforeAnyPixel)
{
  const auto source = MakeSource();
  source->SetReadNoiseSpread(0.3);
  source->UpdateOutputInformation();
  const double rmsDn = source->GetTruth().realisedReadNoiseRmsDn;
  EXPECT_GT(rmsDn, source->GetTruth().realisedReadNoiseMedianDn);
  EXPECT_NE(source->GetTruthAsJson().find("\"realised_read_noise\":"), std::string::npos);
  EXPECT_NE(source->GetTruthAsJson().find("\"spread\": 0.3"), std::string::npos) << source->GetTruthAsJson();
  source->Update();
  EXPECT_EQ(source->GetSimulator()->GetTruth().realisedReadNoiseRmsDn, rmsDn);
}

TEST(SensorNoiseStackSourceFlaws, AChangedFlawIsDrawnAndARefusedOneSaysWhy)
{
  const auto source = MakeSource();
  const auto plain = PixelsOf(source);
  source->SetRowNoiseSd(3.0);
  EXPECT_NE(PixelsOf(source), plain);
  source->SetRowNoiseSd(0.0);
  EXPECT_EQ(PixelsOf(source), plain);
  EXPECT_THROW(source->SetResponseShape("bent"), itk::ExceptionObject);
  EXPECT_THROW(source->SetBinningInterpolation("sinc"), itk::ExceptionObject);
  source->SetCouplingFraction(0.5);
  try
  {
    source->Update();
    FAIL() << "no error";
  }
  catch (const itk::ExceptionObject & error)
  {
    EXPECT_NE(std::string(error.GetDescription()).find("the coupling of charge is 0.5; expected 0 to 0.2"),
              std::string::npos);
  }
  source->SetCouplingFraction(0.0);
  EXPECT_EQ(PixelsOf(source), plain);
}
