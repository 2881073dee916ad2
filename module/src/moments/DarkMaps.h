// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_moments_DarkMaps_h
#define sensornoise_moments_DarkMaps_h

#include "base/ChiSquare.h"
#include "moments/Constants.h"
#include "sensornoise/Parallel.h"
#include "SensorNoiseExport.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace sensornoise
{

/** Maps of every pixel from dark frames; the variance needs two or more frames. */
struct DarkMaps
{
  std::vector<double> offsetDn;            ///< mean over time [DN]; NaN: not finite, clipped or masked
  std::vector<double> varianceDn2;         ///< variance over time, without the common drift of the frames, with
                                           ///< quantization noise [DN^2]; NaN as above
  std::vector<std::uint8_t> usable;        ///< 0: not finite, clipped, masked or defective, see DefectiveVarianceDn2()
  std::size_t               frames{ 0 };   ///< number of frames; the degrees of freedom of a variance are one less
  double                    stepDn{ 0.0 }; ///< quantization step [DN]; 0: the data have no codes
};

/** Returns the ratio of the median of the variances of pixels with the same noise to their expectation [1].
 * \param freedom degrees of freedom of a variance, above 0 */
inline double
MedianToMeanOfVariance(double dof)
{
  return ChiSquareQuantile(0.5, dof) / dof;
}

/** Returns the variance above which a pixel is defective [DN^2].
 *
 * The limit is the variance of InMoments.defectiveNoiseFactor times the typical noise, times 1 + 2/freedom. Of the
 * pixels whose noise is near the limit, some stay below it by chance and some exceed it; the excluded ones have the
 * larger variances. With this factor the gained and the lost variance are equal, exactly so where the density of the
 * true variances falls as their third power. For other tails they agree to some per cent of the variance near the
 * limit.
 * \param medianDn2 median of the variances of the pixels [DN^2]
 * \param freedom degrees of freedom of a variance, above 0 */
inline double
DefectiveVarianceDn2(double medianDn2, double dof)
{
  const double typicalDn2 = medianDn2 / MedianToMeanOfVariance(dof);
  return InMoments.defectiveNoiseFactor * InMoments.defectiveNoiseFactor * typicalDn2 * (1.0 + 2.0 / dof);
}

/** Returns the largest shift by rounding to codes of the mean of values with the variance \a varianceDn2, quantization
 * noise included [DN]. It is step/pi exp(-2 pi^2 variance/step^2), the first harmonic, where the variance is without
 * quantization noise. The shift is negligible if the standard deviation is half a step or more. Without any noise the
 * shift is up to half a step, pi/2 times this value. */
inline double
RoundingErrorDn(double stepDn, double varianceDn2)
{
  if (stepDn == 0.0)
  {
    return 0.0;
  }
  constexpr double pi = 3.14159265358979323846;
  const double     hidden = std::max(0.0, varianceDn2 / (stepDn * stepDn) - 1.0 / 12.0);
  return stepDn / pi * std::exp(-2.0 * pi * pi * hidden);
}

/** A quantity of every pixel of the frame and the bounds of its 95 % interval; NaN: not known. */
struct IntervalMapDn
{
  std::vector<double> value; ///< values [DN]
  std::vector<double> low;   ///< lower bounds [DN]
  std::vector<double> high;  ///< upper bounds [DN]
};

/** Offset and read noise of each pixel: the camera calibration of single-molecule microscopy. */
struct PixelCalibration
{
  IntervalMapDn offset;
  IntervalMapDn readNoise; ///< without quantization noise
};

/** Computes the offset and the read noise of each pixel from dark frames.
 *
 * For a pixel with Gaussian noise each interval contains the true value with a probability of 95 %. Student's
 * distribution is used for the offset and the chi-square distribution for the read noise. (The mean plus and minus
 * 1.96 standard errors would cover 90 % of the offsets of 8 frames.) The error of the offset by rounding widens the
 * interval of a pixel with hardly any noise by up to half a step. Read noise that rounding may hide has an interval
 * from 0 to half a step or more. The common drift of the frames is in none of the intervals. Defective pixels have
 * values, too. Pixels that are not finite, clipped or masked have none.
 *
 * Throws std::invalid_argument if there are fewer than two frames, or not as many variances as offsets. */
SensorNoise_EXPORT PixelCalibration
MakePixelCalibration(const DarkMaps & dark, const ParallelFor & parallelFor = SerialFor);

} // namespace sensornoise

#endif
