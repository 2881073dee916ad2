// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_series_FrameEquations_h
#define sensornoise_series_FrameEquations_h

#include "SensorNoiseExport.h"
#include "base/Eigen.h"
#include "sensornoise/Parallel.h"
#include "series/FrameRegressors.h"
#include "series/FrameSums.h"

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

namespace sensornoise
{

/** Sums over the pixels of each gradient class that determine the contribution of the noise of the regressors to the
 * normal equations. With weights w they are the sums of w V (V the noise variance of a frame) and of w g q (g q its
 * part that scales with the illumination). */
struct RegressorNoise
{
  std::array<double, GradientClasses> variance{}; ///< sum of w V [1]
  std::array<double, GradientClasses> shot{};     ///< sum of w g q [1]
  /** Covariance of the right-hand sides for each class, see CovarianceOfProducts(). Empty: w V is 1, and the raw Gram
   * matrix is the covariance. */
  std::vector<FrameSums::ClassMatrix> ofProducts;
};

/** Normal equations of the regression of every frame on the active columns. */
struct SensorNoise_EXPORT FrameEquations
{
  std::vector<std::size_t> active;     ///< columns: 0 and 1 (illumination), then 2 + index in MotionStencils (motion)
  Eigen::MatrixXd          rawGram;    ///< Gram matrix with the noise of the regressors
  Eigen::MatrixXd          gram;       ///< Gram matrix without the noise of the regressors
  Eigen::MatrixXd          right;      ///< right-hand sides, frames x active
  Eigen::MatrixXd          allRawGram; ///< raw Gram matrix of all columns, active or not
  Eigen::MatrixXd          allGram;    ///< Gram matrix of all columns, without the noise of the regressors
  Eigen::MatrixXd          allRight;   ///< right-hand sides of all columns, frames x columns
  Eigen::Matrix2d  illumination;       ///< Gram matrix of columns 0 and 1, the motion partialled out (Schur complement)
  Eigen::MatrixX2d response;           ///< right-hand sides of columns 0 and 1, the motion partialled out, frames x 2
  /** Whether a level that all pixels have in common cannot be distinguished from motion: the scene is a ramp, with the
   * same derivatives everywhere. Then `illumination` and `response` hold column 1 alone, all else partialled out. */
  bool isLevelMotion{ false };

  /** Returns the place of a column among the active columns. */
  std::optional<std::size_t>
  Find(std::size_t column) const;
};

/** Makes the normal equations of all frames over the gradient classes 0 ... \a lastClass. Estimator.md, 3.3.
 *
 * The columns are computed from the mean, whose noise has the variance V / T. It adds sum w V / T times the inner
 * products of the kernels to the Gram matrix, which is subtracted. Where the noise of a frame differs from the average
 * by gamma_t g q, its product with the centre weight of a column adds to the right-hand side. This is subtracted where
 * \a gamma is given. Stacks of fewer than 20 frames have no third order. If the two first derivatives are proportional,
 * as on a ramp across the frame, the weaker is left out. Where \a noise has the covariance C of the right-hand sides
 * r_t, `illumination` and `response` are weighted by it. With the Gram matrix G, they are G C^-1 G and G C^-1 r_t:
 * again, the first is the covariance of the second. */
SensorNoise_EXPORT FrameEquations
MakeFrameEquations(const FrameSums &           sums,
                   const RegressorNoise &      noise,
                   std::size_t                 lastClass,
                   const std::vector<double> & gamma = {});

/** Returns the covariance of the products of one frame with the columns (FrameSums) for each gradient class: the sum of
 * w^2 V X X' over its pixels, with the variances that the pixels have. It holds whether or not the weights are the
 * inverse variances (White 1980, DOI 10.2307/1912934).
 * \param variance variance of every pixel [DN^2]; a pixel with another value than a finite one has the variance of the
 * initial noise model */
SensorNoise_EXPORT std::vector<FrameSums::ClassMatrix>
CovarianceOfProducts(const FrameRegressors & regressors, const PixelMap & variance, const ParallelFor & parallelFor);

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
