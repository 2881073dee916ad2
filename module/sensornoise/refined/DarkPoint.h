// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_refined_DarkPoint_h
#define sensornoise_refined_DarkPoint_h

#include "SensorNoiseExport.h"
#include "sensornoise/refined/RefinedResults.h"

namespace sensornoise
{

struct GainEstimate;

/** Adds what dark frames tell: the line goes through their offset and variance, (mu, sigma^2). With levels of one
 * height only this is the photon transfer of EMVA 1288, gain = (V - sigma^2) / (mean - mu).
 *
 * Dark frames that contradict a straight line which comes close to the dark are of another sensor, and not used.
 * Elsewhere, where dark frames and frames contradict each other, or the levels' gains (V - sigma^2) / (mean - mu)
 * differ, beyond chance, the response bends: then the gain is their mean, and their scatter its error. */
SensorNoise_EXPORT void
UseDarkPoint(GainEstimate & estimate, const RefinedResults & found);

} // namespace sensornoise

#endif
