// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_emva1288_LevelLines_h
#define sensornoise_emva1288_LevelLines_h

#include "SensorNoiseExport.h"
#include "sensornoise/Emva1288.h"
#include "moments/Exposures.h"

#include <vector>

/** \file
 * Lines through the values of several exposures, and the levels of the dark frames. */

namespace sensornoise
{

/** A value of one exposure, with the variance of its error. */
struct LevelValue
{
  double x{ 0.0 };
  double y{ 0.0 };
  double variance{ 0.0 }; ///< variance of the error of y; 0: not known
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

/** Fits a line with equal weights. If the variances are known, the errors follow from the variances, times the root of
 * the reduced chi-square if it is above 1. Otherwise the errors follow from the scatter about the line. At least three
 * values are needed, at two or more different x. */
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

struct LevelLine;

/** Returns the variance of the error of the temporal variance of a series [DN^4]. The variance of pixels * (frames - 1)
 * normal numbers has the relative variance 2 / (pixels * (frames - 1)). */
double
ErrorVarianceOf(const EmvaSeries & series);

/** \class DarkLevels
 * \brief Mean level and temporal variance of the dark frames as a function of the exposure. Of an exposure with a pair
 * of frames and a longer series, the pair counts. */
class DarkLevels
{
public:
  /** \a series are all series. Throws std::invalid_argument if none of them is dark. */
  explicit DarkLevels(const std::vector<EmvaSeries> & series);

  /** Level of the dark frames at one exposure. */
  struct Level
  {
    double meanDn{ 0.0 };
    double varianceDn2{ 0.0 };
    double varianceError{ 0.0 }; ///< variance of the error of varianceDn2 [DN^4]
    bool   isMeasured{ true };   ///< false: no dark frames have this exposure
  };

  /** Returns the level at an exposure: of its dark frames, or interpolated between the nearest two exposures, or of the
   * nearest exposure outside of all. */
  Level
  At(double exposure) const;

  /** Returns the dark series, one of each exposure, in rising order of the exposures. */
  const std::vector<EmvaSeries> &
  Series() const
  {
    return m_Series;
  }

  /** Returns whether a dark current can be measured: three or more exposures. */
  bool
  HasLine() const;

  /** Returns the line of the mean level against the exposure [DN], with errors from the scatter about it. HasLine() is
   * true. */
  LevelLine
  MeanLine() const;
  /** Returns the line of the temporal variance against the exposure [DN^2]. HasLine() is true. */
  LevelLine
  VarianceLine() const;

  /** Returns the dark variance of the sensor [DN^2]: at the exposure 0 of VarianceLine(), or of the lowest exposure if
   * there is no such line. */
  FittedNumber
  DarkVariance() const;

private:
  std::vector<EmvaSeries> m_Series;
};

} // namespace sensornoise

#endif
