// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/Report.h"
#include "itkNoiseCorrelationEstimator.h"
#include "itkNoiseRegressionEstimator.h"
#include "itkSensorNoiseEstimator.h"
#include "itkVibrationCovarianceEstimator.h"
#include "helpers/PipelineTestHelper.h"
#include "helpers/SensorNoiseEstimatorTestHelper.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <string>
#include <utility>
#include <vector>

// Settings in the report, and errors where there is no report.

namespace
{
using namespace sensornoisetest;
using namespace sensornoisetest::estimator;
using MaskType = itk::Image<unsigned char, 2>;
using Setting = std::pair<std::string, sensornoise::Report::SettingValue>;

const MaskType::SizeType FrameSize{ { Width, Height } };
const char * const       NoResult = "there is no result: Update() of the estimator comes first, and must succeed";

template <typename TEstimator>
std::vector<Setting>
SettingsOf(const TEstimator & estimator)
{
  estimator->Update();
  return estimator->GetReport().settings;
}

bool
Holds(const std::vector<Setting> & settings, const Setting & expected)
{
  return std::count(settings.begin(), settings.end(), expected) == 1;
}
} // namespace

TEST(SensorNoiseEstimatorSettings, WhatWasGivenIsNotedWhateverTheMethod)
{
  for (const char * method : { "refined", "published" })
  {
    const auto estimator = EstimatorOf<StackType>(SimulatedStack(), method);
    for (const auto & setting : SettingsOf(estimator))
    {
      for (const char * notGiven :
           { "bit_depth", "clip", "quantisation", "mask", "roi", "frame_range", "offset", "dark_f" })
      {
        EXPECT_NE(setting.first.rfind(notGiven, 0), 0u) << method << " " << setting.first;
      }
    }
    estimator->SetBitDepth(14);
    estimator->SetClipLow(3.0);
    estimator->SetClipHigh(4000.0);
    estimator->SetQuantisationStep(1.0);
    estimator->SetMask(ConstantImage<MaskType>(FrameSize, 1));
    estimator->SetSourceRegion(10, 5, Width, Height);
    estimator->SetSourceFrames(7, 7 + Frames);
    const auto settings = SettingsOf(estimator);
    for (const Setting & expected : { Setting("bit_depth", 14.0),
                                      Setting("clip_low", 3.0),
                                      Setting("clip_high", 4000.0),
                                      Setting("quantisation_step", 1.0),
                                      Setting("roi_x", 10.0),
                                      Setting("roi_y", 5.0),
                                      Setting("roi_width", double{ Width }),
                                      Setting("roi_height", double{ Height }),
                                      Setting("frame_range_first", 7.0),
                                      Setting("frame_range_end", 7.0 + Frames) })
    {
      EXPECT_TRUE(Holds(settings, expected)) << method << " " << expected.first;
    }
    EXPECT_EQ(std::count_if(
                settings.begin(), settings.end(), [](const auto & setting) { return setting.first == "mask_crc32"; }),
              1);
  }
}

TEST(SensorNoiseEstimatorSettings, NotingTheSourceChangesNoNumber)
{
  const auto estimator = EstimatorOf<StackType>(SimulatedStack());
  estimator->Update();
  sensornoise::Report plain = estimator->GetReport();
  estimator->SetSourceRegion(1, 2, Width, Height);
  estimator->Update();
  sensornoise::Report noted = estimator->GetReport();
  EXPECT_NE(noted.settings, plain.settings);
  noted.settings = plain.settings = {};
  EXPECT_EQ(sensornoise::ToJson(noted), sensornoise::ToJson(plain));
}

TEST(SensorNoiseEstimatorSettings, AHashIsNotedAndChangesNoNumber)
{
  const std::string frames(64, '0');
  const std::string darkFrames(64, 'f');
  const auto        estimator = EstimatorOf<StackType>(SimulatedStack());
  estimator->Update();
  sensornoise::Report plain = estimator->GetReport();
  EXPECT_FALSE(plain.input);
  estimator->SetFramesHash(frames, 0, 8190000);
  estimator->SetDarkHash(darkFrames, 2, 700); // no such frames are given
  estimator->Update();
  sensornoise::Report noted = estimator->GetReport();
  EXPECT_NE(sensornoise::ToJson(noted).find("\"input\": {\"of\": \"pixels\", \"sha256\": \"" + frames +
                                            "\", \"files\": 0, \"bytes\": 8190000}"),
            std::string::npos);
  EXPECT_NE(estimator->GetReportAsText().find("\nframes: pixels, 8190000 bytes, SHA-256 " + frames + "\n"),
            std::string::npos);
  EXPECT_NE(estimator->GetReportAsHtml().find("<code>" + frames + "</code>"), std::string::npos);
  noted.input.reset();
  EXPECT_EQ(sensornoise::ToJson(noted), sensornoise::ToJson(plain));

  estimator->SetDark(ConstantImage<StackType>({ { Width, Height, 2 } }, 100));
  estimator->Update();
  EXPECT_NE(estimator->GetReportAsText().find("\ndark frames: 2 files, 700 bytes, SHA-256 " + darkFrames + "\n"),
            std::string::npos);
  EXPECT_SAYS(ErrorWhen([&] { estimator->SetFramesHash("F00", 1, 1); }),
              "the hash is \"F00\"; expected a SHA-256, 64 hexadecimal digits in small letters");
}

TEST(SensorNoiseEstimatorSettings, ASourceOfAnotherSizeIsRefused)
{
  const auto region = EstimatorOf<StackType>(SimulatedStack());
  region->SetSourceRegion(0, 0, 4, 5);
  EXPECT_SAYS(ErrorOf(region), "the source's region has 4 x 5 pixels, but the frames have 65 x 63");
  const auto frames = EstimatorOf<StackType>(SimulatedStack());
  frames->SetSourceFrames(2, 9);
  EXPECT_SAYS(ErrorOf(frames), "the source's frames are 2 up to 9, but the stack has 25");
}

TEST(SensorNoiseEstimatorSettings, WithoutAnUpdateThereIsNoReport)
{
  const auto estimator = EstimatorOf<StackType>(SimulatedStack());
  EXPECT_SAYS(ErrorWhen([&] { estimator->GetReportAsJson(); }), NoResult);
  EXPECT_SAYS(ErrorWhen([&] { estimator->GetReportAsText(); }), NoResult);
  EXPECT_SAYS(ErrorWhen([&] { estimator->GetReportAsHtml(); }), NoResult);
  EXPECT_SAYS(ErrorWhen([&] { estimator->GetReportAsSvg(); }), NoResult);
  EXPECT_SAYS(ErrorWhen([&] { estimator->GetNoiseKind(); }), NoResult);
  const auto regression = itk::NoiseRegressionEstimator<>::New();
  EXPECT_SAYS(ErrorWhen([&] { regression->GetReportAsJson(); }), NoResult);
  const auto correlation = itk::NoiseCorrelationEstimator<StackType>::New();
  EXPECT_SAYS(ErrorWhen([&] { correlation->GetResultAsJson(); }), NoResult);
  const auto vibration = itk::VibrationCovarianceEstimator<>::New();
  EXPECT_SAYS(ErrorWhen([&] { vibration->GetCovariance(); }), NoResult);
}

TEST(SensorNoiseEstimatorSettings, AfterAFailureThereIsNoReportOfBefore)
{
  const auto reader = StackReader<StackType>::Of(SimulatedStack());
  const auto estimator = EstimatorOf<StackType>(reader->GetOutput());
  estimator->Update();
  EXPECT_NE(estimator->GetReportAsJson(), "");
  EXPECT_EQ(estimator->GetReportAsHtml().rfind("<!DOCTYPE html>", 0), 0U);
  reader->Break(20);
  estimator->SetBitDepth(14);
  EXPECT_SAYS(ErrorOf(estimator), "frame 20 is broken");
  EXPECT_SAYS(ErrorWhen([&] { estimator->GetReportAsJson(); }), NoResult);
}
