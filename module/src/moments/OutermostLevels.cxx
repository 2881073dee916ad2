// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "moments/OutermostLevels.h"

#include "base/Quantiles.h"
#include "moments/Constants.h"
#include "moments/PileUp.h"

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
  return spacings.empty() ? 0.0 : Quantile(spacings, InMoments.stepQuantile);
}

std::size_t
OutermostLevels::MostInside(double stepDn) const
{
  return m_Counts.empty() ? 0 : this->MostInside(m_Counts.begin(), stepDn);
}

std::size_t
OutermostLevels::MostInside(Counts::const_iterator end, double stepDn) const
{
  std::size_t most = 0;
  // Half a step more: spacings of rescaled codes differ in the last digits.
  const double reach = end->first - (InMoments.levelsInsidePileUp + 0.5) * stepDn;
  for (auto level = std::next(end); level != m_Counts.end() && level->first >= reach; ++level)
  {
    most = std::max(most, level->second);
  }
  return most;
}

void
OutermostLevels::LeaveOutStray(double stepDn)
{
  double beyond = 0.0;
  for (auto level = m_Counts.begin(); level != m_Counts.end(); ++level)
  {
    const auto pixels = static_cast<double>(level->second);
    const bool isApart = level != m_Counts.begin() &&
                         std::prev(level)->first - level->first > (InMoments.levelsOutsidePileUp + 0.5) * stepDn;
    if (isApart && beyond <= InMoments.largestStrayFraction * pixels &&
        IsPileUp(level->second, this->MostInside(level, stepDn)))
    {
      m_Counts.erase(m_Counts.begin(), level);
      return;
    }
    beyond += pixels;
  }
}

} // namespace sensornoise
