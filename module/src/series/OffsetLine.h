// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_series_OffsetLine_h
#define sensornoise_series_OffsetLine_h

#include "SensorNoiseExport.h"
#include "base/Eigen.h"
#include "base/Significance.h"
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

/** Offset and flicker, from the line on which the frames' changes of light lie. */
struct SensorNoise_EXPORT OffsetLine
{
  double offset{ 0.0 };                                            ///< mu minus the centre of the regression [DN]
  double standardError{ std::numeric_limits<double>::infinity() }; ///< of the offset [DN]
  double low{ -std::numeric_limits<double>::infinity() };          ///< 95 % interval, may be unbounded [DN]
  double high{ std::numeric_limits<double>::infinity() };          ///< its other end [DN]
  double phi{ 1.0 };                                               ///< dispersion about the line; 1: nothing but noise
  double flickerZ{ 0.0 };  ///< how far the flicker exceeds its noise, in standard deviations
  double precision{ 0.0 }; ///< inverse variance of one gamma_t [1]
  /** Of what the levels differ by, the share that is not the noise of their means [1]; 0: the scene has one level. */
  double              contrast{ 0.0 };
  double              sensitivity{ 0.0 }; ///< relative change of gamma_t with the offset [1/DN]
  std::vector<double> gamma;              ///< of every frame [1]
  std::size_t         lastClass{ 0 };     ///< roughest gradient class that was admitted
  /** The scene is a ramp, and the flicker was taken from its slope alone, see FrameEquations::isLevelMotion. */
  bool isLevelMotion{ false };

  Eigen::Matrix2d  light;    ///< of the equations that were used
  Eigen::MatrixX2d response; ///< frames x 2

  /** Whether the flicker tells the offset: it is seen, and so are levels that differ. */
  bool
  TellsOffset() const
  {
    return flickerZ > Significance.everyPixel && contrast > InSeries.leastContrast && std::isfinite(low);
  }

  /** What the dispersion widens variances by [1]; 1: by nothing, chance makes it smaller at times. */
  double
  Widening() const
  {
    return std::max(1.0, phi);
  }

  /** Computes the flicker, v' r_t / v' G v with v = (-m, 1), for the offset \a m (minus the centre). */
  void
  UseOffset(double m);
};

/** Fits the line. With frame t's change of light u_t - mean = a_t + d_t mean, flicker about the offset means
 * a_t = -mu d_t: the maximum over m of
 *
 *     J(m) = sum_t (v' r_t)^2 / (v' G v),   v = (-m, 1),
 *
 * is the maximum-likelihood line with errors in both variables, a generalised eigenvector of sum r r' and G. The
 * second eigenvalue over T - 2 is the dispersion phi, and {m: J(m) >= max J - t^2 phi} the interval, which may be
 * unbounded; t is Student's quantile for T - 2 degrees of freedom. Estimator.md, 3.3. Null if G is not positive, or the
 * level cannot be told from motion. */
SensorNoise_EXPORT std::optional<OffsetLine>
FitOffsetLine(const FrameEquations & equations);

/** The best line over the gradient classes: rougher ones are admitted while they reduce the standard error that the
 * dispersion widens. On a ramp the flicker tells no offset, and on a scene of one level neither. */
SensorNoise_EXPORT std::optional<OffsetLine>
FitOffsetLine(const FrameSums & sums, const RegressorNoise & noise, const std::vector<double> & gamma = {});

} // namespace sensornoise

#endif
