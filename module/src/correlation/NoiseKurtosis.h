// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_correlation_NoiseKurtosis_h
#define sensornoise_correlation_NoiseKurtosis_h

#include "SensorNoiseExport.h"
#include "correlation/NoiseResiduals.h"

#include <array>
#include <cstddef>
#include <vector>

namespace sensornoise
{

/** \struct KurtosisSums
 * \brief Sums for the excess kurtosis of the noise and of its differences between neighbours.
 *
 * A linear filter leaves normal noise normal. A non-linear step does not: a median, the correction of supposed
 * defects, or coarse quantization of blocks. Second moments cannot detect it. Each series is scaled by itself, so that
 * pixels of unequal variance do not look like long tails:
 *
 *     K = sum_t r^4 / (sum_t r^2)^2,   for normal noise E[K] = 3 sum_t P_tt^2 / (n (n + 2)) with n = tr P, exactly. */
struct KurtosisSums
{
  /** Number of kinds of series: the pixel; its differences from the right and the lower neighbour; the alternating sums
   * of 2 x 2, of 8 x 1 and of 1 x 8 pixels. */
  static constexpr std::size_t Kinds = 6;

  std::array<double, Kinds> series{}; ///< number of series
  std::array<double, Kinds> ratio{};  ///< sum of K over its expectation for normal noise

  KurtosisSums &
  operator+=(const KurtosisSums & other);
  /** Returns the excess kurtosis [1]; 0 without series. */
  double
  Excess(std::size_t kind) const
  {
    return series[kind] > 0.0 ? 3.0 * (ratio[kind] / series[kind] - 1.0) : 0.0;
  }
};

class MixtureKurtosis;

/** Returns the expected K of normal noise with the same variance in all frames. */
SensorNoise_EXPORT double
NormalKurtosis(const NoiseResiduals & residuals);
/** Returns the sums of tile \a i; \a normal gives the expected K of normal noise. */
SensorNoise_EXPORT KurtosisSums
KurtosisOfTile(const NoiseResiduals & residuals, std::size_t i, const MixtureKurtosis & normal);

} // namespace sensornoise

#endif
