// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "pixels/ChiSquareTrim.h"

#include "base/ChiSquare.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace sensornoise
{

ChiSquareTrim::ChiSquareTrim(double lowest, double highest, double tail)
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

} // namespace sensornoise
