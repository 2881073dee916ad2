// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "studies/EfficiencyStack.h"

#include "mosaic/MosaicGeometry.h"
#include "sensornoise/FrameGeometry.h"
#include "sensornoise/Parallel.h"
#include "sensornoise/Report.h"
#include "limits/CramerRaoBound.h"
#include "limits/CramerRaoInformation.h"
#include "limits/PrecisionLimit.h"
#include "sensornoise/MosaicMethod.h"
#include "sensornoise/PublishedMethod.h"
#include "sensornoise/RefinedMethod.h"
#include "sensornoise/ChannelReports.h"
#include "sensornoise/Simulator.h"
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
  while (!method.IsDone())
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

/** Closed forms of the limit, for pixels with these expected electrons. */
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

/** What a report says beside the truth and its limit. \a pixelSize: of its pixels, in those of the simulated frames. */
EfficiencyRun
Compare(const Report & report, const CramerRaoInput & input, bool isFullBound, double pixelSize)
{
  const SimulationTruth & truth = *input.truth;
  const PrecisionLimit    closed = ClosedLimit(input);
  const PrecisionLimit    limit = isFullBound ? ComputeCramerRaoBound(input) : closed;
  const CameraModel &     camera = truth.settings.camera;
  const double  intercept = camera.readNoiseDn * camera.readNoiseDn - camera.gainDnPerElectron * camera.offsetDn;
  const auto    pixels = static_cast<double>(input.width * input.height);
  EfficiencyRun run;
  run.seed = truth.settings.seed;
  run.samples = { { { camera.gainDnPerElectron, limit.gain, report.gain },
                    { intercept, limit.intercept, report.intercept },
                    { camera.offsetDn, limit.offset, report.offset },
                    { camera.readNoiseDn, limit.readNoise, report.readNoise },
                    { truth.realisedFlickerSd, limit.flickerSd, report.flickerSd },
                    { truth.realisedVibrationSdXPixels / pixelSize, limit.vibrationSdX, report.vibrationSdX },
                    { truth.realisedVibrationSdYPixels / pixelSize, limit.vibrationSdY, report.vibrationSdY } } };
  run.offsetLimitOfRange = closed.offset / (camera.gainDnPerElectron * camera.electrons);
  run.usedFraction = static_cast<double>(report.pixels.used) / pixels;
  run.keptFraction = static_cast<double>(std::count(input.mask, input.mask + input.width * input.height, 1)) / pixels;
  return run;
}

template <typename TMethod>
std::vector<EfficiencyRun>
CompareMosaic(const MosaicGeometry & mosaic, const Scene & scene, const StackSimulator & simulator)
{
  const SimulationTruth &              truth = simulator.GetTruth();
  const std::size_t                    frames = truth.settings.frames;
  const std::vector<std::uint16_t>     stack = RenderStack(simulator, scene.width, scene.height, frames);
  MosaicMethod<std::uint16_t, TMethod> method(typename TMethod::Settings(), mosaic.frame, mosaic.pattern, frames);
  while (!method.IsDone())
  {
    method.AddFrames(stack.data(), frames);
    method.EndPass();
  }
  const std::vector<std::uint8_t> use = method.TakePixelUse();
  const std::vector<double>       electrons = ElectronsAtRest(scene, truth.settings);
  const std::vector<std::uint8_t> mask = MaskOfUnclipped(use, scene.values.size());
  const ChannelReports            reports = MakeChannelReports(mosaic.pattern, BayerSource::Given, method.GetReports());
  std::vector<EfficiencyRun>      runs;
  for (const BayerPlane plane : BayerPlanes)
  {
    const auto           ofPlane = mosaic.Take(electrons, plane);
    const auto           maskOfPlane = mosaic.Take(mask, plane);
    const FrameGeometry  size = mosaic.Plane();
    const CramerRaoInput input{ ofPlane.data(), maskOfPlane.data(), size.width, size.height, &truth };
    runs.push_back(Compare(reports.Of(plane), input, false, 2.0));
    runs.back().experiment = NameOf(plane);
  }
  return runs;
}
} // namespace

EfficiencyRun
MeasureStack(const Scene & scene, const SimulationSettings & settings, const std::string & methodName, bool isFullBound)
{
  const std::size_t                frames = settings.frames;
  const StackSimulator             simulator(scene.values, scene.width, scene.height, settings);
  const std::size_t                pixels = scene.values.size();
  const std::vector<std::uint16_t> stack = RenderStack(simulator, scene.width, scene.height, frames);
  const FrameGeometry              geometry{ scene.width, scene.height, 1 };
  const auto [report, use] = methodName == "refined"
                               ? Measure(RefinedMethod<std::uint16_t>({}, geometry, frames), stack, frames)
                               : Measure(PublishedMethod<std::uint16_t>({}, geometry, frames), stack, frames);
  const std::vector<std::uint8_t> mask = MaskOfUnclipped(use, pixels);
  const std::vector<double>       electrons = ElectronsAtRest(scene, settings);
  return Compare(
    report, { electrons.data(), mask.data(), scene.width, scene.height, &simulator.GetTruth() }, isFullBound, 1.0);
}

std::vector<EfficiencyRun>
MeasureMosaic(const Scene & scene, const SimulationSettings & settings, const std::string & methodName)
{
  const StackSimulator simulator(scene.values, scene.width, scene.height, settings);
  const MosaicGeometry mosaic{ { scene.width, scene.height, 1 }, settings.flaws.filters.pattern.value() };
  return methodName == "refined" ? CompareMosaic<RefinedMethod<std::uint16_t>>(mosaic, scene, simulator)
                                 : CompareMosaic<PublishedMethod<std::uint16_t>>(mosaic, scene, simulator);
}

} // namespace sensornoise::tools
