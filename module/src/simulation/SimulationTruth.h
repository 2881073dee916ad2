// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_simulation_SimulationTruth_h
#define sensornoise_simulation_SimulationTruth_h

#include "SensorNoiseExport.h"
#include "sensornoise/SimulationSettings.h"

#include <cstddef>
#include <limits>
#include <vector>

namespace sensornoise
{

/** The random numbers that are common to a frame, one each per frame. */
struct SimulatedSeries
{
  /** Illumination of the frames relative to the settings' electrons, less 1 [1]: their illumination factor times their
   * flicker; with a rolling shutter its mean over the rows. */
  std::vector<double> gamma;
  /** Illumination factors of the frames without flicker [1]. */
  std::vector<double> factor;
  /** Horizontal shift [pixel]: the frame shows p(x + alpha, y + beta). */
  std::vector<double> alpha;
  /** Vertical shift [pixel]. */
  std::vector<double> beta;
  /** Phase of the lamp at row 0 [rad], for the rolling shutter. */
  std::vector<double> phase;
};

/** What an estimator of a simulated stack should find. The scale and the position of the scene are free, so only
 * (1 + gamma_t) / mean(1 + gamma) - 1 and the spread of the shifts can be found. */
struct SimulationTruth
{
  SimulationSettings settings;
  SimulatedSeries    series;
  /** (1 + gamma_t) / mean(1 + gamma) - 1, one per frame [1]. */
  std::vector<double> normalisedFlicker;
  /** Standard deviation of the normalised flicker of this stack (divisor T - 1) [1]; with a rolling shutter the root
   * mean square over the rows of that of each row. NaN for one frame, as are the two below. */
  double realisedFlickerSd{ 0.0 };
  /** Standard deviation of this stack's alpha (divisor T - 1) [pixel]. */
  double realisedVibrationSdXPixels{ 0.0 };
  /** Standard deviation of this stack's beta (divisor T - 1) [pixel]. */
  double realisedVibrationSdYPixels{ 0.0 };
  /** Root mean square over all pixels of the standard deviation of the code without light, hot pixels and the tail of
   * the read noise included, rounding and line noise not [DN]. NaN where the truth was drawn without a width. */
  double realisedReadNoiseRmsDn{ std::numeric_limits<double>::quiet_NaN() };
  /** Median of the same [DN]. */
  double realisedReadNoiseMedianDn{ std::numeric_limits<double>::quiet_NaN() };
};

/** Returns gamma_t(y) of row `y` of frame `frame`: illumination factor times flicker, less 1 [1]. */
SensorNoise_EXPORT double
FlickerOfRow(const SimulationSettings & settings, const SimulatedSeries & series, std::size_t frame, std::size_t y);

/** Draws the series of a stack of frames with `height` rows and works out what an estimator should find. The numbers of
 * a frame depend on the seed and on the frame alone: a longer stack begins with the shorter one.
 * \throws std::invalid_argument if a setting cannot be used. */
SensorNoise_EXPORT SimulationTruth
DrawTruth(const SimulationSettings & settings, std::size_t height);

/** The same, with what depends on the pixels: the realised read noise. */
SensorNoise_EXPORT SimulationTruth
DrawTruth(const SimulationSettings & settings, std::size_t width, std::size_t height);

} // namespace sensornoise

#endif // sensornoise_simulation_SimulationTruth_h
