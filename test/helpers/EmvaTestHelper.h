// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_test_EmvaTestHelper_h
#define sensornoise_test_EmvaTestHelper_h

#include "sensornoise/Emva1288.h"
#include "sensornoise/Simulator.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

/** \file
 * Series of EMVA 1288: exact series, and series of simulated cameras. */

namespace sensornoise::test::emva
{

/** Parameters of a linear camera. */
struct LinearCamera
{
  double gain{ 0.5 };         ///< K [DN/e-]
  double offsetDn{ 100.0 };   ///< dark level at exposure 0 [DN]
  double darkNoise{ 6.0 };    ///< sigma_d [e-]
  double efficiency{ 0.6 };   ///< quantum efficiency [1]
  double darkCurrent{ 0.0 };  ///< dark current [e- per unit of exposure]
  double quantization{ 1.0 }; ///< quantization step [DN]
};

/** Returns the series of the expected values of a camera, without noise: mean \a electrons of light. \a electrons is 0:
 * a dark series. */
inline EmvaSeries
ExactSeries(const LinearCamera & camera, double exposure, double electrons, std::size_t frames = 2)
{
  const double all = electrons + camera.darkCurrent * exposure;
  EmvaSeries   series;
  series.exposure = exposure;
  series.photons = electrons / camera.efficiency;
  series.isDark = electrons == 0.0;
  series.width = 100;
  series.height = 80;
  series.frames = frames;
  series.meanDn = camera.offsetDn + camera.gain * all;
  series.temporalVarianceDn2 = camera.gain * camera.gain * (camera.darkNoise * camera.darkNoise + all) +
                               camera.quantization * camera.quantization / 12.0;
  series.highestDn = 4095.0;
  series.unfiltered.columns = series.width;
  series.unfiltered.rows = series.height;
  return series;
}

/** Returns a saturated series, at 4095 DN: little noise is left. */
inline EmvaSeries
SaturatedSeries(const LinearCamera & camera, double exposure, double electrons)
{
  EmvaSeries series = ExactSeries(camera, exposure, electrons);
  series.meanDn = 4095.0;
  series.temporalVarianceDn2 = 0.5;
  series.fractionAtHighest = 0.9;
  return series;
}

/** Returns the statistics of frames of one exposure. */
template <typename TPixel>
EmvaSeries
SeriesOf(const std::vector<std::vector<TPixel>> & frames, std::size_t width, std::size_t height)
{
  EmvaSeriesSums sums(width, height);
  for (const std::vector<TPixel> & frame : frames)
  {
    sums.AddFrame(frame.data());
  }
  return sums.Measure();
}

/** Returns settings of a camera under steady illumination, without vibration. */
inline SimulationSettings
SteadySettings(std::uint64_t seed)
{
  SimulationSettings settings;
  settings.conditions = { 0.0, 0.0, 0.0 };
  settings.seed = seed;
  settings.opticalBlurPixels = 0.0;
  settings.prnuSd = 0.01;
  settings.dsnuSdDn = 2.0;
  return settings;
}

/** Returns the series of a simulated flat field. The exposures are \a levels parts of 1, up to 1.1, each with two
 * frames. The dark frames and the frames of half exposure have \a longFrames more. */
inline std::vector<EmvaSeries>
SimulateSeries(SimulationSettings settings, std::size_t size, std::size_t levels, std::size_t longFrames)
{
  std::vector<double> exposures{ 0.0, 0.0 };
  exposures.insert(exposures.end(), longFrames, 0.0);
  for (std::size_t i = 1; i <= levels; ++i)
  {
    exposures.insert(exposures.end(), 2, 1.1 * static_cast<double>(i) / static_cast<double>(levels));
  }
  exposures.insert(exposures.end(), longFrames, 0.5);
  settings.illumination.shape = IlluminationShape::Factors;
  settings.illumination.factors = exposures;
  settings.frames = exposures.size();
  const StackSimulator        simulator(MakeFlatScene(size, size), size, size, settings);
  std::vector<EmvaSeries>     series;
  std::vector<unsigned short> frame(size * size);
  const auto                  addSeries = [&](std::size_t begin, std::size_t end) {
    EmvaSeriesSums sums(size, size);
    for (std::size_t t = begin; t < end; ++t)
    {
      simulator.RenderFrame(t, frame.data());
      sums.AddFrame(frame.data());
    }
    EmvaSeries measured = sums.Measure();
    measured.exposure = exposures[begin];
    measured.isDark = exposures[begin] == 0.0;
    series.push_back(measured);
  };
  std::size_t begin = 0;
  addSeries(begin, 2);
  addSeries(2, 2 + longFrames);
  for (begin = 2 + longFrames; begin < exposures.size() - longFrames; begin += 2)
  {
    addSeries(begin, begin + 2);
  }
  addSeries(begin, exposures.size());
  return series;
}

} // namespace sensornoise::test::emva

#endif
