// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_pixels_MeanGain_h
#define sensornoise_pixels_MeanGain_h

#include "SensorNoiseExport.h"
#include "pixels/VarianceCurve.h"

#include <optional>

namespace sensornoise
{

/** The mean over the pixels of the local gain, d(mean code)/d(electron), of a response that bends. */
struct MeanGain
{
  double value{ 0.0 };    ///< [DN/e-]
  double variance{ 0.0 }; ///< of its difference from the line's gain, from sampling [DN^2/e-^2]
};

/** Local gain where the variance V follows a polynomial of \a degree instead of a line.
 *
 * With x electrons, response y(x) and local gain G = dy/dx, V = G^2 (x + s) with s the square of the read noise in
 * electrons. So Z = sqrt(x + s) grows by dZ = dy / (2 sqrt(V)), as in a transform that stabilises the variance, and
 *
 *     G(y) = sqrt(V(y)) / Z(y),   Z(y) = Z(y0) + integral from y0 to y of dy / (2 sqrt(V)).
 *
 * At the darkest level y0 of a scene with little light there, V' = G, and Z(y0) = sqrt(V(y0)) / V'(y0). Where V is a
 * line, G is its slope. The tangent of V is not the local gain: it holds twice the change of G.
 *
 * If all of V(y0) is shot noise, the other extreme, V falls to 0 at the offset mu, as the power q = V' (y0 - mu) / V of
 * the light, and Z(y0) = (y0 - mu) / ((2 - q) sqrt(V)): so it is with a tone curve, and \a offsetDn asks for it.
 *
 * Null if the polynomial does not rise at the darkest level, is not positive, or cannot be told from the levels. */
SensorNoise_EXPORT std::optional<MeanGain>
FindMeanGain(const VarianceCurve & curve, int degree, const std::optional<double> & offsetDn = std::nullopt);

} // namespace sensornoise

#endif
