// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_series_OffsetLine_h
#define sensornoise_series_OffsetLine_h

#include "SensorNoiseExport.h"
#include "base/Constants.h"
#include "base/Eigen.h"
#include "base/Quantiles.h"
#include "series/Constants.h"
#include "series/FrameEquations.h"
#include "series/FrameSums.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

namespace sensornoise
{

/** Offset and flicker, from the line on which the changes of the frames with the illumination lie. */
struct SensorNoise_EXPORT OffsetLine
{
  double offset{ 0.0 };                                            ///< dark offset minus the centre of the regression
                                                                   ///< [DN]
  double standardError{ std::numeric_limits<double>::infinity() }; ///< standard error of the offset [DN]
  double low{ -std::numeric_limits<double>::infinity() };          ///< lower bound of the 95 % interval, may be
                                                                   ///< unbounded [DN]
  double high{ std::numeric_limits<double>::infinity() };          ///< upper bound [DN]
  double phi{ 1.0 };                                               ///< dispersion about the line [1]; 1: noise alone
  double flickerZ{ 0.0 };  ///< excess of the flicker over its widened noise, in standard deviations [1]
  double precision{ 0.0 }; ///< inverse variance of one gamma_t [1]
  /** Fraction of the variance of the levels that is not the noise of their means [1]; 0: the scene has one level. */
  double              contrast{ 0.0 };
  double              sensitivity{ 0.0 }; ///< relative change of gamma_t with the offset [1/DN]
  std::vector<double> gamma;              ///< illumination factor of every frame minus 1 [1]
  std::size_t         lastClass{ 0 };     ///< roughest gradient class that was included
  /** Largest significant difference to the offset without the roughest gradient classes [DN]; 0: there is none. */
  double differenceOfClassesDn{ 0.0 };
  /** True if the scene is a ramp, so that the flicker was estimated from its slope alone, see
   * FrameEquations::isLevelMotion. */
  bool isLevelMotion{ false };

  Eigen::Matrix2d  illumination; ///< see FrameEquations::illumination, of the equations that were used
  Eigen::MatrixX2d response;     ///< see FrameEquations::response, frames x 2

  /** Returns whether the flicker determines the offset: the flicker is significant, and levels differ. */
  bool
  DeterminesOffset() const
  {
    return flickerZ > Significance.everyPixel && contrast > InSeries.leastContrast && std::isfinite(low);
  }

  /** Returns the factor by which the dispersion increases variances [1], at least 1: a smaller dispersion is due to
   * chance. */
  double
  Widening() const
  {
    return std::max(1.0, phi);
  }

  /** Computes the flicker, v' r_t / v' G v with v = (-m, 1), for the offset \a m minus the centre [DN]. */
  void
  UseOffset(double m);
};

/** Fits the line. With the change of frame t by the illumination u_t - mean = a_t + d_t mean, flicker about the offset
 * means a_t = -mu d_t. The maximum over m of
 *
 *     J(m) = sum_t (v' r_t)^2 / (v' G v),   v = (-m, 1),
 *
 * is the maximum-likelihood line with errors in both variables, a generalised eigenvector of sum r r' and G. The
 * second eigenvalue over T - 2 is the dispersion phi. The interval is {m: J(m) >= max J - t^2 phi}, which may be
 * unbounded; t is Student's quantile for T - 2 degrees of freedom. Estimator.md, 3.3. Null if G is not positive, or if
 * the level cannot be distinguished from motion. */
SensorNoise_EXPORT std::optional<OffsetLine>
FitOffsetLine(const FrameEquations & equations);

/** Fits the line to the gradient classes 0 ... c for every c, and returns the line with the smallest standard error,
 * widened by the dispersion, and its difference to the lines of fewer classes. If there is none, because the scene is a
 * ramp or has one level, the flicker alone is estimated, about the darkest level. Null if this fails, too. The
 * orthonormal series \a without, frames x n, are removed from the changes of the frames. */
SensorNoise_EXPORT std::optional<OffsetLine>
FitOffsetLine(const FrameSums &           sums,
              const RegressorNoise &      noise,
              const std::vector<double> & gamma = {},
              const Eigen::MatrixXd &     without = {});

/** Frames whose dark offset differs from the others. */
struct FrameOffsets
{
  std::vector<std::size_t> unlike;        ///< numbers of the frames, from 0
  double                   stepDn{ 0.0 }; ///< median difference of their offset from the others [DN]
};

/** Finds the frames whose dark offset differs from the others: their level deviates by the same amount at all signals.
 *
 * Under another illumination the level of a frame at the centre changes by -gamma m, m the offset minus the centre. A
 * frame of another dark offset deviates from this line. At least half of the frames are about one line, which is
 * fitted for all possible \a offsets minus the centre [DN]. A frame is unlike the others if it is so for all offsets
 * that fit about equally well. \a leastStepDn is the smallest step that is reported [DN]. The result is empty where
 * levels do not differ, or where the level could be due to motion. Estimator.md, 3.3. */
SensorNoise_EXPORT FrameOffsets
FindFrameOffsets(const OffsetLine & line, const ValueRange & offsets, double leastStepDn);

} // namespace sensornoise

#endif
