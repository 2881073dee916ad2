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

/** Returns the mean of the values from \a low to \a high, both included. */
SensorNoise_EXPORT MeanOfPixels
MeanWithin(const std::vector<double> & values, double low, double high);

/** Measures the offset and the read noise from frames taken without light, at the exposure, gain and temperature of the
 * others.
 *
 * The offset is the mean of the temporal means of the pixels within 6 standard deviations of their median. (Half the
 * distance between the quantiles 0.16 and 0.84 is taken as a standard deviation.) Hot and dead pixels are thus
 * excluded. The standard error of the offset contains temporal noise, fixed-pattern noise, the drift of the common
 * level, and the error by rounding to codes of a level with hardly any noise.
 *
 * Two frames or more also yield the temporal variance of every pixel. The mean variance is over all pixels that are
 * not defective. It includes noisy pixels, because their noise is in the bright frames as well. A pixel is defective
 * if its noise exceeds InMoments.defectiveNoiseFactor times the typical noise. It is also defective if it never
 * changed although a typical pixel does with a probability of at least 1 - 1e-6. The standard error of the mean is the
 * scatter of the pixels. The read noise of the median pixel, see MedianReadNoiseOf(), is returned with it.
 *
 * The moments are consumed: their memory holds the maps.
 * \param drift drift of the same frames, which is removed from all variances; without it a level that drifts adds to
 * them
 * \param mask if not empty, nonzero at the pixels to be used
 *
 * Throws std::invalid_argument if fewer than 30 pixels are left, or if the frames are clipped. */
template <typename TPixel>
SensorNoise_EXPORT KnownOffset
MeasureDarkFrames(TemporalMoments<TPixel>           moments,
                  const CodeSettings &              codes = {},
                  const std::vector<std::uint8_t> & mask = {},
                  const ParallelFor &               parallelFor = SerialFor,
                  const DarkDrift &                 drift = {});

} // namespace sensornoise

#endif
