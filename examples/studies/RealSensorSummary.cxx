// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "studies/RealSensorSummary.h"

#include "studies/RealSensorDemands.h"
#include "studies/RealSensorFormat.h"
#include "studies/RealSensorStatistics.h"

#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <limits>
#include <string>

namespace sensornoise::tools
{
namespace
{
constexpr double      ImprobableSetting = 0.001;
constexpr double      LargestCoverage = 0.99;
constexpr std::size_t EnoughStacks = 200;

std::vector<RealSensorOutcome>
OutcomesOf(const std::vector<RealSensorGroup> & groups)
{
  std::vector<RealSensorOutcome> all;
  for (const RealSensorGroup & group : groups)
  {
    all.insert(all.end(), group.outcomes.begin(), group.outcomes.end());
  }
  return all;
}

std::string
FullNameOf(const RealSensorSetting & setting)
{
  return std::string(NameOf(setting.scene)) + ", " + setting.name + ", " + std::to_string(setting.settings.frames) +
         " frames";
}

/** The smallest lower tail of the single settings, and how many are improbable. */
void
PrintWorstSetting(const std::vector<RealSensorGroup> & groups, const std::vector<Share> & shares)
{
  std::size_t worst = 0;
  std::size_t counting = 0;
  std::size_t improbable = 0;
  double      least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < groups.size(); ++k)
  {
    if (shares[k].count > 0)
    {
      const double tail = BinomialLowerTail(shares[k], NominalCoverage);
      ++counting;
      improbable += tail < ImprobableSetting ? 1 : 0;
      worst = tail < least ? k : worst;
      least = std::min(least, tail);
    }
  }
  std::printf("      smallest p (lower tail) of a single setting %.2g (%s: %s); below %g: %zu of %zu settings\n",
              least,
              FormatShare(shares[worst]).c_str(),
              FullNameOf(groups[worst].setting).c_str(),
              ImprobableSetting,
              improbable,
              counting);
}

/** Intervals that hold far more often than they say are no fault, but wider than need be: shown if it is no chance. */
const char *
VerdictOf(const RealSensorDemand & demand, const Share & all)
{
  if (all.count == 0)
  {
    return "no stack counts";
  }
  if (all.Get() < demand.lowestShare)
  {
    return "MISS";
  }
  return demand.isCoverage && all.Get() > LargestCoverage && all.count >= EnoughStacks ? "ok, above 99 %" : "ok";
}

void
PrintDemand(const RealSensorDemand & demand, const std::vector<RealSensorGroup> & groups)
{
  Share              all;
  std::vector<Share> single(groups.size());
  for (std::size_t k = 0; k < groups.size(); ++k)
  {
    for (const RealSensorOutcome & outcome : groups[k].outcomes)
    {
      const auto isMet = demand.test(groups[k].setting, outcome);
      single[k].Add(isMet);
      all.Add(isMet);
    }
  }
  std::printf("  %-58s %11s %6s %%  expected %s %g %%: %s\n",
              demand.what.c_str(),
              FormatShare(all).c_str(),
              FormatPercent(all).c_str(),
              demand.lowestShare < 1.0 ? "at least" : "all,",
              100.0 * demand.lowestShare,
              VerdictOf(demand, all));
  if (demand.isCoverage && all.count > 0)
  {
    PrintWorstSetting(groups, single);
  }
}
} // namespace

void
PrintLineSummary(const RealSensorLine & line, const std::vector<RealSensorGroup> & groups)
{
  const auto all = OutcomesOf(groups);
  const auto refused = CountRefused(all);
  std::printf("%s, all settings together: %zu stacks, refused %zu (%s %%)\n",
              line.name.c_str(),
              all.size(),
              refused.met,
              FormatPercent(refused).c_str());
  for (const auto quantity :
       { JudgedQuantity::Gain, JudgedQuantity::Offset, JudgedQuantity::Flicker, JudgedQuantity::ReadNoise })
  {
    const auto statistics = Judge(all, quantity);
    std::printf(
      "  %-10s identified %zu, interval holds %9s = %5s %%, rms z %s, mean z %s, mean s.e. %s %%, bias %s %%; "
      "limit holds %s\n",
      NameOf(quantity),
      statistics.held.count,
      FormatShare(statistics.held).c_str(),
      FormatPercent(statistics.held).c_str(),
      FormatNumber(statistics.rmsZ, "%.2f").c_str(),
      FormatNumber(statistics.meanZ, "%+.2f").c_str(),
      FormatNumber(statistics.errorPercent, "%.3g").c_str(),
      FormatNumber(statistics.biasPercent, "%+.3g").c_str(),
      FormatShare(statistics.limitsHeld).c_str());
  }
  for (const RealSensorDemand & demand : GetDemands(line.name))
  {
    PrintDemand(demand, groups);
  }
  std::fflush(stdout);
}

} // namespace sensornoise::tools
