// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_series_MotionSeries_h
#define sensornoise_series_MotionSeries_h

#include "SensorNoiseExport.h"
#include "base/Eigen.h"
#include "series/FrameEquations.h"
#include "series/FrameSums.h"

#include <array>
#include <cstddef>
#include <optional>
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

/** Deviation of the shifts of 16 blocks of the frame from the shifts of the frame, relative to them. It is large where
 * a part of the frame does not move with the scene, or where a change of the illumination resembles motion. */
struct DeviationOfBlocks
{
  double rms{ 0.0 };   ///< rms deviation, beyond chance and weighted by the squared derivatives; 0: not significant [1]
  double error{ 0.0 }; ///< error of the shifts of the frame, if the deviations of the blocks are independent [1]
};

/** Shifts of every frame times (1 + gamma_t), estimated by instrumental variables. */
struct InstrumentShifts
{
  Eigen::MatrixX2d coefficients; ///< shifts times (1 + gamma_t), frames x (x, y) [pixel]
  Eigen::Matrix2d  covariance;   ///< covariance of one frame, with the noise of the flicker that is subtracted
                                 ///< [pixel^2]
  /** Shifts along x and y that imitate a change of the level by 1 DN, and a change of the contrast by 1 [pixel/DN,
   * pixel]. */
  Eigen::Matrix2d ofIllumination;
  /** Relative error common to all shifts along x, and along y, by the approximation of derivatives by differences of
   * pixels [1]. */
  Eigen::Vector2d                  scaleErrors;
  std::array<DeviationOfBlocks, 2> ofBlocks; ///< along x and y
};

/** Solves for the shifts with the smoothed derivatives as instruments.
 *
 * Least squares underestimates strong vibrations by 2 to 15 %, because they blur the mean, most where the scene is
 * sharp. Instruments of long wavelengths are hardly affected. For the third order they use the difference between a
 * central difference and a derivative, not the result of least squares, which depends on the sharp edges. The shift
 * along an axis whose first derivative is not active is 0. Estimator.md, 3.3. Null if neither is active, or if the
 * instruments do not determine the shifts. */
SensorNoise_EXPORT std::optional<InstrumentShifts>
SolveShifts(const FrameSums &           sums,
            const FrameEquations &      equations,
            const MotionSeries &        motion,
            const InstrumentNoise &     noise,
            const std::vector<double> & gamma,
            double                      offset);

} // namespace sensornoise

#endif
