// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_report_SceneChangeReport_h
#define sensornoise_report_SceneChangeReport_h

#include "SensorNoiseExport.h"
#include "moments/FrameThumbnails.h"
#include "sensornoise/Report.h"

namespace sensornoise
{

/** Where there is no gain, and the frames show no still scene, says so in place of what else was found wrong, which
 * follows from it. */
SensorNoise_EXPORT void
ReportSceneChange(Report & report, const SceneChange & change);

} // namespace sensornoise

#endif
