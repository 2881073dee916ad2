// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "limits/CramerRaoBound.h"
#include "mosaic/MosaicGeometry.h"
#include "sensornoise/ChannelReports.h"
#include "sensornoise/FrameGeometry.h"
#include "sensornoise/MosaicMethod.h"
#include "sensornoise/SimulationSettings.h"
#include "sensornoise/Simulator.h"
#include "studies/MeasuredStack.h"
#include "studies/RenderedStack.h"
#include "studies/StudyCase.h"

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

namespace sensornoise::tools
{
namespace
{
using Record = nlohmann::ordered_json;

constexpr std::size_t EfficiencySize = 512; // [pixels]
constexpr std::size_t EfficiencyFrames = 100;

/** A reference image. */
struct Scene
{
  std::size_t         width;
  std::size_t         height;
  std::vector<double> values;
};

Scene
MakeScene(const std::string & name, const StudyOptions & options)
{
  const std::size_t size = options.size.value_or(EfficiencySize);
  return { size,
           size,
           name == "target"    ? MakeTargetScene(size, size, options.sceneSeed)
           : name == "texture" ? MakeTextureScene(size, size, options.sceneSeed)
                               : MakeBarsScene(size, size) };
}

SimulationSettings
MakeSettings(const std::string & experiment, const StudyOptions & options, std::uint64_t seed)
{
  SimulationSettings settings;
  CameraModel &      camera = settings.camera;
  camera = PaperCamera(experiment[0]);
  camera.gainDnPerElectron = options.gain.value_or(camera.gainDnPerElectron);
  camera.offsetDn = options.offset.value_or(camera.offsetDn);
  camera.readNoiseDn = options.readNoise.value_or(camera.readNoiseDn);
  camera.electrons = options.electrons.value_or(camera.electrons);
  SceneConditions & conditions = settings.conditions;
  conditions = PaperConditions(experiment[1] - '0');
  conditions.flickerSd = options.flickerSd.value_or(conditions.flickerSd);
  if (!options.vibrationSd.empty())
  {
    conditions.vibrationSdXPixels = options.vibrationSd[0];
    conditions.vibrationSdYPixels = options.vibrationSd[1];
  }
  if (!options.clip.empty())
  {
    settings.clipLowDn = options.clip[0];
    settings.clipHighDn = options.clip[1];
  }
  if (options.bayer != "none")
  {
    settings.flaws.filters.pattern = BayerPatternOf(options.bayer);
  }
  settings.rollingShutterPeriodRows = options.rollingShutterPeriod;
  settings.frames = options.frames.value_or(EfficiencyFrames);
  settings.seed = seed;
  return settings;
}

/** Returns the expected electrons of the static scene after optical blur, without flicker (gamma = 0) [e-]. */
std::vector<double>
ElectronsAtRest(const Scene & scene, SimulationSettings settings)
{
  settings.conditions = { 0.0, 0.0, 0.0 };
  settings.rollingShutterPeriodRows = 0.0;
  settings.frames = 1;
  const StackSimulator simulator(scene.values, scene.width, scene.height, settings);
  std::vector<double>  electrons(scene.values.size());
  for (std::size_t y = 0; y < scene.height; ++y)
  {
    simulator.ExpectedElectronsRow(0, y, electrons.data() + y * scene.width);
  }
  return electrons;
}

/** Returns the closed forms of the limit for pixels with these expected electrons. */
PrecisionLimit
ClosedLimit(const CramerRaoInput & input)
{
  const CameraModel & camera = input.truth->settings.camera;
  std::vector<double> meanDn;
  for (std::size_t p = 0; p < input.width * input.height; ++p)
  {
    meanDn.push_back(camera.offsetDn + input.MeanFluxPerElectronDn() * input.electrons[p]);
  }
  return ComputePrecisionLimit({ meanDn.data(),
                                 input.mask,
                                 input.width,
                                 input.height,
                                 camera.gainDnPerElectron,
                                 camera.offsetDn,
                                 input.TotalReadVarianceDn2(),
                                 input.quantisationStepDn,
                                 input.truth->settings.frames,
                                 input.truth->realisedFlickerSd });
}

/** Returns 1 for the pixels of the bound: pixels that clipping does not affect, and that are finite, not masked and
 * not at the border. Pixels that the method leaves out for other reasons count as a loss of the method. */
std::vector<std::uint8_t>
MaskOfUnclipped(const std::vector<std::uint8_t> & use, std::size_t pixels)
{
  std::vector<std::uint8_t> mask(pixels, 1);
  for (std::size_t p = 0; p < use.size(); ++p)
  {
    const auto pixelUse = static_cast<PixelUse>(use[p]);
    mask[p] = pixelUse == PixelUse::Clipped || pixelUse == PixelUse::NotFinite || pixelUse == PixelUse::Masked ||
                  pixelUse == PixelUse::NearClip || pixelUse == PixelUse::Border
                ? 0
                : 1;
  }
  return mask;
}

/** Returns the true values of the quantities of a report, and their limits: the smallest standard deviations of
 * unbiased estimates. \a pixelSize is the size of a pixel of the report in pixels of the simulated frames: 2 for a
 * channel of a mosaic. */
Record
MakeRecord(const MeasuredStack & measured, const CramerRaoInput & input, bool isFullBound, double pixelSize)
{
  const SimulationTruth & truth = *input.truth;
  const PrecisionLimit    closed = ClosedLimit(input);
  const PrecisionLimit    limit = isFullBound ? ComputeCramerRaoBound(input) : closed;
  const CameraModel &     camera = truth.settings.camera;
  const auto              pixels = static_cast<double>(input.width * input.height);
  const auto              unclipped = std::count(input.mask, input.mask + input.width * input.height, 1);
  return { { "truth",
             { { "gain", camera.gainDnPerElectron },
               { "intercept", camera.readNoiseDn * camera.readNoiseDn - camera.gainDnPerElectron * camera.offsetDn },
               { "offset", camera.offsetDn },
               { "read_noise", camera.readNoiseDn },
               { "flicker_sd", truth.realisedFlickerSd },
               { "vibration_sd_x", truth.realisedVibrationSdXPixels / pixelSize },
               { "vibration_sd_y", truth.realisedVibrationSdYPixels / pixelSize } } },
           { "limit", // an infinite limit becomes null
             { { "gain", limit.gain },
               { "intercept", limit.intercept },
               { "offset", limit.offset },
               { "read_noise", limit.readNoise },
               { "flicker_sd", limit.flickerSd },
               { "vibration_sd_x", limit.vibrationSdX },
               { "vibration_sd_y", limit.vibrationSdY } } },
           { "offset_limit_of_range", closed.offset / (camera.gainDnPerElectron * camera.electrons) },
           { "unclipped_fraction", static_cast<double>(unclipped) / pixels },
           { "report", measured.ReportRecord() } };
}

template <template <typename> class TMethod>
std::vector<Record>
MeasureMosaic(const Scene & scene, const StackSimulator & simulator)
{
  using Method = TMethod<std::uint16_t>;
  const SimulationTruth & truth = simulator.GetTruth();
  const std::size_t       frames = truth.settings.frames;
  const MosaicGeometry    mosaic{ { scene.width, scene.height, 1 }, truth.settings.flaws.filters.pattern.value() };
  const std::vector<std::uint16_t>    stack = RenderStack(simulator, scene.width, scene.height, frames);
  MosaicMethod<std::uint16_t, Method> method(typename Method::Settings(), mosaic.frame, mosaic.pattern, frames);
  while (!method.IsDone())
  {
    method.AddFrames(stack.data(), frames);
    method.EndPass();
  }
  const std::vector<double>       electrons = ElectronsAtRest(scene, truth.settings);
  const std::vector<std::uint8_t> mask = MaskOfUnclipped(method.TakePixelUse(), scene.values.size());
  const ChannelReports            reports = MakeChannelReports(mosaic.pattern, BayerSource::Given, method.GetReports());
  std::vector<Record>             records;
  for (const BayerPlane plane : BayerPlanes)
  {
    const auto           ofPlane = mosaic.Take(electrons, plane);
    const auto           maskOfPlane = mosaic.Take(mask, plane);
    const FrameGeometry  size = mosaic.Plane();
    const CramerRaoInput input{ ofPlane.data(), maskOfPlane.data(), size.width, size.height, &truth };
    Record               record{ { "plane", NameOf(plane) } };
    record.update(MakeRecord({ reports.Of(plane), {} }, input, false, 2.0)); // vibration in pixels of the channel
    records.push_back(std::move(record));
  }
  return records;
}

std::vector<Record>
MeasureCase(const std::string &  experiment,
            const std::string &  sceneName,
            const StudyOptions & options,
            std::uint64_t        seed)
{
  const Scene              scene = MakeScene(sceneName, options);
  const SimulationSettings settings = MakeSettings(experiment, options, seed);
  const StackSimulator     simulator(scene.values, scene.width, scene.height, settings);
  if (options.bayer != "none")
  {
    return options.method == "refined" ? MeasureMosaic<RefinedMethod>(scene, simulator)
                                       : MeasureMosaic<PublishedMethod>(scene, simulator);
  }
  const MeasuredStack             measured = MeasureBy(options.method,
                                           RenderStack(simulator, scene.width, scene.height, settings.frames),
                                                       { scene.width, scene.height, 1 },
                                           settings.frames);
  const std::vector<std::uint8_t> mask = MaskOfUnclipped(measured.pixelUse, scene.values.size());
  const std::vector<double>       electrons = ElectronsAtRest(scene, settings);
  return { MakeRecord(measured,
                      { electrons.data(), mask.data(), scene.width, scene.height, &simulator.GetTruth() },
                      options.isFullBound,
                      1.0) };
}
} // namespace

void
AppendEfficiencyCases(std::vector<StudyCase> & cases)
{
  for (const char camera : { 'A', 'B', 'C' })
  {
    for (const char condition : { '1', '2', '3' })
    {
      for (const char * scene : { "target", "texture", "bars" })
      {
        const std::string experiment{ camera, condition };
        cases.push_back({ "efficiency/" + experiment + '/' + scene,
                          std::string("camera ") + camera + " in condition " + condition + " of Sur & Gredi'ac 2015",
                          [=](const StudyOptions & options, std::uint64_t seed) {
                            return MeasureCase(experiment, scene, options, seed);
                          } });
      }
    }
  }
}

} // namespace sensornoise::tools
