// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_series_FrameEquations_h
#define sensornoise_series_FrameEquations_h

#include "SensorNoiseExport.h"
#include "base/Eigen.h"
#include "series/FrameProducts.h"
#include "series/FrameSums.h"

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

namespace sensornoise
{

/** Sums over the pixels of each gradient class of what the noise of the regressors adds to the normal equations: with
 * weights w, of w V (V the noise variance of a frame) and of w g q (g q its part that flickers). */
struct RegressorNoise
{
  std::array<double, GradientClasses> variance{};
  std::array<double, GradientClasses> shot{};
};

/** Normal equations of the regression of every frame on the active columns. */
struct SensorNoise_EXPORT FrameEquations
{
  std::vector<std::size_t> active;     ///< columns: 0 and 1 (light), then 2 + index in MotionStencils (motion)
  Eigen::MatrixXd          rawGram;    ///< as summed
  Eigen::MatrixXd          gram;       ///< without the noise of the regressors
  Eigen::MatrixXd          right;      ///< frames x active
  Eigen::MatrixXd          allRawGram; ///< the three of all columns, active or not
  Eigen::MatrixXd          allGram;    ///< without the noise of the regressors
  Eigen::MatrixXd          allRight;   ///< frames x columns
  Eigen::Matrix2d          light;      ///< of columns 0 and 1, the motion partialled out (Schur complement)
  Eigen::MatrixX2d         response;   ///< frames x 2, the same
  /** Whether a level that all pixels share cannot be told from motion: the derivatives are the same everywhere, the
   * scene is a ramp. Then light and response hold column 1 alone, all else partialled out. */
  bool isLevelMotion{ false };

  /** Place of a column among the active ones. */
  std::optional<std::size_t>
  Find(std::size_t column) const;
};

/** The normal equations of all frames over the gradient classes 0 ... \a lastClass. Estimator.md, 3.3.
 *
 * The columns are made of the mean, whose noise has the variance V / T. It adds sum w V / T times the kernels' inner
 * products to the Gram matrix, which is taken off; and where the frame's own noise is larger or smaller than the
 * average's by gamma_t g q, its product with a column's centre weight adds to the right-hand side, which is taken off
 * where \a gamma is given. Frames fewer than 20 get no third order. Of two first derivatives that are one and the same
 * but for a factor, as on a ramp across the frame, the weaker is left out. */
SensorNoise_EXPORT FrameEquations
MakeFrameEquations(const FrameSums &           sums,
                   const RegressorNoise &      noise,
                   std::size_t                 lastClass,
                   const std::vector<double> & gamma = {});

} // namespace sensornoise

#endif
