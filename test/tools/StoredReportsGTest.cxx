// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/FrameGeometry.h"
#include "moments/DarkFrames.h"
#include "sensornoise/Settings.h"
#include "moments/TemporalMoments.h"
#include "sensornoise/StackMethod.h"
#include "sensornoise/Report.h"
#include "sensornoise/ReportText.h"
#include "sensornoise/Simulator.h"
#include "sensornoise/SimulationSettings.h"
#include "helpers/CheckoutTestHelper.h"
#include "helpers/StackTestHelper.h"
#include "helpers/StoredReportTestHelper.h"

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <gtest/gtest.h>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

// Whole reports of small simulated stacks, as test/reports/*.json has them: what no other test looks at cannot change
// unnoticed. A file has the name of its case. To write them anew, and then read what changed with git diff:
//
//   SENSORNOISE_WRITE_REPORTS=1 build/bin/SensorNoiseToolTests --gtest_filter='*StoredReports*'
//
// Numbers agree to 1e-9 of themselves, zeros and text exactly, messages but for the numbers in them, which are rounded
// to a few digits. No number has an absolute tolerance: those that are differences (flicker, shifts, intercepts) are
// far enough from 0 here. Built with and without fused multiply-add, which rounds differently, the reports agree to
// 3e-11.
//
// Not stored: the version, which changes without the numbers, and, to keep the files short, all but every 16th bin of
// `scatter` and every 16th row of `flicker_rows`.

using namespace sensornoise;
using namespace sensornoise::test;
using nlohmann::json;

namespace
{
constexpr std::size_t       Width = 96;
constexpr std::size_t       Height = 80;
constexpr std::size_t       Frames = 30;
const std::filesystem::path Folder = SourceFolder() + "/test/reports";

SimulationSettings
SettingsOf(char camera, int condition)
{
  SimulationSettings settings;
  settings.camera = PaperCamera(camera);
  settings.conditions = PaperConditions(condition);
  settings.frames = Frames;
  settings.seed = 7;
  return settings;
}

template <typename TPixel>
Stack<TPixel>
SimulateTarget(const SimulationSettings & settings)
{
  return Simulate<TPixel>(settings, Width, Height, MakeTargetScene(Width, Height));
}

template <typename TPixel>
Stack<TPixel>
SimulateTexture(const SimulationSettings & settings)
{
  return Simulate<TPixel>(settings, Width, Height, MakeTextureScene(Width, Height));
}

/** Every row holds dark and bright, so that the flicker of each is known. */
template <typename TPixel>
Stack<TPixel>
SimulateBars(const SimulationSettings & settings)
{
  return Simulate<TPixel>(settings, Width, Height, MakeBarsScene(Width, Height));
}

template <typename TPixel>
Stack<TPixel>
MakeFlat(TPixel value)
{
  return { Width, Height, Frames, std::vector<TPixel>(Width * Height * Frames, value) };
}

template <template <typename> class TMethod, typename TPixel, typename TSettings>
std::string
Measure(const Stack<TPixel> & stack, const TSettings & settings)
{
  TMethod<TPixel> method(settings, FrameGeometry{ Width, Height, 1 }, Frames);
  while (!method.IsDone())
  {
    method.AddFrames(stack.Frame(0), Frames);
    method.EndPass();
  }
  return ToJson(method.GetReport());
}

template <typename TPixel>
std::string
Refined(const Stack<TPixel> & stack, const RefinedSettings & settings = {})
{
  return Measure<RefinedMethod>(stack, settings);
}

template <typename TPixel>
std::string
Published(const Stack<TPixel> & stack, const PublishedSettings & settings = {})
{
  return Measure<PublishedMethod>(stack, settings);
}

/** Returns camera C behind a converter of 8 bits: the quantization step is 16 times as wide. */
SimulationSettings
EightBits(int condition)
{
  SimulationSettings settings = SettingsOf('C', condition);
  settings.camera.gainDnPerElectron /= 16.0;
  settings.camera.offsetDn /= 16.0;
  settings.camera.readNoiseDn /= 16.0;
  settings.bitDepth = 8;
  return settings;
}

SimulationSettings
WithPulsedIllumination(SimulationSettings settings, double periodRows)
{
  settings.rollingShutterPeriodRows = periodRows;
  return settings;
}

/** Returns the results of 12 dark frames of the camera of \a settings. */
KnownOffset
MeasureDark(SimulationSettings settings)
{
  settings.camera.electrons = 1e-9;
  settings.conditions = { 0.0, 0.0, 0.0 };
  settings.frames = 12;
  const Stack<float>     stack = SimulateTarget<float>(settings);
  constexpr std::size_t  pixels = Width * Height;
  TemporalMoments<float> moments(pixels);
  moments.AddFrames(stack.Frame(0), pixels, stack.frames, 0, pixels);
  moments.AdvanceFrames(stack.frames);
  return MeasureDarkFrames<float>(std::move(moments));
}

std::string
RefinedWithDarkFrames()
{
  RefinedSettings settings;
  settings.offset = MeasureDark(SettingsOf('A', 1));
  return Refined(SimulateTarget<float>(SettingsOf('A', 1)), settings);
}

std::string
RefinedWithKnownOffset()
{
  RefinedSettings settings;
  settings.offset = KnownOffset{ 40.0, 0.1 };
  return Refined(SimulateTexture<short>(SettingsOf('C', 2)), settings);
}

/** The cases by name, each a report as JSON. */
const std::map<std::string, std::function<std::string()>> &
Cases()
{
  static const std::map<std::string, std::function<std::string()>> cases = {
    { "RefinedTarget", [] { return Refined(SimulateTarget<unsigned short>(SettingsOf('B', 3))); } },
    { "RefinedTextureOfBytes", [] { return Refined(SimulateTexture<unsigned char>(EightBits(1))); } },
    { "RefinedKnownOffset", RefinedWithKnownOffset },
    { "RefinedDarkFrames", RefinedWithDarkFrames },
    { "RefinedRollingShutter",
      [] { return Refined(SimulateTarget<unsigned short>(WithPulsedIllumination(SettingsOf('B', 3), 40.0))); } },
    { "RefinedFlat", [] { return Refined(MakeFlat<short>(-3)); } },
    { "PublishedTarget", [] { return Published(SimulateTarget<unsigned short>(SettingsOf('B', 1))); } },
    { "PublishedTextureOfBytes", [] { return Published(SimulateTexture<unsigned char>(EightBits(3))); } },
    { "PublishedRollingShutter",
      [] { return Published(SimulateBars<float>(WithPulsedIllumination(SettingsOf('A', 1), 40.0))); } },
    { "PublishedFlat", [] { return Published(MakeFlat<unsigned char>(255)); } },
  };
  return cases;
}

std::filesystem::path
PathOf(const std::string & name)
{
  return Folder / (name + ".json");
}

json
ReadStored(const std::string & name)
{
  std::ifstream file(PathOf(name));
  EXPECT_TRUE(file) << PathOf(name) << " cannot be read";
  return json::parse(file, nullptr, false);
}

bool
IsToBeWritten()
{
  return std::getenv("SENSORNOISE_WRITE_REPORTS") != nullptr;
}

std::vector<std::string>
NamesOfCases()
{
  std::vector<std::string> names;
  for (const auto & item : Cases())
  {
    names.push_back(item.first);
  }
  return names;
}

class StoredReports : public ::testing::TestWithParam<std::string>
{};
} // namespace

TEST_P(StoredReports, IsWhatIsFound)
{
  const json found = StoredPartOf(Cases().at(GetParam())());
  if (IsToBeWritten())
  {
    std::ofstream file(PathOf(GetParam()));
    file << found.dump(1) << '\n';
    EXPECT_TRUE(file.flush()) << PathOf(GetParam()) << " cannot be written";
    return;
  }
  EXPECT_EQ(DifferencesOf(ReadStored(GetParam()), found), "");
}

TEST_P(StoredReports, NothingInItMayChange)
{
  const json stored = ReadStored(GetParam());
  EXPECT_EQ(DifferencesOf(stored, stored), "");
  const json leaves = stored.flatten();
  for (const auto & leaf : leaves.items())
  {
    json changed = stored;
    changed[json::json_pointer(leaf.key())] = Changed(leaf.key(), leaf.value());
    EXPECT_NE(DifferencesOf(stored, changed), "") << leaf.key();
  }
  json longer = stored;
  longer["warnings"].push_back(nullptr);
  EXPECT_NE(DifferencesOf(stored, longer), "");
  json renamed = stored;
  renamed["gains"] = renamed["gain"];
  renamed.erase("gain");
  EXPECT_NE(DifferencesOf(stored, renamed), "");
}

INSTANTIATE_TEST_SUITE_P(All, StoredReports, ::testing::ValuesIn(NamesOfCases()), [](const auto & instance) {
  return instance.param;
});

TEST(StoredReportsFolder, HasOneFilePerCase)
{
  if (IsToBeWritten())
  {
    GTEST_SKIP() << "the files are being written";
  }
  std::vector<std::string> names;
  for (const auto & entry : std::filesystem::directory_iterator(Folder))
  {
    if (entry.path().extension() == ".json")
    {
      names.push_back(entry.path().stem().string());
    }
  }
  std::sort(names.begin(), names.end());
  EXPECT_EQ(names, NamesOfCases());
}
