// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_refined_DarkPoint_h
#define sensornoise_refined_DarkPoint_h

#include "SensorNoiseExport.h"
#include "refined/RefinedResults.h"

namespace sensornoise
{

struct GainEstimate;

/** Adds what dark frames tell: the line goes through their offset and variance, (mu, sigma^2). With levels of one
 * height only this is the photon transfer of EMVA 1288, gain = (V - sigma^2) / (mean - mu).
 *
 * The dark point is one more point of the variance line. It contradicts the line of the bright frames where both differ
 * by more than Significance.severalTests of their errors, and by more than InCommon.leastDarkDifference of the
 * variance: then it is not used. Where the bright frames do not come close to the dark, a bend of the response could
 * make that difference, too, and the error of the gain holds the gain that the dark frames would give. Where the
 * response bends visibly, or the difference is smaller but beyond chance, the gain is the mean of the levels' gains (V
 * - sigma^2) / (mean - mu), and their scatter its error. */
SensorNoise_EXPORT void
UseDarkPoint(GainEstimate & estimate, const RefinedResults & found);

} // namespace sensornoise

#endif
