// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/StackMethod.h"
#include "sensornoise/ReportText.h"
#include "sensornoise/Simulator.h"
#include "helpers/ReportTestHelper.h"
#include "helpers/StackTestHelper.h"

#include <algorithm>
#include <cstddef>
#include <gtest/gtest.h>
#include <string>
#include <tuple>
#include <vector>

// A stack whose frames do not show one scene, by both methods; and that the same frames, as they should be, do.

using namespace sensornoise;
using namespace sensornoise::test;

namespace
{
using GreyValue = unsigned short;
constexpr std::size_t Width = 160;
constexpr std::size_t Height = 128;

template <typename TMethod, typename TSettings>
Report
ReportBy(const Stack<GreyValue> & stack)
{
  TMethod method(TSettings{}, FrameGeometry{ stack.width, stack.height, 1 }, stack.frames);
  while (!method.IsDone())
  {
    method.AddFrames(stack.pixels.data(), stack.frames);
    method.EndPass();
  }
  return method.GetReport();
}

/** Returns the reports of the refined and of the published method. */
std::vector<Report>
ReportsOf(const Stack<GreyValue> & stack)
{
  return { ReportBy<RefinedMethod<GreyValue>, RefinedSettings>(stack),
           ReportBy<PublishedMethod<GreyValue>, PublishedSettings>(stack) };
}

/** Expects the change of the scene as the first warning, and no other error that names another cause. */
void
ExpectScenesChange(const Stack<GreyValue> & stack)
{
  for (const Report & report : ReportsOf(stack))
  {
    ASSERT_FALSE(report.warnings.empty()) << MakeText(report);
    EXPECT_EQ(report.warnings.front().code, WarningCode::SceneChanges) << MakeText(report);
    const std::string & text = report.warnings.front().message;
    EXPECT_EQ(text.rfind("the frames do not show one static scene: ", 0), 0U) << text;
    EXPECT_NE(
      text.find("the illumination is off in some frames (leave them out: --frames), or the bytes of each pixel are "
                "swapped (--raw WxH:uint16be)"),
      std::string::npos)
      << text;
    EXPECT_EQ(std::count_if(report.warnings.begin(),
                            report.warnings.end(),
                            [](const Warning & warning) { return KindOf(warning.code).severity == Severity::Error; }),
              1);
    EXPECT_FALSE(report.gain.value);
  }
}

void
ExpectOneScene(const Stack<GreyValue> & stack)
{
  for (const Report & report : ReportsOf(stack))
  {
    EXPECT_FALSE(HasWarning(report, WarningCode::SceneChanges)) << MakeText(report);
  }
}

/** Returns the pixels (t, y, x) as (y, x, t), or as (y, t, x). */
Stack<GreyValue>
WithTimeElsewhere(const Stack<GreyValue> & stack, bool isLast)
{
  Stack<GreyValue> other{ isLast ? stack.frames : stack.width, isLast ? stack.width : stack.frames, stack.height, {} };
  other.pixels.resize(stack.pixels.size());
  for (std::size_t t = 0; t < stack.frames; ++t)
  {
    for (std::size_t y = 0; y < stack.height; ++y)
    {
      for (std::size_t x = 0; x < stack.width; ++x)
      {
        const std::size_t p = isLast ? x * stack.frames + t : t * stack.width + x;
        other.pixels[y * stack.width * stack.frames + p] = stack.Frame(t)[y * stack.width + x];
      }
    }
  }
  return other;
}

SimulationSettings
SettingsOf(char camera, std::size_t frames)
{
  SimulationSettings settings;
  settings.camera = PaperCamera(camera);
  settings.conditions = PaperConditions(3);
  settings.frames = frames;
  return settings;
}
} // namespace

class SensorNoiseSceneChanges : public testing::TestWithParam<std::tuple<std::string, char, std::size_t>>
{};

TEST_P(SensorNoiseSceneChanges, TimeOnAnotherAxisIsSaid)
{
  const auto & [reference, camera, frames] = GetParam();
  const auto scene = reference == "target" ? MakeTargetScene(Width, Height) : MakeTextureScene(Width, Height);
  const Stack<GreyValue> stack = Simulate<GreyValue>(SettingsOf(camera, frames), Width, Height, scene);
  ExpectOneScene(stack);
  ExpectScenesChange(WithTimeElsewhere(stack, true));
  ExpectScenesChange(WithTimeElsewhere(stack, false));
}

INSTANTIATE_TEST_SUITE_P(Bursts,
                         SensorNoiseSceneChanges,
                         testing::Combine(testing::Values("target", "texture"),
                                          testing::Values('A', 'B', 'C'),
                                          testing::Values(20U, 50U, 100U)));

TEST(SensorNoiseSceneChanges, ScenesOfTheirOwnAreSaid)
{
  Stack<GreyValue> stack{ Width, Height, 20, {} };
  for (std::size_t t = 0; t < stack.frames; ++t)
  {
    const auto frame = Simulate<GreyValue>(SettingsOf('B', 1), Width, Height, MakeTextureScene(Width, Height, 50 + t));
    stack.pixels.insert(stack.pixels.end(), frame.pixels.begin(), frame.pixels.end());
  }
  ExpectScenesChange(stack);
}

TEST(SensorNoiseSceneChanges, ACameraThatMovesByManyPixelsIsSaid)
{
  // It pans over a scene that is larger: by 6 pixels a frame.
  constexpr std::size_t travel = 6;
  constexpr std::size_t frames = 30;
  constexpr std::size_t width = Width + travel * frames;
  const auto            wide = MakeTextureScene(width, Height);
  const auto            unmoved = Simulate<GreyValue>(SettingsOf('B', frames), width, Height, wide);
  Stack<GreyValue>      stack{ Width, Height, frames, {} };
  for (std::size_t t = 0; t < frames; ++t)
  {
    for (std::size_t y = 0; y < Height; ++y)
    {
      const GreyValue * const first = unmoved.Frame(t) + y * width + travel * t;
      stack.pixels.insert(stack.pixels.end(), first, first + Width);
    }
  }
  ExpectScenesChange(stack);
}

TEST(SensorNoiseSceneChanges, VibrationAndARollingShutterAreNone)
{
  for (const double shift : { 0.3, 1.0, 2.0 })
  {
    SimulationSettings settings = SettingsOf('B', 30);
    settings.conditions.vibrationSdXPixels = settings.conditions.vibrationSdYPixels = shift;
    ExpectOneScene(Simulate<GreyValue>(settings, Width, Height, MakeTextureScene(Width, Height)));
  }
  for (const double period : { 40.0, 200.0 })
  {
    SimulationSettings settings = SettingsOf('B', 30);
    settings.rollingShutterPeriodRows = period;
    ExpectOneScene(Simulate<GreyValue>(settings, Width, Height, MakeFlatScene(Width, Height)));
    ExpectOneScene(Simulate<GreyValue>(settings, Width, Height));
  }
}
