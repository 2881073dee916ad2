// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/Simulator.h"
#include "itkSensorNoiseSceneSource.h"

#include <gtest/gtest.h>
#include <string>
#include <vector>

namespace
{
using SourceType = itk::SensorNoiseSceneSource<>;

SourceType::Pointer
SourceOf(const std::string & scene, itk::SizeValueType width, itk::SizeValueType height)
{
  auto source = SourceType::New();
  source->SetScene(scene);
  source->SetWidth(width);
  source->SetHeight(height);
  return source;
}

std::vector<double>
ValuesOf(SourceType * source)
{
  source->Update();
  const auto * image = source->GetOutput();
  return { image->GetBufferPointer(),
           image->GetBufferPointer() + image->GetLargestPossibleRegion().GetNumberOfPixels() };
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
} // namespace

// The scenes are the module's; rows are not as long as columns, so that a swap would show.
TEST(SensorNoiseSceneSource, DrawsTheScenesOfTheModule)
{
  EXPECT_EQ(ValuesOf(SourceOf("target", 64, 48)), sensornoise::MakeTargetScene(64, 48));
  EXPECT_EQ(ValuesOf(SourceOf("bars", 64, 48)), sensornoise::MakeBarsScene(64, 48));
  EXPECT_EQ(ValuesOf(SourceOf("texture", 64, 48)), sensornoise::MakeTextureScene(64, 48));
  EXPECT_EQ(ValuesOf(SourceOf("flat", 64, 48)), sensornoise::MakeFlatScene(64, 48));
  EXPECT_EQ(SourceType::New()->GetScene(), std::string("target"));
}

TEST(SensorNoiseSceneSource, AnyRequestGivesTheWholeScene)
{
  const auto source = SourceOf("target", 64, 48);
  source->UpdateOutputInformation();
  source->GetOutput()->SetRequestedRegion(itk::ImageRegion<2>({ { 5, 6 } }, { { 7, 8 } }));
  source->GetOutput()->Update();
  EXPECT_EQ(source->GetOutput()->GetBufferedRegion().GetNumberOfPixels(), 64u * 48u);
}

TEST(SensorNoiseSceneSource, WrongUseIsRefusedWithWhatWasFound)
{
  const std::string unknown = ErrorOf(SourceOf("boat", 64, 48));
  EXPECT_NE(unknown.find("\"boat\""), std::string::npos) << unknown;
  EXPECT_NE(unknown.find("target, bars, texture or flat"), std::string::npos) << unknown;
  const std::string small = ErrorOf(SourceOf("target", 8, 48));
  EXPECT_NE(small.find("8"), std::string::npos) << small;
  EXPECT_NE(small.find("32"), std::string::npos) << small;
}
