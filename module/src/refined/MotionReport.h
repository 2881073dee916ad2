// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_refined_MotionReport_h
#define sensornoise_refined_MotionReport_h

#include "SensorNoiseExport.h"
#include "refined/RefinedResults.h"
#include "sensornoise/Report.h"

namespace sensornoise
{

/** Files the flicker of every frame and its standard deviation. \a offset is the dark offset minus the centre [DN]:
 * known, identified, or else the middle of its bounds. \a offsetErrorDn is its error [DN]. \a scaleError is the
 * relative error of the flicker by a non-linear response [1]. */
SensorNoise_EXPORT void
FillFlicker(Report & report, const RefinedResults & found, double offset, double offsetErrorDn, double scaleError);

/** Files the motion of every frame, and the standard deviations and covariance of the vibration. The flicker must be
 * filed before, at the same \a offset [DN]. An error of the offset, \a offsetErrorDn [DN], turns a part of the flicker
 * into apparent motion. */
SensorNoise_EXPORT void
FillMotion(Report & report, const RefinedResults & found, double offset, double offsetErrorDn);

} // namespace sensornoise

#endif
