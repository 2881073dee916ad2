// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_pixels_LightLine_h
#define sensornoise_pixels_LightLine_h

#include "SensorNoiseExport.h"
#include "pixels/VarianceLine.h"

namespace sensornoise
{

class VarianceFit;
struct ReferenceFrame;
struct VarianceData;

/** The line by what the levels of a pixel have in common with those of its diagonal neighbours, which is light: with z
 * their mean as an instrument for the pixel's own mean x,
 *
 *     gain = sum w (z - <z>) V / sum w (z - <z>) x.
 *
 * Gains, efficiencies and offsets that differ from pixel to pixel, row to row or column to column, and the noise of the
 * means, have no part in it (see LevelPattern); detail as fine as a pixel has none either, which costs precision.
 * Weights, and what is trimmed, are those of \a fit. The pivot is the weighted mean of x, the covariance the sandwich.
 * Not determined with one intensity. */
SensorNoise_EXPORT VarianceLine
FitLightLine(const VarianceFit & fit, const VarianceData & data, const ReferenceFrame & frame);

} // namespace sensornoise

#endif
