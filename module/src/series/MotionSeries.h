// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_series_MotionSeries_h
#define sensornoise_series_MotionSeries_h

#include "SensorNoiseExport.h"
#include "base/Eigen.h"
#include "series/FrameEquations.h"
#include "series/FrameSums.h"

#include <cstddef>
#include <vector>

namespace sensornoise
{

/** Coefficients of the derivatives of the mean in every frame. Each is approximately (1 + gamma_t) times a monomial of
 * the shift, of the order of the derivative [pixel^order]. */
struct SensorNoise_EXPORT MotionSeries
{
  std::vector<std::size_t> stencils;     ///< indices of the derivatives in MotionStencils()
  Eigen::MatrixXd          coefficients; ///< coefficients, frames x stencils [pixel^order]
  Eigen::MatrixXd          covariance;   ///< covariance of the coefficients of one frame
  Eigen::MatrixXd          inverseGram;  ///< inverse Gram matrix of the regression
  /** Coefficients that imitate a change of the level by 1 DN, and a change of the contrast by 1; stencils x 2. */
  Eigen::MatrixX2d ofIllumination;
  /** If only one of the first derivatives is active: the shift along its axis that imitates a shift by 1 along the
   * other axis [1]; 0: both are active, or neither. */
  double ofOtherAxis{ 0.0 };

  /** Returns the coefficient of stencil \a k in frame \a t; 0 where it is not active. */
  double
  Get(std::size_t t, std::size_t k) const;
};

/** Solves the equations of the frames for the motion, given the flicker \a gamma [1] and the \a offset minus the centre
 * of the regression [DN]. */
SensorNoise_EXPORT MotionSeries
SolveMotion(const FrameEquations & equations, const std::vector<double> & gamma, double offset);

/** Returns the relative errors of the shifts of \a motion along x and y that come from the approximation of derivatives
 * by differences of pixels [1]; 0 where a first derivative is not active. Each gradient class gives shifts with the
 * first derivative alone. The error is the rms deviation of these shifts from \a motion, weighted by the squared
 * derivatives of the class. It is small where the scene is smooth, and large where edges are sharper than a pixel. */
SensorNoise_EXPORT Eigen::Vector2d
ScaleErrorsOf(const FrameSums &           sums,
              const RegressorNoise &      noise,
              const MotionSeries &        motion,
              const std::vector<double> & gamma,
              double                      offset);

} // namespace sensornoise

#endif
