// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_emva1288_LevelLines_h
#define sensornoise_emva1288_LevelLines_h

#include "SensorNoiseExport.h"

#include <vector>

namespace sensornoise
{

/** A value of one exposure, with the variance of its error. */
struct LevelValue
{
  double x{ 0.0 };
  double y{ 0.0 };
  double variance{ 0.0 }; ///< of the error of y; 0: not known
};

/** Line y = intercept + slope x. */
struct LevelLine
{
  double slope{ 0.0 };
  double intercept{ 0.0 };
  double slopeStandardError{ 0.0 };
  double interceptStandardError{ 0.0 };
  double reducedChi2{ 0.0 }; ///< sum of the weighted squared residuals over its expectation [1]; 1: without variances
  double dof{ 0.0 };         ///< degrees of freedom of the residuals
};

/** Fits a line with equal weights. With known variances the errors follow from them; they grow by the root of the
 * reduced chi-square where it is above 1. Without them the errors follow from the scatter about the line. The values
 * are three or more, and not all at one x. */
SensorNoise_EXPORT LevelLine
FitLevelLine(const std::vector<LevelValue> & values);

/** Fits a line with weights 1 / variance. The errors grow by the root of the reduced chi-square where it is above 1.
 * The values are three or more, not all at one x, with variances above 0. */
SensorNoise_EXPORT LevelLine
FitWeightedLine(const std::vector<LevelValue> & values);

/** Fits a line through the origin with equal weights. Its error follows from the scatter about the line. The values are
 * two or more, and not all at 0. */
SensorNoise_EXPORT LevelLine
FitLineThroughOrigin(const std::vector<LevelValue> & values);

/** Fits a line whose relative deviations are least: with weights 1 / y^2. Has no errors. All y are above 0. */
SensorNoise_EXPORT LevelLine
FitRelativeLine(const std::vector<LevelValue> & values);

} // namespace sensornoise

#endif
