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
 * \brief Two-sided trimming of sample variances at the tail probability trimTail each, unless another is asked
 * for, and its bias: a trimmed mean of chi-square variables of k degrees of freedom is (F_{k+2}(b) - F_{k+2}(a)) /
 * (F_k(b) - F_k(a)) of the mean. */
class SensorNoise_EXPORT ChiSquareTrim
{
public:
  /** For degrees of freedom from \a lowest to \a highest. */
  ChiSquareTrim(double lowest, double highest, double tail = InPixels.trimTail);

  struct Limits
  {
    double low;    ///< a variance below it is trimmed, relative to the expected one
    double high;   ///< one above it is trimmed
    double mean;   ///< of those that are kept
    double median; ///< of all
  };
  const Limits &
  Of(double freedom) const
  {
    const auto k = static_cast<std::size_t>(std::max(1.0, freedom + 0.5));
    return m_Limits[std::min(m_Limits.size() - 1, k - std::min(k, m_First))];
  }

private:
  std::size_t         m_First;
  std::vector<Limits> m_Limits;
};

} // namespace sensornoise

#endif
