// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "tools/SweepSettings.h"

#include "base/Text.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <set>
#include <stdexcept>

namespace sensornoise::tools
{
namespace
{
/** Returns whether the bursts record one ISO speed and exposures that differ. */
bool
RecordExposures(const std::vector<FoundBurst> & bursts)
{
  std::set<double> exposures;
  for (const FoundBurst & each : bursts)
  {
    if (!each.recordedIso || each.recordedIso != bursts.front().recordedIso || !each.recordedExposure)
    {
      return false;
    }
    exposures.insert(*each.recordedExposure);
  }
  return exposures.size() > 1 && exposures.size() == bursts.size();
}

/** Returns the kind of the settings. Throws std::invalid_argument if they are of several kinds. */
SettingKind
KindOfSettings(const std::vector<FoundBurst> & bursts)
{
  const FoundBurst * first = nullptr;
  for (const FoundBurst & each : bursts)
  {
    if (each.named && first != nullptr && each.named->kind != first->named->kind)
    {
      throw std::invalid_argument("--sweep: " + first->burst.name + " is " +
                                  SettingText(first->named->kind, first->named->value) + " and " + each.burst.name +
                                  " is " + SettingText(each.named->kind, each.named->value) +
                                  "; expected settings of one kind");
    }
    first = each.named && first == nullptr ? &each : first;
  }
  return first != nullptr ? first->named->kind : RecordExposures(bursts) ? SettingKind::Exposure : SettingKind::Iso;
}

/** Decides on the setting of a burst. */
void
SetSetting(FoundBurst & found, SettingKind kind)
{
  constexpr double sameSetting = 0.01; // relative; ISO speeds and exposures are a quarter apart or more
  const auto       recorded = kind == SettingKind::Iso        ? found.recordedIso
                              : kind == SettingKind::Exposure ? found.recordedExposure
                                                              : std::nullopt;
  if (recorded)
  {
    found.burst.setting = recorded;
    if (found.named && std::abs(found.named->value / *recorded - 1.0) > sameSetting)
    {
      found.burst.reason = "its files record " + SettingText(kind, *recorded) + ", but " +
                           SettingText(kind, found.named->value) +
                           " was given; expected the same. Correct the name or the table";
    }
    return;
  }
  if (found.named)
  {
    found.burst.setting = found.named->value;
    return;
  }
  if (found.burst.reason.empty())
  {
    found.burst.reason = "its setting is not known: neither the files record an ISO speed, nor does the name hold one. "
                         "Name it for instance iso800, gain2.5 or 10ms, or give a table (.csv)";
  }
}

/** Gives the bursts of exposures that record another ISO speed than the first one a reason: their gain differs. */
void
RequireOneGain(std::vector<FoundBurst> & bursts)
{
  const auto first =
    std::find_if(bursts.begin(), bursts.end(), [](const FoundBurst & each) { return each.recordedIso.has_value(); });
  for (FoundBurst & each : bursts)
  {
    if (each.recordedIso && each.recordedIso != first->recordedIso && each.burst.reason.empty())
    {
      each.burst.reason = "its files record ISO " + Text(*each.recordedIso) + ", and the files of " +
                          first->burst.name + " ISO " + Text(*first->recordedIso) +
                          "; expected exposures at one ISO speed";
    }
  }
}

void
RefuseRepeated(std::vector<SweepBurst> & bursts)
{
  for (std::size_t i = 0; i < bursts.size(); ++i)
  {
    const auto same =
      std::find_if(bursts.begin(), bursts.begin() + static_cast<std::ptrdiff_t>(i), [&](const auto & each) {
        return each.setting && each.setting == bursts[i].setting && each.reason.empty();
      });
    if (same != bursts.begin() + static_cast<std::ptrdiff_t>(i) && bursts[i].reason.empty())
    {
      bursts[i].reason = same->name + " has the same setting and is measured; expected one burst for each setting";
    }
  }
}
} // namespace

SweepPlan
PlanSweep(std::vector<FoundBurst> found)
{
  SweepPlan plan;
  plan.kind = KindOfSettings(found);
  if (plan.kind == SettingKind::Exposure)
  {
    RequireOneGain(found);
  }
  for (FoundBurst & each : found)
  {
    SetSetting(each, plan.kind);
    plan.bursts.push_back(each.burst);
  }
  std::stable_sort(plan.bursts.begin(), plan.bursts.end(), [](const SweepBurst & a, const SweepBurst & b) {
    return a.setting && (!b.setting || *a.setting < *b.setting);
  });
  RefuseRepeated(plan.bursts);
  return plan;
}

} // namespace sensornoise::tools
