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
 * \brief What second moments cannot tell: whether noise, and differences of neighbours' noise, have a normal
 * distribution's tails.
 *
 * A linear filter leaves normal noise normal; one that chooses (a median, the correction of what looks defective, a
 * coarse code of blocks) does not. Of each series its own scale is used, K = sum_t r^4 / (sum_t r^2)^2, so that pixels
 * of different noise do not look like tails: for normal noise E[K] = 3 sum_t P_tt^2 / (n (n + 2)), n = tr P, exactly.
 */
struct KurtosisSums
{
  /** Of the pixel; of it less its right, its lower neighbour; of the four of a square, in turn; of eight in a row, of
   * eight in a column, in turn. */
  static constexpr std::size_t Kinds = 6;

  std::array<double, Kinds> series{}; ///< how many
  std::array<double, Kinds> ratio{};  ///< of K over what it would be of normal noise

  KurtosisSums &
  operator+=(const KurtosisSums & other);
  /** Excess kurtosis [1]; 0 without series. */
  double
  Excess(std::size_t kind) const
  {
    return series[kind] > 0.0 ? 3.0 * (ratio[kind] / series[kind] - 1.0) : 0.0;
  }
};

class MixtureKurtosis;

/** K of normal noise, the same in all frames. */
SensorNoise_EXPORT double
NormalKurtosis(const NoiseResiduals & residuals);
/** The sums of a tile; \a normal is what normal noise has. */
SensorNoise_EXPORT KurtosisSums
KurtosisOfTile(const NoiseResiduals & residuals, std::size_t i, const MixtureKurtosis & normal);

} // namespace sensornoise

#endif
