// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "studies/RealSensorRun.h"

#include "sensornoise/FrameGeometry.h"
#include "sensornoise/Parallel.h"
#include "sensornoise/Report.h"
#include "base/Quantiles.h"
#include "moments/DarkFrames.h"
#include "sensornoise/Settings.h"
#include "moments/PixelCalibration.h"
#include "moments/StackMoments.h"
#include "sensornoise/RefinedMethod.h"
#include "sensornoise/Simulator.h"
#include "studies/RealSensorCorrelation.h"
#include "studies/RealSensorStack.h"

#include <algorithm>
#include <cmath>

namespace sensornoise::tools
{
namespace
{
using Codes = std::vector<std::uint16_t>;

KnownOffset
MeasureDark(const RealSensorStack & dark, std::size_t frames)
{
  const Codes                 codes = dark.Render();
  StackMoments<std::uint16_t> moments(dark.Pixels(), frames);
  moments.AddFrames(codes.data(), 0, frames, SerialFor);
  return MeasureDarkFrames<std::uint16_t>(moments.Take());
}

RefinedMethod<std::uint16_t>
Estimate(const RefinedSettings & settings, const Codes & codes, std::size_t size, std::size_t frames)
{
  RefinedMethod<std::uint16_t> method(settings, FrameGeometry{ size, size, 1 }, frames);
  while (!method.IsDone())
  {
    method.AddFrames(codes.data(), frames);
    method.EndPass();
  }
  return method;
}

/** What the estimate should have found. */
struct PixelTruth
{
  double gain;
  double offsetDn;
  double readNoiseRmsDn;
  double readNoiseMedianDn;
};

/** \param use values of PixelUse; if no pixel is used, all count. The read noise is that of all pixels that are not
 * reported as defective: by \a dark frames, or without them by the frames. */
PixelTruth
TruthOfPixels(const RealSensorStack & stack, const std::vector<std::uint8_t> & use, const DarkMaps * dark)
{
  const auto             used = static_cast<std::uint8_t>(PixelUse::Used);
  const bool             isAnyUsed = std::find(use.begin(), use.end(), used) != use.end();
  const StackSimulator & simulator = stack.GetSimulator();
  std::vector<double>    readNoiseDn;
  PixelTruth             sums{ 0.0, 0.0, 0.0, 0.0 };
  double                 count = 0.0;
  double                 good = 0.0;
  for (std::size_t p = 0; p < stack.Pixels(); ++p)
  {
    readNoiseDn.push_back(simulator.PixelReadNoiseDn(p));
    const bool isDefective = dark ? dark->usable[p] == 0 : use[p] == static_cast<std::uint8_t>(PixelUse::Outlier);
    sums.readNoiseRmsDn += isDefective ? 0.0 : readNoiseDn.back() * readNoiseDn.back();
    good += isDefective ? 0.0 : 1.0;
    if (!isAnyUsed || use[p] == used)
    {
      sums.gain += simulator.LocalGainAt(p);
      sums.offsetDn += simulator.PixelOffsetDn(p);
      count += 1.0;
    }
  }
  return {
    sums.gain / count, sums.offsetDn / count, std::sqrt(sums.readNoiseRmsDn / good), Quantile(readNoiseDn, 0.5)
  };
}

/** The share of the pixels whose interval holds the truth. */
template <typename TTruth>
double
CoverageOf(const IntervalMapDn & map, TTruth truthOf)
{
  double count = 0.0;
  double held = 0.0;
  for (std::size_t p = 0; p < map.value.size(); ++p)
  {
    if (std::isfinite(map.value[p]))
    {
      const double truth = truthOf(p);
      count += 1.0;
      held += truth >= map.low[p] && truth <= map.high[p] ? 1.0 : 0.0;
    }
  }
  return held / std::max(1.0, count);
}

/** The gain of the stack in which each exposure is there once. */
std::optional<double>
GainOfDistinctFrames(const RealSensorSetting & setting, const Codes & codes, std::size_t size)
{
  const RepetitionSettings & repetition = setting.settings.flaws.repetition;
  const auto                 pixels = static_cast<std::ptrdiff_t>(size * size);
  Codes                      distinct;
  for (std::size_t t = 0; t < setting.settings.frames; ++t)
  {
    if (t == 0 || repetition.ExposureOf(t) != repetition.ExposureOf(t - 1))
    {
      const auto first = codes.begin() + static_cast<std::ptrdiff_t>(t) * pixels;
      distinct.insert(distinct.end(), first, first + pixels);
    }
  }
  return Estimate({}, distinct, size, distinct.size() / (size * size)).GetReport().gain.value;
}

RealSensorOutcome
Compare(const Report & report, const PixelTruth & truth, double flickerSd, const LineNoiseSettings & lineNoise)
{
  RealSensorOutcome outcome;
  outcome.judged = { { { truth.gain, report.gain },
                       { truth.offsetDn, report.offset },
                       { flickerSd, report.flickerSd },
                       { truth.readNoiseRmsDn, report.readNoise },
                       { truth.readNoiseMedianDn, report.readNoiseMedian },
                       { lineNoise.rowNoiseSdDn, RowNoiseOf(report) },
                       { lineNoise.columnNoiseSdDn, ColumnNoiseOf(report) } } };
  outcome.kind = KindOf(report);
  outcome.nonlinearity = report.fit.nonlinearity;
  for (const Warning & warning : report.warnings)
  {
    outcome.warnings.push_back(warning.code);
  }
  return outcome;
}
} // namespace

bool
RealSensorOutcome::HasWarning(WarningCode code) const
{
  return std::find(warnings.begin(), warnings.end(), code) != warnings.end();
}

RealSensorOutcome
MeasureRealSensor(const RealSensorSetting & setting, std::size_t size, std::uint64_t seed)
{
  const std::size_t     frames = setting.settings.frames;
  const RealSensorStack stack(setting, size, seed);
  RefinedSettings       settings;
  if (setting.hasDarkFrames)
  {
    settings.offset = MeasureDark(RealSensorStack(setting, size, seed, true), frames);
  }
  const Codes       codes = stack.Render();
  const auto        method = Estimate(settings, codes, size, frames);
  const DarkMaps *  dark = settings.offset ? settings.offset->maps.get() : nullptr;
  RealSensorOutcome outcome = Compare(method.GetReport(),
                                      TruthOfPixels(stack, method.GetPixelUse(), dark),
                                      stack.GetSimulator().GetTruth().realisedFlickerSd,
                                      setting.settings.flaws.lineNoise);
  outcome.seed = seed;
  if (setting.hasTwoLamps)
  {
    outcome.judged[static_cast<std::size_t>(JudgedQuantity::Flicker)] = {};
  }
  if (setting.settings.flaws.repetition.count > 1)
  {
    outcome.distinctGain = GainOfDistinctFrames(setting, codes, size);
  }
  if (settings.offset && settings.offset->maps)
  {
    const PixelCalibration own = MakePixelCalibration(*settings.offset->maps);
    const StackSimulator & simulator = stack.GetSimulator();
    outcome.offsetMapCoverage = CoverageOf(own.offset, [&](std::size_t p) { return simulator.PixelOffsetDn(p); });
    outcome.readNoiseMapCoverage =
      CoverageOf(own.readNoise, [&](std::size_t p) { return simulator.PixelReadNoiseDn(p); });
  }
  return outcome;
}

} // namespace sensornoise::tools
