// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "itkEmva1288Evaluator.h"

#include "helpers/EmvaTestHelper.h"
#include "helpers/PipelineTestHelper.h"

#include <algorithm>
#include <cstddef>
#include <gtest/gtest.h>
#include <string>
#include <vector>

namespace
{
using namespace sensornoisetest;
using namespace sensornoise;
using StackType = itk::Image<unsigned short, 3>;
using EvaluatorType = itk::Emva1288Evaluator<StackType>;

constexpr std::size_t Size = 40;
constexpr std::size_t Levels = 6;
constexpr double      Darkness = 1e-9;        // factor of the illumination of dark frames: the simulation refuses 0
constexpr double      PhotonsOfUnit = 1000.0; // photons at the exposure 1

/** Frames of the levels of a simulated flat field; level 0: dark frames. */
std::vector<unsigned short>
FramesOf(std::size_t level, std::size_t frames)
{
  SimulationSettings settings = test::emva::SteadySettings(7 + level);
  settings.illumination.shape = IlluminationShape::Factors;
  settings.illumination.factors.assign(frames, std::max(Darkness, static_cast<double>(level) / Levels));
  settings.frames = frames;
  const StackSimulator        simulator(MakeFlatScene(Size, Size), Size, Size, settings);
  std::vector<unsigned short> pixels(Size * Size * frames);
  for (std::size_t t = 0; t < frames; ++t)
  {
    simulator.RenderFrame(t, pixels.data() + t * Size * Size);
  }
  return pixels;
}

/** Returns an image of these frames, the first one at index (-2, 5, 7). */
StackType::Pointer
StackOf(const std::vector<unsigned short> & pixels)
{
  auto image = StackType::New();
  image->SetRegions(StackType::RegionType({ { -2, 5, 7 } }, { { Size, Size, pixels.size() / (Size * Size) } }));
  image->Allocate();
  std::copy(pixels.begin(), pixels.end(), image->GetBufferPointer());
  return image;
}

EvaluatorType::Pointer
Evaluated(unsigned int workUnits = 0)
{
  auto evaluator = EvaluatorType::New();
  evaluator->SetNumberOfWorkUnits(workUnits);
  evaluator->SetBitDepth(12);
  evaluator->SetQuantisationStep(2.0);
  evaluator->SetExposureUnit("s");
  evaluator->AddDarkFrames(StackOf(FramesOf(0, 4)), 0.0);
  for (std::size_t level = 1; level <= Levels; ++level)
  {
    const auto exposure = static_cast<double>(level);
    evaluator->AddFlatFrames(StackOf(FramesOf(level, 2)), exposure, PhotonsOfUnit * exposure);
  }
  evaluator->Evaluate();
  return evaluator;
}
} // namespace

TEST(Emva1288Evaluator, HasTheBitsOfTheLibrary)
{
  std::vector<EmvaSeries> all;
  for (std::size_t level = 0; level <= Levels; ++level)
  {
    const std::vector<unsigned short> pixels = FramesOf(level, level == 0 ? 4 : 2);
    EmvaSeriesSums                    sums(Size, Size);
    for (std::size_t at = 0; at < pixels.size(); at += Size * Size)
    {
      sums.AddFrame(pixels.data() + at);
    }
    EmvaSeries series = sums.Measure();
    series.exposure = static_cast<double>(level);
    series.photons = PhotonsOfUnit * series.exposure;
    series.isDark = level == 0;
    all.push_back(series);
  }
  const EmvaReport expected = EvaluateEmva1288(all, { 2.0, 12, "s" });
  for (const unsigned int workUnits : { 1U, 5U })
  {
    const auto evaluator = Evaluated(workUnits);
    EXPECT_EQ(evaluator->GetNumberOfSeries(), Levels + 1);
    EXPECT_EQ(evaluator->GetReportAsJson(), ToJson(expected));
    EXPECT_EQ(evaluator->GetReportAsText(), MakeTable(expected));
    EXPECT_EQ(evaluator->GetReportAsXml(), ToXml(expected));
  }
  EXPECT_TRUE(expected.quantumEfficiency.value.has_value());
}

TEST(Emva1288Evaluator, WithoutPhotonsTheyAreUnknown)
{
  const auto evaluator = EvaluatorType::New();
  evaluator->AddDarkFrames(StackOf(FramesOf(0, 2)), 0.0);
  for (std::size_t level = 1; level <= Levels; ++level)
  {
    evaluator->AddFlatFrames(StackOf(FramesOf(level, 2)), static_cast<double>(level));
  }
  evaluator->Evaluate();
  EXPECT_FALSE(evaluator->GetReport().quantumEfficiency.value.has_value());
  EXPECT_TRUE(evaluator->GetReport().gain.value.has_value());
}

TEST(Emva1288Evaluator, ErrorsAreOfItkAndAddNothing)
{
  const auto evaluator = EvaluatorType::New();
  EXPECT_SAYS(ErrorWhen([&] { evaluator->GetReportAsJson(); }), "Evaluate() comes first");
  EXPECT_SAYS(ErrorWhen([&] { evaluator->Evaluate(); }), "there is no series");
  EXPECT_SAYS(ErrorWhen([&] { evaluator->AddFlatFrames(nullptr, 1.0); }), "there are no frames");
  EXPECT_SAYS(ErrorWhen([&] { evaluator->AddFlatFrames(StackOf(FramesOf(1, 1)), 1.0); }), "a series has 1 frame");
  const auto withoutPixels = StackType::New();
  withoutPixels->SetRegions(StackType::SizeType{ { Size, Size, 2 } });
  EXPECT_SAYS(ErrorWhen([&] { evaluator->AddDarkFrames(withoutPixels, 1.0); }), "has a size but no pixels");
  EXPECT_EQ(evaluator->GetNumberOfSeries(), 0U);
}

TEST(Emva1288Evaluator, FramesThatAreAddedLaterNeedAnEvaluation)
{
  const auto evaluator = Evaluated();
  evaluator->AddDarkFrames(StackOf(FramesOf(0, 2)), 3.0);
  EXPECT_SAYS(ErrorWhen([&] { evaluator->GetReport(); }), "Evaluate() comes first");
}
