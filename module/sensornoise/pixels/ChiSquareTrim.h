/*=========================================================================
 *
 *  Copyright the ITKSensorNoise contributors
 *
 *  Licensed under the Apache License, Version 2.0 (the "License");
 *  you may not use this file except in compliance with the License.
 *  You may obtain a copy of the License at
 *
 *         https://www.apache.org/licenses/LICENSE-2.0.txt
 *
 *  Unless required by applicable law or agreed to in writing, software
 *  distributed under the License is distributed on an "AS IS" BASIS,
 *  WITHOUT WARRANTIES OR CONDITIONS OF ANY KIND, either express or implied.
 *  See the License for the specific language governing permissions and
 *  limitations under the License.
 *
 *=========================================================================*/
#ifndef sensornoise_pixels_ChiSquareTrim_h
#define sensornoise_pixels_ChiSquareTrim_h

#include "sensornoise/base/ChiSquare.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace sensornoise
{

/** \class ChiSquareTrim
 * \brief Two-sided trimming of sample variances at a tail probability of 1e-4 each, unless another is asked for, and
 * its bias: a trimmed mean of chi-square variables of k degrees of freedom is (F_{k+2}(b) - F_{k+2}(a)) / (F_k(b) -
 * F_k(a)) of the mean. */
class ChiSquareTrim
{
public:
  static constexpr double Tail = 1e-4;

  /** For degrees of freedom from \a lowest to \a highest. */
  ChiSquareTrim(double lowest, double highest, double tail = Tail)
    : m_First(static_cast<std::size_t>(std::max(1.0, std::round(lowest))))
  {
    for (auto k = static_cast<double>(m_First); k <= std::max(1.0, std::round(highest)); k += 1.0)
    {
      const double low = ChiSquareQuantile(tail, k);
      const double high = ChiSquareUpperQuantile(tail, k);
      m_Limits.push_back({ low / k,
                           high / k,
                           (ChiSquareCdf(high, k + 2.0) - ChiSquareCdf(low, k + 2.0)) / (1.0 - 2.0 * tail),
                           ChiSquareQuantile(0.5, k) / k });
    }
  }
  struct Limits
  {
    double low;
    double high;
    double mean;
    double median;
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
