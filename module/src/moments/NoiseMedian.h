// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_moments_NoiseMedian_h
#define sensornoise_moments_NoiseMedian_h

#include "sensornoise/Settings.h"
#include "SensorNoiseExport.h"

#include <optional>
#include <vector>

namespace sensornoise
{

/** The read noise that half of the pixels stay below, from the pixels' variances over a few frames.
 *
 * The median of the variances is that of noise alone only where all pixels are alike: chi-square is skewed, and its
 * median lies below its mean by another share than that of chi-square times a wide distribution (8 frames, log-normal
 * noise of spread 0.6: 2 %). So the distribution of the logarithm of the true variances is found first, see
 * LogDeconvolution, whatever its shape, and its median taken. The standard error is a jackknife's over 20 groups of
 * pixels, twice what more iterations would change, and what rounding to codes hides. Measured on pixels that are alike,
 * log-normal of spread 0.3 to 0.6 and with tails: within 0.4 % for 8 frames and noise of a code or more, 2.5 % for
 * noise of 0.6 codes.
 *
 * \param variancesDn2 of the pixels, rounding to codes included [DN^2]
 * \param freedom degrees of freedom of a variance
 * \param stepDn spacing of the codes, whose noise step^2/12 is taken off [DN]; 0: none
 * \return null: fewer than 5 degrees of freedom or 100 pixels, or a median below half a step, of which rounding leaves
 * nothing to measure */
SensorNoise_EXPORT std::optional<MedianReadNoise>
MedianReadNoiseOf(const std::vector<double> & variancesDn2, double freedom, double stepDn);

} // namespace sensornoise

#endif
