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
#include "sensornoise/pixels/ChiSquareTrim.h"

#include "sensornoise/base/ChiSquare.h"

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
