// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/Settings.h"
#include "sensornoise/ReportText.h"
#include "itkImage.h"
#include "itkMetaDataObject.h"
#include "itkSensorNoiseEstimator.h"
#include "itkSensorNoiseMetaData.h"
#include "helpers/PipelineTestHelper.h"
#include "helpers/SensorNoiseEstimatorTestHelper.h"

#include <gtest/gtest.h>
#include <limits>
#include <string>

/** \file
 * Camera settings in the metadata of the input count as given, unless the caller gives others. */

namespace
{
using namespace sensornoisetest;
using namespace sensornoisetest::estimator;

/** Returns the stack of the tests, with metadata. */
StackType::Pointer
StackOf(const sensornoise::CameraSettings & camera)
{
  const auto stack = TargetStack<StackType>(Width, Height, Frames);
  sensornoise::SetCameraSettings(stack->GetMetaDataDictionary(), camera);
  return stack;
}
} // namespace

TEST(SensorNoiseEstimatorCamera, DnSettingsAreReadFromTheFile)
{
  sensornoise::CameraSettings camera;
  camera.camera = "Maker Model";
  camera.bitDepth = 14;
  camera.whiteLevelDn = 3000.0;
  const auto stack = StackOf(camera);
  const auto estimator = EstimatorOf<StackType>(stack.GetPointer());
  const auto given = EstimatorOf<StackType>(SimulatedStack());
  given->SetBitDepth(14);
  given->SetClipHigh(3000.0);
  const std::string text = JsonOf(estimator);
  EXPECT_NE(text.find("\"camera\": {\"name\": \"Maker Model\", \"bayer_pattern\": null, \"bit_depth\": 14"),
            std::string::npos)
    << text.substr(0, 600);
  EXPECT_EQ(estimator->GetReport().camera.whiteLevelDn, 3000.0);
  JsonOf(given);
  EXPECT_EQ(estimator->GetReport().gain.value, given->GetReport().gain.value);
  EXPECT_EQ(estimator->GetReport().bitDepth, 14);
  EXPECT_EQ(estimator->GetReport().clipHighDn, 3000.0);
  estimator->SetBitDepth(13);
  estimator->SetClipHigh(2900.0);
  JsonOf(estimator);
  EXPECT_EQ(estimator->GetReport().bitDepth, 13);
  EXPECT_EQ(estimator->GetReport().clipHighDn, 2900.0);
}

TEST(SensorNoiseEstimatorCamera, NumbersMayBeOfAnyType)
{
  const auto stack = StackOf({});
  auto &     dictionary = stack->GetMetaDataDictionary();
  itk::EncapsulateMetaData(dictionary, sensornoise::MetaDataKeys::WhiteLevel, 3000.0F); // as Python writes them
  itk::EncapsulateMetaData(dictionary, sensornoise::MetaDataKeys::BitDepth, 14);
  const auto camera = sensornoise::CameraSettingsOf(dictionary);
  EXPECT_EQ(camera.whiteLevelDn, 3000.0);
  EXPECT_EQ(camera.bitDepth, 14U);
  itk::EncapsulateMetaData(dictionary, sensornoise::MetaDataKeys::BitDepth, std::string("14"));
  EXPECT_EQ(sensornoise::CameraSettingsOf(dictionary).bitDepth, 0U);
}

TEST(SensorNoiseEstimatorCamera, MaskedPixelsDetermineTheOffset)
{
  sensornoise::CameraSettings camera;
  camera.opticalBlackDn = 100.25;
  camera.opticalBlackErrorDn = 0.5;
  const auto stack = StackOf(camera);
  const auto estimator = EstimatorOf<StackType>(stack.GetPointer());
  const auto given = EstimatorOf<StackType>(SimulatedStack());
  given->SetOffset(100.25);
  given->SetOffsetStandardError(0.5);
  JsonOf(estimator);
  JsonOf(given);
  EXPECT_EQ(estimator->GetReport().offset.value, 100.25);
  EXPECT_EQ(estimator->GetReport().readNoise.value, given->GetReport().readNoise.value);
  estimator->SetOffset(99.0);
  JsonOf(estimator);
  EXPECT_EQ(estimator->GetReport().offset.value, 99.0);
  estimator->SetOffset(std::numeric_limits<double>::quiet_NaN());
  estimator->SetMethod("published"); // which takes none
  JsonOf(estimator);
  EXPECT_NE(estimator->GetReport().offset.value, 100.25);
}

TEST(SensorNoiseEstimatorCamera, WithoutMetadataThereIsNoMember)
{
  const auto estimator = EstimatorOf<StackType>(SimulatedStack());
  EXPECT_EQ(JsonOf(estimator).find("\"camera\""), std::string::npos);
}
