// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_series_LocalIllumination_h
#define sensornoise_series_LocalIllumination_h

#include "SensorNoiseExport.h"
#include "base/Eigen.h"
#include "series/FrameSums.h"
#include "series/MotionSeries.h"

#include <cstddef>
#include <vector>

namespace sensornoise
{

/** Orthonormal columns that span those of \a columns and the constant, the constant left out; in order, so that a
 * column's direction is what it adds to those before. Columns that add less than 1e-6 of themselves are dropped, as
 * are those beyond \a most. */
SensorNoise_EXPORT Eigen::MatrixXd
Orthonormalise(const Eigen::MatrixXd & columns, Eigen::Index most);

/** Median of the eigenvalues of Z'Z / long side, Z of white noise of variance 1, \a ratio = short / long side: by the
 * law of Marchenko and Pastur. */
SensorNoise_EXPORT double
MedianNoiseEigenvalue(double ratio);

/** Light that changes in some places in another way than in others: a rolling shutter's bands, a second lamp, a
 * spot that bleaches, or an offset that drifts. */
struct LocalIllumination
{
  Eigen::MatrixXd series; ///< frames x factors
  /** How much more the cells' light varies than one global series and noise allow: largest eigenvalue over the edge. */
  double excess{ 0.0 };
  /** Where as many series as may be were found: the largest eigenvalue that is left over the edge; 0: fewer were found,
   * or none is left. */
  double beyond{ 0.0 };
};

/** Finds the temporal series of local light.
 *
 * Each cell of the frame gives its own gamma_t: what the global flicker and the motion leave of it is noise, or a few
 * common series. Singular values above the noise's edge, by the law of Marchenko and Pastur and 25 %, tell which. The
 * response of every pixel to the series is free later on, so that bands, lamps and spots of any shape are the same to
 * the method. What resembles motion (\a motionColumns) does not count as light. At most \a most series; \a offset is
 * minus the centre of the regression. Estimator.md, 3.4. */
SensorNoise_EXPORT LocalIllumination
FindLocalIllumination(const FrameSums &           sums,
                      const MotionSeries &        motion,
                      const Eigen::MatrixXd &     motionColumns,
                      const std::vector<double> & gamma,
                      double                      offset,
                      std::size_t                 most);

} // namespace sensornoise

#endif
