// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_base_PolynomialFit_h
#define sensornoise_base_PolynomialFit_h

#include "SensorNoiseExport.h"
#include "sensornoise/Parallel.h"

#include <cmath>
#include <cstddef>
#include <cstdint>

namespace sensornoise
{

/** Frame-sized maps of a regression: variance [DN^2] against mean [DN] over the pixels of the mask. */
struct RegressionData
{
  const double *       mean;     ///< means over time [DN]
  const double *       variance; ///< variances over time [DN^2]; not finite: unknown
  const std::uint8_t * mask;     ///< nonzero at the pixels to be used
  std::size_t          pixels;   ///< number of pixels of a map

  /** Returns whether a pixel is used: it is in the mask and its variance is finite. */
  bool
  Has(std::size_t p) const
  {
    return mask[p] != 0 && std::isfinite(variance[p]);
  }
};

/** variance = intercept + slope mean + curvature mean^2. */
struct PolynomialFit
{
  double intercept{ 0.0 };           ///< variance at the mean 0 [DN^2]
  double slope{ 0.0 };               ///< slope at the mean 0 [DN]
  double curvature{ 0.0 };           ///< quadratic coefficient [1]; 0 for a line
  double curvatureUnitSd{ 0.0 };     ///< standard error of the curvature if the residuals, times root weight, have sd 1
  std::size_t pixels{ 0 };           ///< number of pixels that were used
  bool        isDetermined{ false }; ///< false: too few pixels, or one intensity only
};

/** Fits a line by ordinary regression of the variance on the mean. The slope is the gain g and the intercept sigma^2 -
 * g mu, (3.24) of Sur & Gredi\'ac 2015 (https://doi.org/10.1137/140977035). The result has the same bits for any
 * number of threads. */
SensorNoise_EXPORT PolynomialFit
FitLine(const RegressionData & data, const ParallelFor & parallelFor = SerialFor);

/** The line of FitLine(), and the parabola (2.21) by ordinary regression. The curvature of the parabola is
 * sigma_gamma^2 if the variance is not corrected. */
struct LineAndParabola
{
  PolynomialFit line;
  PolynomialFit parabola;
};

/** Fits the line and the parabola in one pass over the maps. */
SensorNoise_EXPORT LineAndParabola
FitLineAndParabola(const RegressionData & data, const ParallelFor & parallelFor = SerialFor);

/** Quality of the fit of a line to the corrected variance. */
struct FitQuality
{
  double reducedChi2{ 1.0 }; ///< mean of (v - V)^2 / (2 V^2 / (T-1)) [1]; 1: sampling noise alone
  double curvature{ 0.0 };   ///< quadratic coefficient, weights 1/V^2 [1]
  double curvatureZ{ 0.0 };  ///< curvature over its standard error, which is multiplied by the square root of
                             ///< reducedChi2 if that is > 1 [1]
};

/** Computes the quality of the fit of \a line. A sample variance of T frames has the variance 2 V^2 / (T-1), with V the
 * value of the line. */
SensorNoise_EXPORT FitQuality
EvaluateLineFit(const RegressionData & data,
                const PolynomialFit &  line,
                std::size_t            frames,
                const ParallelFor &    parallelFor = SerialFor);

} // namespace sensornoise

#endif
