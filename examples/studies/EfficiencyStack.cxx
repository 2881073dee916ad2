// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "studies/EfficiencyStack.h"

#include "sensornoise/base/FrameGeometry.h"
#include "sensornoise/base/PixelUse.h"
#include "sensornoise/limits/CramerRaoBound.h"
#include "sensornoise/limits/CramerRaoInformation.h"
#include "sensornoise/limits/PrecisionLimit.h"
#include "sensornoise/published/PublishedMethod.h"
#include "sensornoise/refined/RefinedMethod.h"
#include "sensornoise/report/Report.h"
#include "sensornoise/simulation/SimulationTruth.h"
#include "sensornoise/simulation/Simulator.h"
#include "studies/RenderedStack.h"

#include <algorithm>
#include <cstdint>
#include <utility>

namespace sensornoise::tools
{
namespace
{
template <typename TMethod>
std::pair<Report, std::vector<std::uint8_t>>
Measure(TMethod method, const std::vector<std::uint16_t> & stack, std::size_t frames)
{
  for (unsigned int pass = 0; pass < method.NumberOfPasses; ++pass)
  {
    method.AddFrames(stack.data(), frames);
    method.EndPass();
  }
  return { method.GetReport(), method.GetPixelUse() };
}

/** The scene at rest, as the optics blur it, at the brightness of gamma = 0 [e-]. */
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

/** Closed forms first, then what the table compares with: the same, or the full bound. */
std::pair<PrecisionLimit, PrecisionLimit>
Limits(const Scene & scene, const SimulationTruth & truth, const std::vector<std::uint8_t> & mask, bool isFullBound)
{
  const std::vector<double> electrons = ElectronsAtRest(scene, truth.settings);
  const CramerRaoInput      input{ electrons.data(), mask.data(), scene.width, scene.height, &truth };
  const CameraModel &       camera = truth.settings.camera;
  std::vector<double>       meanDn;
  for (const double value : electrons)
  {
    meanDn.push_back(camera.offsetDn + input.MeanFluxPerElectronDn() * value);
  }
  const PrecisionLimit closed = ComputePrecisionLimit({ meanDn.data(),
                                                        mask.data(),
                                                        scene.width,
                                                        scene.height,
                                                        camera.gainDnPerElectron,
                                                        camera.offsetDn,
                                                        input.TotalReadVarianceDn2(),
                                                        input.quantisationStepDn,
                                                        truth.settings.frames,
                                                        truth.realisedFlickerSd });
  return { closed, isFullBound ? ComputeCramerRaoBound(input) : closed };
}

/** The pixels that no clipping touches, which the bound is for; what else the method leaves out is its own loss. */
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
} // namespace

EfficiencyRun
MeasureStack(const Scene & scene, const SimulationSettings & settings, const std::string & methodName, bool isFullBound)
{
  const std::size_t                frames = settings.frames;
  const StackSimulator             simulator(scene.values, scene.width, scene.height, settings);
  const SimulationTruth &          truth = simulator.GetTruth();
  const std::size_t                pixels = scene.values.size();
  const std::vector<std::uint16_t> stack = RenderStack(simulator, scene.width, scene.height, frames);
  const FrameGeometry              geometry{ scene.width, scene.height, 1 };
  const auto [report, use] = methodName == "refined"
                               ? Measure(RefinedMethod<std::uint16_t>({}, geometry, frames), stack, frames)
                               : Measure(PublishedMethod<std::uint16_t>({}, geometry, frames), stack, frames);

  const std::vector<std::uint8_t> mask = MaskOfUnclipped(use, pixels);
  const auto [closed, limit] = Limits(scene, truth, mask, isFullBound);
  const CameraModel & camera = truth.settings.camera;
  const double        intercept = camera.readNoiseDn * camera.readNoiseDn - camera.gainDnPerElectron * camera.offsetDn;
  EfficiencyRun       run;
  run.seed = settings.seed;
  run.samples = { { { camera.gainDnPerElectron, limit.gain, report.gain },
                    { intercept, limit.intercept, report.intercept },
                    { camera.offsetDn, limit.offset, report.offset },
                    { camera.readNoiseDn, limit.readNoise, report.readNoise },
                    { truth.realisedFlickerSd, limit.flickerSd, report.flickerSd },
                    { truth.realisedVibrationSdXPixels, limit.vibrationSdX, report.vibrationSdX },
                    { truth.realisedVibrationSdYPixels, limit.vibrationSdY, report.vibrationSdY } } };
  run.offsetLimitOfRange = closed.offset / (camera.gainDnPerElectron * camera.electrons);
  run.usedFraction = static_cast<double>(report.pixels.used) / static_cast<double>(pixels);
  run.keptFraction = static_cast<double>(std::count(mask.begin(), mask.end(), 1)) / static_cast<double>(pixels);
  return run;
}

} // namespace sensornoise::tools
