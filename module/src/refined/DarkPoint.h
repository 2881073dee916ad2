// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_refined_DarkPoint_h
#define sensornoise_refined_DarkPoint_h

#include "SensorNoiseExport.h"
#include "refined/RefinedResults.h"

namespace sensornoise
{

struct GainEstimate;

/** Moves the line towards the point (mu, sigma^2) of the dark frames, their offset and variance. If all bright levels
 * are equal, this is the photon transfer of EMVA 1288, gain = (V - sigma^2) / (mean - mu).
 *
 * The dark point is one more point of the variance line. It contradicts the line of the bright frames if both differ
 * by more than Significance.severalTests of their errors, and by more than InCommon.leastDarkDifference of the
 * variance. Then it is not used, unless the response is visibly non-linear.
 *
 * A non-linear response may explain the difference if it is visible, or if the bright frames have no levels near the
 * dark offset. Then GainEstimate::atOffset is not set. If the response is visibly non-linear, or the difference is
 * smaller but significant, the gain is the mean of the gains of the levels, (V - sigma^2) / (mean - mu). Its error is
 * their scatter. */
SensorNoise_EXPORT void
CombineWithDarkPoint(GainEstimate & estimate, const RefinedResults & found);

} // namespace sensornoise

#endif
