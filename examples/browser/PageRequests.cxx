// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
// The functions of the library that the page calls. Each request and each answer is a JSON record; see Answers().

#include "base/FreeMemory.h"
#include "base/Text.h"
#include "browser/BurstEstimate.h"
#include "browser/BurstMemory.h"
#include "browser/GainPlan.h"
#include "browser/ToolArguments.h"
#include "itkSensorNoiseFrameFiles.h"
#include "sensornoise/NoiseExport.h"
#include "sensornoise/ReportPage.h"
#include "sensornoise/ReportText.h"
#include "sensornoise/Simulator.h"
#include "sensornoise/Version.h"
#include "tools/ErrorSentence.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <variant>
#include <vector>

// Reports the progress to the page: the number of the pass, from 0, and the fraction of it that is done. Other
// compilers than Emscripten only check this file.
#if defined(__EMSCRIPTEN__)
#  include <emscripten.h>
EM_JS(void, ReportProgress, (unsigned int pass, double fraction), { Module["onProgress"](pass, fraction); });
#else
extern "C" void
ReportProgress(unsigned int pass, double fraction);
#endif

namespace
{
using nlohmann::json;
using namespace sensornoise;
using namespace sensornoise::browser;

std::vector<std::string>
NamesIn(const json & request, const char * member)
{
  return request.value(member, std::vector<std::string>());
}

FrameList
OpenList(const json & request, const char * member)
{
  FrameChoice choice;
  for (const auto & [name, chosen] : { std::pair{ "channel", &choice.channel }, std::pair{ "plane", &choice.plane } })
  {
    if (request.contains(name) && request[name].is_number_unsigned())
    {
      *chosen = request[name].get<std::size_t>();
    }
  }
  return OpenFrames(NamesIn(request, member), {}, request.value("raw", std::string()), choice);
}

Burst
BurstOf(FrameList list)
{
  Burst burst;
  burst.pixel = list.pixel;
  burst.geometry.width = list.width;
  burst.geometry.height = list.height;
  burst.frames = list.frames;
  burst.camera = list.camera;
  burst.read = [files = std::make_shared<FrameList>(std::move(list))](
                 std::size_t first, std::size_t count, void * buffer) { ReadFrames(*files, first, count, buffer); };
  return burst;
}

BurstOptions
OptionsIn(const json & request)
{
  BurstOptions options;
  options.method = request.value("method", options.method);
  options.bayer = request.value("bayer", options.bayer);
  options.bitDepth = request.value("bit_depth", options.bitDepth);
  if (request.contains("offset") && request["offset"].is_number())
  {
    options.offsetDn = request["offset"].get<double>();
  }
  return options;
}

Burst
WithArguments(Burst burst, const json & request)
{
  burst.arguments = ArgumentsOfTool(
    { NamesIn(request, "files"), NamesIn(request, "dark"), request.value("raw", std::string()), OptionsIn(request) });
  return burst;
}

json
AnswerOf(const BurstResult & result, const Burst & burst, const PageTitle & title)
{
  const bool hasMaps = !result.mean.empty() && result.mean.size() == result.pixelUse.size();
  const auto maps =
    hasMaps ? PageMaps{ burst.geometry.width, burst.geometry.height, result.mean.data(), result.pixelUse.data() }
            : PageMaps{};
  return std::visit(
    [&](const auto & report) {
      return json{ { "json", ToJson(report) },
                   { "html", ToHtml(report, maps, title) },
                   { "text", MakeText(report) },
                   { "usable", report.IsUsable() } };
    },
    result.reports);
}

PageTitle
TitleIn(const json & request)
{
  return { request.value("title", std::string()), request.value("date", std::string()) };
}

/** Returns the camera settings that the files record, for example "Maker Model 5, GBRG, 14 bits, black level 100 DN";
 * "": the files record none. */
std::string
DescribeCamera(const CameraSettings & camera)
{
  std::string text;
  const auto  add = [&text](const std::string & part) { text += (text.empty() || part.empty() ? "" : ", ") + part; };
  const auto  addLevel = [&add](const std::string & name, double levelDn) {
    add(std::isfinite(levelDn) ? name + " level " + ShortestText(levelDn) + " DN" : "");
  };
  add(camera.camera);
  add(camera.bayerPattern);
  add(camera.bitDepth > 0 ? std::to_string(camera.bitDepth) + " bits" : "");
  addLevel("black", camera.blackLevelDn);
  addLevel("white", camera.whiteLevelDn);
  return text;
}

json
Inspect(const json & request)
{
  const FrameList list = OpenList(request, "files");
  const Burst     burst = WithArguments(BurstOf(list), request);
  const double    need = MemoryNeedOf(burst, OptionsIn(request));
  json            answer{ { "frames", list.frames },
                          { "frame", DescribeFrame(list) },
                          { "size", TextOfBytes(static_cast<double>(list.bytes)) },
                          { "camera", DescribeCamera(list.camera) },
                          { "warning", WarningOf(list) },
                          { "memory", TextOfBytes(need) },
                          { "memory_bytes", need } };
  RequirePageMemory(burst, OptionsIn(request));
  return answer;
}

json
Estimate(const json & request)
{
  const Burst          burst = WithArguments(BurstOf(OpenList(request, "files")), request);
  std::optional<Burst> dark;
  if (!NamesIn(request, "dark").empty())
  {
    dark = BurstOf(OpenList(request, "dark"));
    if (dark->pixel != burst.pixel || dark->geometry.width != burst.geometry.width ||
        dark->geometry.height != burst.geometry.height)
    {
      throw std::runtime_error(
        "the dark frames have another size or type of pixels than the frames; record dark frames "
        "with the settings of the frames");
    }
  }
  return AnswerOf(
    EstimateBurst(burst, dark ? &*dark : nullptr, OptionsIn(request), ReportProgress), burst, TitleIn(request));
}

/** Measures a burst of the simulator: camera B under condition 3, its defaults. */
json
Example(const json & request)
{
  constexpr std::size_t width = 256;
  constexpr std::size_t height = 192;
  SimulationSettings    settings;
  settings.frames = 60;
  settings.seed = request.value("seed", settings.seed);
  const StackSimulator simulator(MakeTargetScene(width, height), width, height, settings);
  Burst                burst;
  burst.geometry.width = width;
  burst.geometry.height = height;
  burst.frames = settings.frames;
  burst.read = [&simulator](std::size_t first, std::size_t count, void * buffer) {
    for (std::size_t i = 0; i < count; ++i)
    {
      simulator.RenderFrame(first + i, static_cast<unsigned short *>(buffer) + i * width * height);
    }
  };
  json answer = AnswerOf(
    EstimateBurst(burst, nullptr, OptionsIn(request), ReportProgress), burst, { "a simulated burst", std::string() });
  const CameraModel & camera = settings.camera;
  answer["truth"] = { { "gain", camera.gainDnPerElectron },
                      { "offset", camera.offsetDn },
                      { "read_noise", camera.readNoiseDn } };
  return answer;
}

json
Formats()
{
  json formats = json::array();
  for (const ExportFormat & format : ExportFormats())
  {
    if (format.leastReports == 1 && format.takes != ExportTakes::Maps)
    {
      formats.push_back({ { "name", format.name }, { "consumer", format.consumer } });
    }
  }
  return { { "formats", formats }, { "version", GetModuleVersion() }, { "limit", TextOfBytes(PageMemoryBytes) } };
}

/** Writes a report in the format of another program, into the folder "out" of the file system in memory. */
json
Export(const json & request)
{
  StoredReport stored;
  stored.name = "report.json";
  const json flat = json::parse(request.at("report").get<std::string>()).flatten();
  for (const auto & [pointer, value] : flat.items())
  {
    if (value.is_number())
    {
      stored.numbers[pointer] = value.get<double>();
    }
    else if (value.is_string())
    {
      stored.texts[pointer] = value.get<std::string>();
    }
  }
  const NoiseExport made = ExportNoise(request.at("format").get<std::string>(), { ReadCameraNoise(stored) });
  json              names = json::array();
  for (const ExportedFile & file : made.files)
  {
    std::ofstream out(request.at("folder").get<std::string>() + "/" + file.name, std::ios::binary);
    if (!(out << file.bytes << std::flush))
    {
      throw std::runtime_error("the export cannot be kept in memory; expected a page with more memory");
    }
    names.push_back(file.name);
  }
  return { { "files", names }, { "note", made.note } };
}

json
Plan(const json & request)
{
  PlannedBurst burst;
  burst.megapixels = request.at("megapixels").get<double>();
  burst.frames = request.at("frames").get<double>();
  burst.electrons = request.at("electrons").get<double>();
  burst.contrast = request.at("contrast").get<double>();
  burst.flickerSd = request.at("flicker").get<double>();
  burst.gainDnPerElectron = request.at("gain").get<double>();
  burst.readNoiseDn = request.at("read_noise").get<double>();
  const GainPlan plan = PlanBurst(burst);
  return { { "gain_percent", plan.gainPercent },
           { "offset_dn", plan.offsetDn },
           { "frames_for_gain", plan.framesForGain },
           { "frames_for_offset", plan.framesForOffset },
           { "contrast_for_gain", plan.contrastForGain },
           { "contrast_for_offset", plan.contrastForOffset },
           { "flicker_for_offset", plan.flickerForOffset },
           { "most_contrast", MostContrast },
           { "most_flicker", MostFlickerSd } };
}

/** Answers the request {"what": "inspect", "estimate", "example", "formats", "export" or "plan", ...}. Infinite numbers
 * are null. */
json
AnswerTo(const json & request)
{
  const auto what = request.at("what").get<std::string>();
  if (what == "inspect")
  {
    return Inspect(request);
  }
  if (what == "estimate")
  {
    return Estimate(request);
  }
  if (what == "example")
  {
    return Example(request);
  }
  if (what == "formats")
  {
    return Formats();
  }
  if (what == "export")
  {
    return Export(request);
  }
  if (what == "plan")
  {
    return Plan(request);
  }
  throw std::invalid_argument("the request is \"" + what + "\"; expected one that the page has");
}
} // namespace

/** Returns the answer to a request of the page as a JSON record; {"error": sentence} if the request fails. The text is
 * valid until the next call. */
extern "C" const char *
AnswerPage(const char * request)
{
  static std::string text;
  json               answer;
  try
  {
    answer = AnswerTo(json::parse(request));
  }
  catch (const std::exception & error)
  {
    answer = { { "error", tools::SentenceOf(error) } };
  }
  text = answer.dump(-1, ' ', false, json::error_handler_t::replace);
  return text.c_str();
}
