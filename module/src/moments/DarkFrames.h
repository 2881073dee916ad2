// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_moments_DarkFrames_h
#define sensornoise_moments_DarkFrames_h

#include "sensornoise/Parallel.h"
#include "sensornoise/Settings.h"
#include "moments/DarkDrift.h"
#include "moments/TemporalMoments.h"
#include "SensorNoiseExport.h"

#include <cstdint>
#include <vector>

namespace sensornoise
{

/** A mean and its standard error, in the unit of the values. */
struct MeanOfPixels
{
  double value{ 0.0 };
  double standardError{ 0.0 };
};

/** The mean of those values that are from \a low to \a high. */
SensorNoise_EXPORT MeanOfPixels
MeanWithin(const std::vector<double> & values, double low, double high);

/** Offset and read noise from frames taken without light, at the exposure, gain and temperature of the others.
 *
 * The offset is the mean of the pixels' means that lie within 6 standard deviations (half the distance of the 16 % and
 * the 84 % quantile) of their median: hot and dead pixels do not carry it off. Its standard error holds temporal noise,
 * fixed pattern, the drift of the level that all pixels share, and what rounding to codes hides of a level with hardly
 * any noise.
 *
 * Two frames or more tell every pixel's variance over time, too. The mean is that of all pixels that are not defective,
 * the noisy ones among them: their noise is in the bright frames as well. Defective is a pixel of more than
 * InMoments.defectiveNoiseFactor times the typical noise, or one that never changed where a typical pixel would have,
 * with a chance of 1e-6 of being wrong. Its standard error is the pixels' scatter. The median pixel's read noise, see
 * MedianReadNoiseOf(), stands beside it.
 *
 * The moments are given away, their memory serves for the maps. \a drift, of the same frames, is taken off all
 * variances; without it a level that drifts adds to them. \a mask, if given, has a nonzero value at the pixels to be
 * used. Throws std::invalid_argument if fewer than 30 pixels are left, or if the frames are cut off at a clip level. */
template <typename TPixel>
SensorNoise_EXPORT KnownOffset
MeasureDarkFrames(TemporalMoments<TPixel>           moments,
                  const CodeSettings &              codes = {},
                  const std::vector<std::uint8_t> & mask = {},
                  const ParallelFor &               parallelFor = SerialFor,
                  const DarkDrift &                 drift = {});

} // namespace sensornoise

#endif
