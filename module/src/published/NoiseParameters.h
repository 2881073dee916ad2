// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_published_NoiseParameters_h
#define sensornoise_published_NoiseParameters_h

#include "SensorNoiseExport.h"
#include "base/PolynomialFit.h"
#include "sensornoise/Report.h"

#include <optional>

namespace sensornoise
{

/** Sets gain, intercept, offset and read noise from the line through the corrected variance, as in section 3.3 of Sur &
 * Gredi\'ac 2015 (https://doi.org/10.1137/140977035): g is the slope, sigma^2 - g mu is the intercept, and
 * sigma^2 = intercept + g mu if mu is known.
 *
 * \a offsetDn is mu [DN], or null if the flicker does not determine it. In that case offset and read noise are
 * not-identifiable. They have bounds from sigma^2 >= 0 and flux >= 0: -intercept/g <= mu <= \a darkestDn [DN]. A gain
 * that is not positive contradicts the model: all parameters become failed, with the warning `variance-not-affine`.
 *
 * Quantization noise is not subtracted: intercept and total intercept are equal, as in the paper. */
SensorNoise_EXPORT void
FillNoiseParameters(Report &              report,
                    const PolynomialFit & line,
                    std::optional<double> offsetDn,
                    std::optional<double> darkestDn);

/** Largest reduced chi-square of the corrected variance about its line that is accepted [1]. */
inline constexpr double LargestReducedChi2 = 10.0;

/** Sets the quality of the fit. If the reduced chi-square is above LargestReducedChi2, all parameters become failed,
 * with the warning `variance-not-affine`. */
SensorNoise_EXPORT void
FillFit(Report & report, const FitQuality & quality);

} // namespace sensornoise

#endif
