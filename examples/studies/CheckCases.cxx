// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
// Measures how often the check of a noise model is right. A report is compared with another burst of the same camera,
// once unchanged and once with a slope that is 5 % too steep. The first comparison should fit, the second should not.

#include "sensornoise/NoiseModel.h"
#include "sensornoise/SimulationSettings.h"
#include "sensornoise/Simulator.h"
#include "studies/MeasuredStack.h"
#include "studies/RenderedStack.h"
#include "studies/StudyCase.h"

#include <string>
#include <vector>

namespace sensornoise::tools
{
namespace
{
constexpr std::size_t   CheckedSize = 256; // [pixels]
constexpr std::size_t   CheckedFrames = 60;
constexpr double        WrongSlope = 1.05;
constexpr std::uint64_t OtherBurst = 500; // added to the seed of the report's burst

Report
MeasureBurst(char camera, int condition, const std::string & scene, const StudyOptions & options, std::uint64_t seed)
{
  SimulationSettings settings;
  settings.camera = PaperCamera(camera);
  settings.conditions = PaperConditions(condition);
  settings.frames = options.frames.value_or(CheckedFrames);
  settings.seed = seed;
  const std::size_t    size = options.size.value_or(CheckedSize);
  const auto           reference = scene == "target" ? MakeTargetScene(size, size) : MakeTextureScene(size, size);
  const StackSimulator simulator(reference, size, size, settings);
  return MeasureBy("refined", RenderStack(simulator, size, size, settings.frames), { size, size, 1 }, settings.frames)
    .report;
}

std::vector<nlohmann::ordered_json>
MeasureCase(char camera, int condition, const std::string & scene, const StudyOptions & options, std::uint64_t seed)
{
  const Report report = MeasureBurst(camera, condition, scene, options, seed);
  if (!report.varianceSlope.value || !report.totalIntercept.value)
  {
    return { { { "has_model", false } } };
  }
  const Report           other = MeasureBurst(camera, condition, scene, options, seed + OtherBurst);
  const NoiseModelCheck  check = CheckReport(other, report);
  nlohmann::ordered_json ratios = nlohmann::ordered_json::array();
  for (const NoiseModelCheck::Band & band : check.bands)
  {
    ratios.push_back(band.ratio ? nlohmann::ordered_json(*band.ratio) : nlohmann::ordered_json());
  }
  Report wrong = report;
  *wrong.varianceSlope.value *= WrongSlope;
  return { { { "has_model", true },
             { "verdict", NameOf(check.verdict) },
             { "verdict_of_wrong_slope", NameOf(CheckReport(other, wrong).verdict) },
             { "variance_over_model", ratios } } };
}
} // namespace

void
AppendCheckCases(std::vector<StudyCase> & cases)
{
  for (const char camera : { 'A', 'B', 'C' })
  {
    for (const int condition : { 1, 2, 3 })
    {
      for (const char * scene : { "target", "texture" })
      {
        cases.push_back({ std::string("check/") + camera + std::to_string(condition) + '/' + scene,
                          "noise model against another burst of its camera",
                          [=](const StudyOptions & options, std::uint64_t seed) {
                            return MeasureCase(camera, condition, scene, options, seed);
                          } });
      }
    }
  }
}

} // namespace sensornoise::tools
