// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_pixels_MeanGain_h
#define sensornoise_pixels_MeanGain_h

#include "SensorNoiseExport.h"
#include "pixels/VarianceCurve.h"

#include <optional>

namespace sensornoise
{

/** Mean over the pixels of the local gain d(mean DN)/d(electron) of a non-linear response. */
struct MeanGain
{
  double value{ 0.0 };    ///< mean local gain [DN/e-]
  double variance{ 0.0 }; ///< sampling variance of its difference from the line's gain [DN^2/e-^2]
};

/** Computes the mean local gain if the variance V follows a polynomial of \a degree instead of a line.
 *
 * With x electrons, response y(x), local gain G = dy/dx and the square s of the read noise in electrons,
 * V = G^2 (x + s). So Z = sqrt(x + s) grows by dZ = dy / (2 sqrt(V)), as in a variance-stabilising transform, and
 *
 *     G(y) = sqrt(V(y)) / Z(y),   Z(y) = Z(y0) + integral from y0 to y of dy / (2 sqrt(V)).
 *
 * If the signal at the darkest level y0 of the scene is small, V' = G there, and Z(y0) = sqrt(V(y0)) / V'(y0). If V is
 * a line, G is its slope. The slope of V is not the local gain: it contains twice the change of G.
 *
 * The other extreme is V(y0) that is all shot noise, as with a tone curve. Then V falls to 0 at the offset mu as the
 * power q = V' (y0 - mu) / V of the signal, and Z(y0) = (y0 - mu) / ((2 - q) sqrt(V)). \a offsetDn selects this case
 * and is mu [DN].
 *
 * Null if the polynomial does not rise at the darkest level, is not positive, or is not determined by the levels. */
SensorNoise_EXPORT std::optional<MeanGain>
FindMeanGain(const VarianceCurve & curve, int degree, const std::optional<double> & offsetDn = std::nullopt);

} // namespace sensornoise

#endif
