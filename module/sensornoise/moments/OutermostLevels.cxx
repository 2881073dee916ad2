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
#include "sensornoise/moments/OutermostLevels.h"

#include "sensornoise/base/Quantiles.h"
#include "sensornoise/moments/PileUp.h"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <vector>

namespace sensornoise
{

void
OutermostLevels::Insert(double outwards)
{
  ++m_Counts[outwards];
  if (m_Counts.size() > MostLevels)
  {
    m_Counts.erase(std::prev(m_Counts.end()));
  }
  m_Innermost = m_Counts.rbegin()->first;
}

double
OutermostLevels::Step() const
{
  std::vector<double> spacings;
  for (auto inner = m_Counts.begin(); inner != m_Counts.end(); ++inner)
  {
    if (inner != m_Counts.begin())
    {
      spacings.push_back(std::prev(inner)->first - inner->first);
    }
  }
  return spacings.empty() ? 0.0 : Quantile(spacings, 0.1);
}

std::size_t
OutermostLevels::MostInside(double stepDn) const
{
  std::size_t most = 0;
  if (!m_Counts.empty())
  {
    // Half a step more: spacings of rescaled codes differ in the last digits.
    const double reach = m_Counts.begin()->first - (LevelsInsidePileUp + 0.5) * stepDn;
    for (auto level = std::next(m_Counts.begin()); level != m_Counts.end() && level->first >= reach; ++level)
    {
      most = std::max(most, level->second);
    }
  }
  return most;
}

} // namespace sensornoise
