// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_refined_MotionReport_h
#define sensornoise_refined_MotionReport_h

#include "SensorNoiseExport.h"
#include "refined/RefinedResults.h"
#include "sensornoise/Report.h"

namespace sensornoise
{

/** Files the flicker of every frame and its standard deviation, about the offset \a offset: known, identified, or else
 * the middle of where it can be, minus the centre [DN]; \a offsetErrorDn: how far it may be off; \a scaleError: error
 * of a flicker, relative to it, where the response bends [1]. */
SensorNoise_EXPORT void
FillFlicker(Report & report, const RefinedResults & found, double offset, double offsetErrorDn, double scaleError);

/** Files every frame's motion and the vibration's standard deviations and covariance; needs the flicker, which was
 * filed about the same \a offset. Where that is off by \a offsetErrorDn, a part of the flicker is taken for motion. */
SensorNoise_EXPORT void
FillMotion(Report & report, const RefinedResults & found, double offset, double offsetErrorDn);

} // namespace sensornoise

#endif
