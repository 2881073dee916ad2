// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_series_CellNoise_h
#define sensornoise_series_CellNoise_h

#include "SensorNoiseExport.h"
#include "base/Eigen.h"

namespace sensornoise
{

/** \file
 * Noise of the signal of cells of the frame, which differs from frame to frame if the illumination does. The variance
 * of a cell of mean signal q is proportional to g q (1 + gamma_t) + sigma^2. It is therefore proportional to 1 + b
 * gamma_t, with the shot-noise fraction b = k q / (1 + k q), k = g / sigma^2. Estimator.md, 3.4. */

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

} // namespace sensornoise

#endif
