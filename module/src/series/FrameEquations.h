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

} // namespace sensornoise

#endif
