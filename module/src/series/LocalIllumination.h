// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_series_LocalIllumination_h
#define sensornoise_series_LocalIllumination_h

#include "SensorNoiseExport.h"
#include "base/Constants.h"
#include "base/Eigen.h"
#include "series/Constants.h"
#include "series/FrameSums.h"
#include "series/FrameEquations.h"

#include <cstddef>
#include <vector>

namespace sensornoise
{

// Noise of the signal of cells of the frame, which differs from frame to frame if the illumination does. The variance
// of a cell of mean signal q is proportional to g q (1 + gamma_t) + sigma^2. It is therefore proportional to 1 + b
// gamma_t, with the shot-noise fraction b = k q / (1 + k q), k = g / sigma^2. Estimator.md, 3.4.

/** Estimates the shot-noise fraction b of every cell [1], 0 to 1.
 *
 * The one parameter k maximises the restricted likelihood of normal noise, which is the likelihood of the residuals of
 * the series without the constant and the basis. Each cell has its own scale.
 * \param whole series of the cells, frames x cells, in any unit
 * \param basis orthonormal columns that the series may contain, beside the constant, frames x columns
 * \param gamma relative illumination of the frames minus 1 [1], one each
 * \param signal mean signal of the cells, in one unit, one each */
SensorNoise_EXPORT Eigen::VectorXd
EstimateShotFractions(const Eigen::MatrixXd & whole,
                      const Eigen::MatrixXd & basis,
                      const Eigen::VectorXd & gamma,
                      const Eigen::VectorXd & signal);

/** Divides the series of the cells by their noise and projects the constant and the basis out of each, by weighted
 * least squares. The noise of the residuals is white for any illumination.
 * \param whole series of the cells, frames x cells, in units of their noise at gamma = 0
 * \param basis, gamma as for EstimateShotFractions()
 * \param fractions shot-noise fractions of the cells [1] */
SensorNoise_EXPORT Eigen::MatrixXd
WhitenedResiduals(const Eigen::MatrixXd & whole,
                  const Eigen::MatrixXd & basis,
                  const Eigen::VectorXd & gamma,
                  const Eigen::VectorXd & fractions);

/** Returns orthonormal columns that span \a columns without the constant. The order is kept, so that each direction is
 * the part of a column that is orthogonal to the columns before. Columns that add less than 1e-6 of their length are
 * dropped, and so are columns beyond \a most. */
SensorNoise_EXPORT Eigen::MatrixXd
Orthonormalise(const Eigen::MatrixXd & columns, Eigen::Index most);

/** Returns the median of the eigenvalues of Z'Z / long side, Z white noise of variance 1, \a ratio = short / long side,
 * by the law of Marchenko and Pastur. */
SensorNoise_EXPORT double
MedianNoiseEigenvalue(double ratio);

/** Dispersion over the cells of the size of the global flicker: where excitation light bleaches a spot, or a light
 * source that illuminates a part of the frame flickers. Its temporal component is the global flicker, so that it is no
 * further component.
 */
struct Unevenness
{
  double size{ 0.0 }; ///< dispersion relative to the mean size, beyond noise [1]
  double z{ 0.0 };    ///< its significance, in standard deviations of chi-square [1]

  /** Returns whether the flicker differs between the cells by size and significance. */
  bool
  Counts() const
  {
    return size > InSeries.leastUnevenness && z > Significance.manyTests;
  }
};

/** Local changes of the illumination, which differ over the frame: bands of a rolling shutter, a second light source, a
 * spot that bleaches, or an offset that drifts. */
struct LocalIllumination
{
  Eigen::MatrixXd series; ///< frames x factors
  /** Ratio of the largest eigenvalue to the edge of the noise [1]: the variation of the signal of the cells relative to
   * one global series and noise. */
  double excess{ 0.0 };
  /** Ratio to the edge of the largest eigenvalue that is left [1], if the largest allowed number of series was found;
   * 0: fewer were found, or none is left. */
  double     beyond{ 0.0 };
  Unevenness unevenness;

  /** Returns whether the illumination changes differently over the frame. */
  bool
  IsLocal() const
  {
    return series.cols() > 0 || unevenness.Counts();
  }
};

/** Finds the temporal series of local changes of the illumination.
 *
 * Each cell of the frame yields its own gamma_t. After global flicker and motion, the residuals are noise, or a few
 * common series. These are the ones whose eigenvalues exceed the edge of the noise by 25 %, by the law of Marchenko
 * and Pastur. The response of every pixel to the series is free in later steps, so that the method handles bands,
 * light sources and spots of any shape alike. Components that resemble motion (\a motionColumns) do not count as
 * illumination.
 * \param offset offset minus the centre of the regression [DN]
 * \param most largest number of series
 *
 * Estimator.md, 3.4. */
SensorNoise_EXPORT LocalIllumination
FindLocalIllumination(const FrameSums &           sums,
                      const MotionSeries &        motion,
                      const Eigen::MatrixXd &     motionColumns,
                      const std::vector<double> & gamma,
                      double                      offset,
                      std::size_t                 most);

} // namespace sensornoise

#endif
