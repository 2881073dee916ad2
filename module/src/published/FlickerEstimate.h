// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_published_FlickerEstimate_h
#define sensornoise_published_FlickerEstimate_h

#include "SensorNoiseExport.h"
#include "base/RollingShutter.h"
#include "published/FlickerSums.h"
#include "published/IsoIntensitySet.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace sensornoise
{

/** Flicker and offset of a stack, sections 3.2 and 3.5 of Sur & Gredi\'ac 2015. */
struct FlickerEstimate
{
  std::vector<double> brightRatio;      ///< v^*(t), (3.8) [1]
  std::vector<double> darkResidualDn;   ///< v_*(t), (3.14) [DN]
  double              slopeDn{ 0.0 };   ///< K, slope of v_* against v^* - 1 [DN]
  double              offsetDn{ 0.0 };  ///< mu, (3.16) [DN]
  std::vector<double> gamma;            ///< gamma_t of the whole frame, (3.17) [1]
  double              flickerSd{ 0.0 }; ///< standard deviation of gamma_t over time (by row: root mean square) [1]

  double                    sigmaRows{ 0.0 }; ///< sigma_y [rows]; 0: no gamma_t(y)
  std::size_t               rows{ 1 };        ///< rows of gammaRows, or 1
  std::vector<double>       gammaRows;        ///< gamma_t(y), frame by frame; empty: no gamma_t(y)
  std::vector<std::uint8_t> rowKnown;         ///< per row: whether the row set reaches it; empty: all known

  /** How many standard deviations of its sampling noise the variance of v^* exceeds that noise by; may be infinite. */
  double flickerZ{ 0.0 };
  /** Residual variance of v_* about the line, over that expected of noise: 1 if the model holds. */
  double offsetLinePhi{ 1.0 };

  /** gamma_t, or gamma_t(y) where it is modelled. */
  double
  Gamma(std::size_t t, std::size_t row) const
  {
    return gammaRows.empty() ? gamma[t] : gammaRows[t * rows + row];
  }
  bool
  IsKnown(std::size_t row) const
  {
    return rowKnown.empty() || rowKnown[row] != 0;
  }
};

/** The mean: of at least 1 value. */
SensorNoise_EXPORT double
Mean(const std::vector<double> & values);

/** The unbiased variance: of at least 2 values. */
SensorNoise_EXPORT double
SampleVariance(const std::vector<double> & values);

/** K, mu and gamma_t from the sums over S^* and S_*, (3.8) to (3.17); with \a mode also gamma_t(y), (3.28).
 *
 * K is the slope of the ordinary regression of v_* on v^* - 1; both have mean 0 by construction. K and mu always come
 * from the whole frames (section 3.5 keeps the image-wide procedure). \a sigmaRows is sigma_y for the mode Fixed. */
SensorNoise_EXPORT FlickerEstimate
EstimateFlicker(const FlickerSums &     sums,
                const IsoIntensitySet & bright,
                const IsoIntensitySet & dark,
                RollingShutter          mode,
                double                  sigmaRows);

} // namespace sensornoise

#endif
