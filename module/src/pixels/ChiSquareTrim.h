// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_pixels_ChiSquareTrim_h
#define sensornoise_pixels_ChiSquareTrim_h

#include "SensorNoiseExport.h"
#include "pixels/Constants.h"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace sensornoise
{

/** \class ChiSquareTrim
 * \brief Limits for two-sided trimming of sample variances, and the bias of the trimmed mean.
 *
 * Trimming chi-square variables of k degrees of freedom to the interval from a to b multiplies their mean by
 * (F_{k+2}(b) - F_{k+2}(a)) / (F_k(b) - F_k(a)). */
class SensorNoise_EXPORT ChiSquareTrim
{
public:
  /** Computes the limits for all whole degrees of freedom from \a lowest to \a highest, 1 or more. \a tail is the
   * probability of each trimmed tail [1]. */
  ChiSquareTrim(double lowest, double highest, double tail = InPixels.trimTail);

  struct Limits
  {
    double low;    ///< variances below it are trimmed, relative to the expected variance [1]
    double high;   ///< variances above it are trimmed, relative to the expected variance [1]
    double mean;   ///< mean of the variances that are kept, relative to the expected variance [1]
    double median; ///< median of all variances, relative to the expected variance [1]
  };
  /** Returns the limits for the degrees of freedom in the table that are nearest to \a freedom. */
  const Limits &
  Of(double dof) const
  {
    const auto k = static_cast<std::size_t>(std::max(1.0, dof + 0.5));
    return m_Limits[std::min(m_Limits.size() - 1, k - std::min(k, m_First))];
  }

private:
  std::size_t         m_First;
  std::vector<Limits> m_Limits;
};

} // namespace sensornoise

#endif
