// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "moments/StackMaps.h"

#include "moments/Constants.h"
#include "base/Quantiles.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <map>
#include <numeric>
#include <utility>
#include <vector>

namespace sensornoise
{

DnHistogram::DnHistogram()
  : m_Counts(RoomBelowZero + 65536, 0)
{}

std::vector<std::int32_t>
DnHistogram::Occupied() const
{
  std::vector<std::int32_t> valuesDn;
  for (std::size_t i = 0; i < m_Counts.size(); ++i)
  {
    if (m_Counts[i] > 0)
    {
      valuesDn.push_back(static_cast<std::int32_t>(i) - RoomBelowZero);
    }
  }
  return valuesDn;
}

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
  // Half a step more: spacings of rescaled digital numbers differ in the last digits.
  const double reach = end->first - (InMoments.levelsInsideClip + 0.5) * stepDn;
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
                         std::prev(level)->first - level->first > (InMoments.levelsOutsideClip + 0.5) * stepDn;
    if (isApart && beyond <= InMoments.largestStrayFraction * pixels &&
        IsClipLevel(level->second, this->MostInside(level, stepDn)))
    {
      m_Counts.erase(m_Counts.begin(), level);
      return;
    }
    beyond += pixels;
  }
}

double
FindQuantisationStep(const std::vector<std::int32_t> & valuesDn, bool & regular)
{
  regular = true;
  std::map<std::int32_t, std::size_t> spacings;
  for (std::size_t i = 1; i < valuesDn.size(); ++i)
  {
    ++spacings[valuesDn[i] - valuesDn[i - 1]];
  }
  const auto majority = std::max_element(
    spacings.begin(), spacings.end(), [](const auto & a, const auto & b) { return a.second < b.second; });
  if (majority == spacings.end())
  {
    return 1.0;
  }
  std::int32_t step = majority->first;
  if (2 * majority->second < valuesDn.size())
  {
    // No majority: few digital numbers, far apart. The greatest common divisor of all spacings is a step.
    step = 0;
    for (const auto & spacing : spacings)
    {
      step = std::gcd(step, spacing.first);
    }
  }
  std::map<std::int32_t, std::size_t> remainders;
  for (const std::int32_t valueDn : valuesDn)
  {
    ++remainders[((valueDn % step) + step) % step];
  }
  std::size_t onGrid = 0;
  for (const auto & remainder : remainders)
  {
    onGrid = std::max(onGrid, remainder.second);
  }
  regular = static_cast<double>(valuesDn.size() - onGrid) <=
            InMoments.largestOffGridFraction * static_cast<double>(valuesDn.size()) + InMoments.offGridNumbers;
  return step;
}

namespace
{
/** Approximate number of local steps in the table; neighbouring steps have three quarters of their distances in common.
 */
constexpr std::size_t StepsInTable = 256;

/** Distance between two neighbouring digital numbers. */
struct DnDistance
{
  double levelDn; ///< halfway between them
  double stepDn;
};

std::vector<DnDistance>
DistancesOf(const std::vector<DnCount> & counts)
{
  std::vector<DnDistance> distances;
  for (std::size_t i = 1; i < counts.size(); ++i)
  {
    if (std::min(counts[i - 1].pixels, counts[i].pixels) >= InMoments.leastPixelsPerNumber)
    {
      distances.push_back({ 0.5 * (counts[i - 1].valueDn + counts[i].valueDn),
                            static_cast<double>(counts[i].valueDn - counts[i - 1].valueDn) });
    }
  }
  return distances;
}

/** Returns the greatest common divisor of all distances [DN]. */
double
UnitOf(const std::vector<DnDistance> & distances)
{
  std::int32_t unit = 0;
  for (const DnDistance & distance : distances)
  {
    unit = std::gcd(unit, static_cast<std::int32_t>(distance.stepDn));
  }
  return unit;
}

/** Quantization step as a linear function of the level, from some neighbouring distances. */
struct Stretch
{
  QuantisationSteps::Local middle{};
  double                   slope{ 0.0 }; ///< change of the step with the level [1]
  double addedDn2{ 0.0 }; ///< variance added by rounding to the unit after the digital numbers were expanded [DN^2]

  QuantisationSteps::Local
  At(double levelDn) const
  {
    const double stepDn = std::max(0.0, middle.stepDn + slope * (levelDn - middle.levelDn));
    return { levelDn, stepDn, stepDn * stepDn / 12.0 + addedDn2 };
  }
};

/** Fits a Stretch to \a count distances. Where they differ, the digital numbers were rounded to the unit after they
 * were expanded, which adds noise. */
Stretch
StretchOf(const DnDistance * first, std::size_t count, double unitDn)
{
  std::vector<double> steps(count);
  std::transform(first, first + count, steps.begin(), [](const DnDistance & distance) { return distance.stepDn; });
  const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(count / 2);
  std::nth_element(steps.begin(), middle, steps.end());
  const double median = *middle;
  const double reach = std::max(unitDn, InMoments.largestRelativeDifference * median);
  double       kept = 0.0, level = 0.0, step = 0.0, squares = 0.0, products = 0.0;
  bool         isRounded = false;
  for (std::size_t i = 0; i < count; ++i)
  {
    if (std::abs(first[i].stepDn - median) <= reach)
    {
      const double x = first[i].levelDn - first->levelDn;
      kept += 1.0;
      level += x;
      step += first[i].stepDn;
      squares += x * x;
      products += x * first[i].stepDn;
      isRounded = isRounded || first[i].stepDn != median;
    }
  }
  Stretch      stretch;
  const double spread = squares - level * level / kept;
  stretch.slope = spread > 0.0 ? (products - level * step / kept) / spread : 0.0;
  stretch.addedDn2 = isRounded ? unitDn * unitDn / 12.0 : 0.0;
  stretch.middle.stepDn = step / kept;
  stretch.middle.levelDn = first->levelDn + level / kept;
  stretch.middle = stretch.At(stretch.middle.levelDn);
  return stretch;
}

/** Returns whether the steps differ by more than rounding explains for equal steps. A few steps at either end of the
 * sorted table are ignored. */
bool
Differ(const std::vector<QuantisationSteps::Local> & table, double unitDn)
{
  std::vector<double> steps(table.size());
  std::transform(table.begin(), table.end(), steps.begin(), [](const auto & local) { return local.stepDn; });
  std::sort(steps.begin(), steps.end());
  const std::size_t odd = steps.size() / InMoments.oddStepsOneIn;
  const double      smallest = steps[odd];
  const double      largest = steps[steps.size() - 1 - odd];
  return largest > InMoments.leastRatioOfSteps * smallest &&
         largest - smallest >
           InMoments.leastDifferenceOfSteps * unitDn / static_cast<double>(InMoments.distancesPerStep);
}
} // namespace

QuantisationSteps::QuantisationSteps(std::vector<Local> table, double unitDn)
  : m_Table(std::move(table))
  , m_UnitDn(unitDn)
{}

double
QuantisationSteps::Interpolate(double levelDn, double Local::* value) const
{
  if (m_Table.empty())
  {
    return 0.0;
  }
  const auto above = std::upper_bound(
    m_Table.begin(), m_Table.end(), levelDn, [](double level, const Local & local) { return level < local.levelDn; });
  if (above == m_Table.begin() || above == m_Table.end())
  {
    return (above == m_Table.begin() ? m_Table.front() : m_Table.back()).*value;
  }
  const Local & low = *(above - 1);
  const Local & high = *above;
  const double  fraction = (levelDn - low.levelDn) / (high.levelDn - low.levelDn);
  return low.*value + fraction * (high.*value - low.*value);
}

QuantisationSteps
FindLocalSteps(const std::vector<DnCount> & counts)
{
  const std::vector<DnDistance> distances = DistancesOf(counts);
  const double                  unit = UnitOf(distances);
  const std::size_t             count = std::max(InMoments.distancesPerStep, 4 * distances.size() / StepsInTable);
  std::vector<QuantisationSteps::Local> table;
  std::vector<Stretch>                  ends;
  for (std::size_t first = 0; first + count <= distances.size(); first += count / 4)
  {
    const Stretch stretch = StretchOf(distances.data() + first, count, unit);
    if (table.empty() || stretch.middle.levelDn > table.back().levelDn)
    {
      table.push_back(stretch.middle);
      ends.resize(2, stretch);
      ends.back() = stretch;
    }
  }
  if (table.empty() || !Differ(table, unit))
  {
    return QuantisationSteps();
  }
  table.insert(table.begin(), ends.front().At(std::min(distances.front().levelDn, table.front().levelDn - unit)));
  table.push_back(ends.back().At(std::max(distances.back().levelDn, table.back().levelDn + unit)));
  return QuantisationSteps(std::move(table), unit);
}

} // namespace sensornoise
