// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_refined_DarkSignal_h
#define sensornoise_refined_DarkSignal_h

#include "SensorNoiseExport.h"
#include "correlation/NoiseCorrelation.h"
#include "refined/RefinedResults.h"

#include <optional>

namespace sensornoise
{

/** Returns the fraction of the scene's signal that the dark frames hold, as of a shutter that was not closed [1]; null:
 * it is below InRefined.leastSignalOfDark or not distinguished from chance, too few places of the scene have contrast,
 * or there are no maps of the dark frames.
 *
 * The regression of the dark mean on the difference of bright and dark mean, within tiles of the frame. Offsets of the
 * pixels are in both means and cancel in the difference. Estimator.md, 3.9. */
SensorNoise_EXPORT std::optional<MeasuredNumber>
FindDarkSignal(const RefinedResults & found);

} // namespace sensornoise

#endif
