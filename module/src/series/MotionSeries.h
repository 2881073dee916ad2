// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_series_MotionSeries_h
#define sensornoise_series_MotionSeries_h

#include "SensorNoiseExport.h"
#include "base/Eigen.h"
#include "series/FrameEquations.h"
#include "series/FrameSums.h"

#include <cstddef>
#include <optional>
#include <vector>

namespace sensornoise
{

/** Coefficients of the derivatives of the mean in every frame: each about (1 + gamma_t) times a monomial of the shift,
 * of the order of the derivative [pixel^order]. */
struct SensorNoise_EXPORT MotionSeries
{
  std::vector<std::size_t> stencils;     ///< which derivatives, indices in MotionStencils()
  Eigen::MatrixXd          coefficients; ///< frames x stencils
  Eigen::MatrixXd          covariance;   ///< of one frame's coefficients
  Eigen::MatrixXd          inverseGram;  ///< of the regression
  /** The coefficients that a change of level by 1 DN looks like, and one of contrast by 1; stencils x 2. */
  Eigen::MatrixX2d ofLight;
  /** Where one of the first derivatives is not active: the shift along the other axis that a shift by 1 along its own
   * looks like; 0: both are active, or neither [1]. */
  double ofOtherAxis{ 0.0 };

  /** The coefficient of stencil \a k in frame \a t; 0 where it is not active. */
  double
  Get(std::size_t t, std::size_t k) const;
};

/** Solves the frames' equations for the motion, given flicker and offset (minus the centre of the regression). */
SensorNoise_EXPORT MotionSeries
SolveMotion(const FrameEquations & equations, const std::vector<double> & gamma, double offset);

/** Shifts of every frame times (1 + gamma_t), from instruments. */
struct InstrumentShifts
{
  Eigen::MatrixX2d coefficients; ///< frames x (x, y) [pixel]
  Eigen::Matrix2d  covariance;   ///< of one frame's, with the noise of the flicker that is taken off [pixel^2]
  /** The shifts, x and y, that a change of level by 1 DN looks like, and one of contrast by 1 [pixel/DN, pixel]. */
  Eigen::Matrix2d ofLight;
  /** How much of all shifts along x, and along y, differences of pixels leave open, relative to them [1]. */
  Eigen::Vector2d scaleErrors;
};

/** Solves for the shifts with the smoothed derivatives as instruments.
 *
 * Least squares underestimates strong vibrations by 2 to 15 %: the mean is blurred by them, most where the scene is
 * sharp. Instruments of long wavelengths hardly notice. Of the third order they take what a central difference lacks of
 * a derivative, not what least squares finds, which depends on the sharp edges. Estimator.md, 3.3. Null unless both
 * first derivatives are active and the instruments see both. */
SensorNoise_EXPORT std::optional<InstrumentShifts>
SolveShifts(const FrameSums &           sums,
            const FrameEquations &      equations,
            const MotionSeries &        motion,
            const InstrumentNoise &     noise,
            const std::vector<double> & gamma,
            double                      offset);

} // namespace sensornoise

#endif
