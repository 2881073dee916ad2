// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_refined_MotionEstimate_h
#define sensornoise_refined_MotionEstimate_h

#include "SensorNoiseExport.h"
#include "refined/OffsetEstimate.h"
#include "refined/RefinedResults.h"
#include "sensornoise/Report.h"

#include <array>
#include <vector>

namespace sensornoise
{

/** Motion of the scene. */
struct SeriesOfMotion
{
  std::vector<std::array<double, 2>> shifts; ///< shift of every frame [pixel]; NaN: too dark. Empty: not identifiable
  Quantity                           sdX;    ///< [pixel]
  Quantity                           sdY;    ///< [pixel]
  Quantity                           covariance; ///< [pixel^2]
};

/** Estimates the motion beside the flicker \a gamma of the frames, at the same offset. An error of the offset turns a
 * part of the flicker into apparent motion. */
SensorNoise_EXPORT SeriesOfMotion
EstimateMotion(const RefinedResults & found, const std::vector<double> & gamma, const UsedOffset & offset);

} // namespace sensornoise

#endif
