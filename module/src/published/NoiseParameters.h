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

/** Fills gain, intercept, offset and read noise from the line through the corrected variance, section 3.3 of
 * Sur & Gredi\'ac 2015 (https://doi.org/10.1137/140977035): g is the slope, sigma^2 - g mu the intercept, and
 * sigma^2 = intercept + g mu once mu is known.
 *
 * \a offsetDn is mu where the flicker identifies it, else null: then offset and read noise are not-identifiable, with
 * the bracket that sigma^2 >= 0 and flux >= 0 leave, -intercept/g <= mu <= \a darkestDn. A gain that is not positive
 * contradicts the model: everything is failed, with the warning `variance-not-affine`.
 *
 * Nothing is removed for the codes: intercept and total intercept are the same, as in the paper. */
SensorNoise_EXPORT void
FillNoiseParameters(Report &              report,
                    const PolynomialFit & line,
                    std::optional<double> offsetDn,
                    std::optional<double> darkestDn);

/** A line that the corrected variance leaves by more than this many times its sampling noise is no line. */
inline constexpr double LargestReducedChi2 = 10.0;

/** Files how well the line fits; a gross misfit fails every parameter, with the warning `variance-not-affine`. */
SensorNoise_EXPORT void
FillFit(Report & report, const FitQuality & quality);

} // namespace sensornoise

#endif
