// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "base/Quantiles.h"
#include "moments/DarkFrames.h"
#include "moments/StackMoments.h"
#include "sensornoise/Parallel.h"
#include "sensornoise/Settings.h"
#include "sensornoise/Simulator.h"
#include "studies/MeasuredStack.h"
#include "studies/RealSensorLines.h"
#include "studies/RealSensorStack.h"
#include "studies/StudyCase.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

namespace sensornoise::tools
{
namespace
{
using GreyValues = std::vector<std::uint16_t>;
using Record = nlohmann::ordered_json;

constexpr std::size_t SensorSize = 256; // [pixels]

KnownOffset
MeasureDark(const RealSensorStack & dark, std::size_t frames)
{
  const GreyValues            greyValues = dark.Render();
  StackMoments<std::uint16_t> moments(dark.Pixels(), frames);
  moments.AddFrames(greyValues.data(), 0, frames, SerialFor);
  return MeasureDarkFrames<std::uint16_t>(moments.Take());
}

MeasuredStack
Measure(const RefinedSettings & settings, const GreyValues & greyValues, std::size_t size, std::size_t frames)
{
  return MeasureBy(RefinedMethod<std::uint16_t>(settings, { size, size, 1 }, frames), greyValues, frames);
}

/** Mean true values of the pixels that a measurement used. */
struct PixelTruth
{
  double gain;
  double offsetDn;
  double readNoiseRmsDn;
  double readNoiseMedianDn;
};

/** Returns the true values of a stack. The gain is the mean of d(mean digital number) / d(electron), and the offset
 * is the mean digital number without signal. Both are means over the pixels that are used according to \a use
 * (values of PixelUse), or over all pixels if none is. The root mean square of the read noise is over the pixels
 * that are not defective according to \a dark, or according to \a use without dark frames. The median of the read
 * noise is over all pixels. */
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

/** Returns the fraction of the pixels with an interval whose 95 % interval contains the true value [1]. */
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

/** Returns the gain that is measured from the distinct frames of a stack with repeated frames [DN/e-]. */
std::optional<double>
GainOfDistinctFrames(const RealSensorSetting & setting, const GreyValues & greyValues, std::size_t size)
{
  const RepetitionSettings & repetition = setting.settings.flaws.repetition;
  const auto                 pixels = static_cast<std::ptrdiff_t>(size * size);
  GreyValues                 distinct;
  for (std::size_t t = 0; t < setting.settings.frames; ++t)
  {
    if (t == 0 || repetition.ExposureOf(t) != repetition.ExposureOf(t - 1))
    {
      const auto first = greyValues.begin() + static_cast<std::ptrdiff_t>(t) * pixels;
      distinct.insert(distinct.end(), first, first + pixels);
    }
  }
  return Measure({}, distinct, size, distinct.size() / (size * size)).report.gain.value;
}

Record
NumberOrNull(const std::optional<double> & number)
{
  return number ? Record(*number) : Record();
}

/** Returns the fractions of the pixels whose intervals of offset and read noise contain the true value. */
Record
CoverageOfMaps(const DarkMaps & dark, const StackSimulator & simulator)
{
  const PixelCalibration own = MakePixelCalibration(dark);
  return { { "offset", CoverageOf(own.offset, [&](std::size_t p) { return simulator.PixelOffsetDn(p); }) },
           { "read_noise", CoverageOf(own.readNoise, [&](std::size_t p) { return simulator.PixelReadNoiseDn(p); }) } };
}

/** Simulates a stack, with dark frames if the setting has them, and measures it with the refined method. */
std::vector<Record>
MeasureCase(RealSensorSetting setting, const StudyOptions & options, std::uint64_t seed)
{
  const std::size_t size = options.size.value_or(SensorSize);
  setting.settings.frames = options.frames.value_or(setting.settings.frames);
  const std::size_t      frames = setting.settings.frames;
  const RealSensorStack  stack(setting, size, seed);
  const StackSimulator & simulator = stack.GetSimulator();
  RefinedSettings        settings;
  if (setting.hasDarkFrames)
  {
    settings.offset = MeasureDark(RealSensorStack(setting, size, seed, true), frames);
  }
  const GreyValues    greyValues = stack.Render();
  const MeasuredStack measured = Measure(settings, greyValues, size, frames);
  const DarkMaps *    dark = settings.offset ? settings.offset->maps.get() : nullptr;
  const PixelTruth    truth = TruthOfPixels(stack, measured.pixelUse, dark);
  const double        flickerSd = simulator.GetTruth().realisedFlickerSd;
  const auto &        lineNoise = setting.settings.flaws.lineNoise;
  const bool          isRepeated = setting.settings.flaws.repetition.count > 1;
  return { { { "frames", frames },
             { "has_pattern", setting.HasPattern() },
             { "shading", setting.shading },
             { "expected_noise_classes", setting.kinds },
             { "truth",
               { { "gain", truth.gain },
                 { "offset", truth.offsetDn },
                 { "flicker_sd", setting.hasTwoSources ? Record() : Record(flickerSd) },
                 { "read_noise", truth.readNoiseRmsDn },
                 { "read_noise_median", truth.readNoiseMedianDn },
                 { "row_noise", lineNoise.rowNoiseSdDn },
                 { "column_noise", lineNoise.columnNoiseSdDn } } },
             { "gain_of_distinct_frames",
               isRepeated ? NumberOrNull(GainOfDistinctFrames(setting, greyValues, size)) : Record() },
             { "coverage_of_maps", dark != nullptr ? CoverageOfMaps(*dark, simulator) : Record() },
             { "report", measured.ReportRecord() } } };
}
} // namespace

void
AppendSensorCases(std::vector<StudyCase> & cases)
{
  for (const RealSensorLine & line : GetRealSensorLines())
  {
    for (const RealSensorSetting & setting : line.makeSettings())
    {
      cases.push_back({ "sensors/" + line.name + '/' + setting.name + ", " + std::to_string(setting.settings.frames) +
                          " frames/" + NameOf(setting.scene),
                        line.what,
                        [setting](const StudyOptions & options, std::uint64_t seed) {
                          return MeasureCase(setting, options, seed);
                        } });
    }
  }
}

} // namespace sensornoise::tools
