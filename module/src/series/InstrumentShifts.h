// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_series_InstrumentShifts_h
#define sensornoise_series_InstrumentShifts_h

#include "SensorNoiseExport.h"
#include "base/Eigen.h"
#include "series/FrameEquations.h"
#include "series/FrameSums.h"
#include "series/MotionSeries.h"

#include <array>
#include <optional>
#include <vector>

namespace sensornoise
{

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
