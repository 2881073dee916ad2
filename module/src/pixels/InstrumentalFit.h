// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_pixels_InstrumentalFit_h
#define sensornoise_pixels_InstrumentalFit_h

#include "SensorNoiseExport.h"
#include "pixels/VarianceLine.h"

namespace sensornoise
{

class VarianceFit;
struct ReferenceFrame;
struct VarianceData;

/** Fits the variance line by instrumental variables. The instrument of a pixel's mean x is z, the mean of its diagonal
 * neighbours:
 *
 *     gain = sum w (z - <z>) V / sum w (z - <z>) x.
 *
 * Only the signal is common to x and z. Gains, efficiencies and offsets that differ from pixel to pixel, row to row or
 * column to column do not bias this gain (see FixedPatternEstimate), and neither does the noise of the means. Detail as
 * fine as a pixel does not contribute, which costs precision. Weights and trimmed pixels are taken from \a fit. The
 * pivot is the weighted mean of x, the covariance is the sandwich estimate. The line is not determined if there is only
 * one intensity. */
SensorNoise_EXPORT VarianceLine
FitInstrumental(const VarianceFit & fit, const VarianceData & data, const ReferenceFrame & frame);

} // namespace sensornoise

#endif
