/*=========================================================================
 *
 *  Copyright the ITKSensorNoise contributors
 *
 *  Licensed under the Apache License, Version 2.0 (the "License");
 *  you may not use this file except in compliance with the License.
 *  You may obtain a copy of the License at
 *
 *         https://www.apache.org/licenses/LICENSE-2.0.txt
 *
 *  Unless required by applicable law or agreed to in writing, software
 *  distributed under the License is distributed on an "AS IS" BASIS,
 *  WITHOUT WARRANTIES OR CONDITIONS OF ANY KIND, either express or implied.
 *  See the License for the specific language governing permissions and
 *  limitations under the License.
 *
 *=========================================================================*/
#ifndef sensornoise_refined_OffsetReport_h
#define sensornoise_refined_OffsetReport_h

#include "SensorNoiseExport.h"
#include "sensornoise/base/Eigen.h"
#include "sensornoise/refined/RefinedResults.h"
#include "sensornoise/report/Report.h"

#include <string>

namespace sensornoise
{

/** The offset as the flicker tells it. */
struct OffsetEstimate
{
  double      valueDn{ 0.0 };
  double      standardErrorDn{ 0.0 };
  Interval    interval;   ///< 95 % [DN]
  double      phi{ 1.0 }; ///< dispersion about the offset line; 1: nothing but noise
  std::string obstacle;   ///< why it cannot be told; empty: it can
};

/** The offset by the flicker of all frames, or, where the light is local, by the pixels' responses to it. It is told
 * only if its interval is narrow, it lies between the level of sigma = 0 and the darkest one, and the flicker agrees
 * with itself. */
SensorNoise_EXPORT OffsetEstimate
EstimateOffset(const RefinedResults & found);

/** Files offset and read noise, whose gain and intercept have the covariance \a covariance; the offset is \a flicker's
 * unless one is known. \a quantisationDn2 is the codes' noise, \a student the quantile of the 95 % intervals. */
SensorNoise_EXPORT void
FillOffsetAndReadNoise(Report &                report,
                       const RefinedResults &  found,
                       const OffsetEstimate &  flicker,
                       const Eigen::Matrix2d & covariance,
                       double                  quantisationDn2,
                       double                  student);

} // namespace sensornoise

#endif
