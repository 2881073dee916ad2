// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "studies/RealSensorDemands.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace sensornoise::tools
{
namespace
{
using Setting = RealSensorSetting;
using Outcome = RealSensorOutcome;
using Verdict = std::optional<bool>;
using Demands = std::vector<RealSensorDemand>;

constexpr double MostStacks = 0.97;
constexpr double LeastRefused = 0.95;

/** Refused, or for another reason without a gain. */
bool
IsWithoutGain(const Outcome & outcome)
{
  return !outcome.Of(JudgedQuantity::Gain).IsIdentified();
}

RealSensorDemand
KindNamed(double lowestShare)
{
  return { "kind of the noise as expected",
           [](const Setting & setting, const Outcome & outcome) -> Verdict {
             const std::vector<std::string> & kinds = setting.kinds;
             return kinds.empty() ? std::nullopt
                                  : Verdict(std::find(kinds.begin(), kinds.end(), outcome.kind) != kinds.end());
           },
           lowestShare };
}

RealSensorDemand
Warned(WarningCode code)
{
  return { std::string("warning ") + KindOf(code).name,
           [code](const Setting &, const Outcome & outcome) -> Verdict { return outcome.HasWarning(code); } };
}

/** Where the sensor has such noise: the study gives it a fifth of the read noise or more. */
RealSensorDemand
LineNoiseWithin(JudgedQuantity quantity)
{
  return { std::string(NameOf(quantity)) + " within 5 % or 3 standard errors",
           [quantity](const Setting &, const Outcome & outcome) -> Verdict {
             const Judged & judged = outcome.Of(quantity);
             return judged.truth > 0.0 ? Verdict(judged.IsWithin(0.05)) : std::nullopt;
           } };
}

RealSensorDemand
WithinOrNone(double fraction, const std::string & text)
{
  return { "gain within " + text + " or 3 standard errors, or no gain",
           [fraction](const Setting &, const Outcome & outcome) -> Verdict {
             return IsWithoutGain(outcome) || outcome.Of(JudgedQuantity::Gain).IsWithin(fraction);
           } };
}

RealSensorDemand
AsFromDistinctFrames()
{
  return { "gain equals that of the distinct frames", [](const Setting &, const Outcome & outcome) -> Verdict {
            const Judged & gain = outcome.Of(JudgedQuantity::Gain);
            return outcome.distinctGain && gain.estimate.value &&
                   std::abs(*gain.estimate.value - *outcome.distinctGain) <= 1e-9 * std::abs(*outcome.distinctGain);
          } };
}

Demands
DemandsOnNoGain()
{
  return { { "refused, or no gain",
             [](const Setting &, const Outcome & outcome) -> Verdict { return IsWithoutGain(outcome); },
             LeastRefused },
           { "no interval that misses the gain",
             [](const Setting &, const Outcome & outcome) -> Verdict {
               return outcome.Of(JudgedQuantity::Gain).Holds().value_or(true);
             } },
           KindNamed(LeastRefused) };
}

/** The gain of the sensor in spite of what the camera does, with the kind named. */
Demands
DemandsOnGain(double fraction, const std::string & text, const Demands & more)
{
  Demands demands{ NeverRefused(), GainWithin(fraction, text), Coverage(JudgedQuantity::Gain) };
  demands.insert(demands.end(), more.begin(), more.end());
  return demands;
}

std::map<std::string, Demands>
MakeProcessedDemands()
{
  const Demands isNamed{ KindNamed(MostStacks) };
  return { { "plain",
             DemandsOnGain(0.02,
                           "2 %",
                           { KindNamed(MostStacks),
                             LineNoiseWithin(JudgedQuantity::RowNoise),
                             LineNoiseWithin(JudgedQuantity::ColumnNoise) }) },
           { "smoothed", DemandsOnGain(0.02, "2 %", isNamed) },
           { "resampled", DemandsOnGain(0.02, "2 %", isNamed) },
           { "binned", DemandsOnNoGain() },
           { "coupling", DemandsOnGain(0.02, "2 %", isNamed) },
           { "blur", DemandsOnGain(0.02, "2 %", isNamed) },
           { "temporal", { WithinOrNone(0.05, "5 %"), Coverage(JudgedQuantity::Gain), KindNamed(MostStacks) } },
           { "repeated",
             DemandsOnGain(
               0.02, "2 %", { Warned(WarningCode::RepeatedFrames), AsFromDistinctFrames(), KindNamed(MostStacks) }) },
           { "companded", DemandsOnGain(0.01, "1 %", { Warned(WarningCode::Companded) }) },
           { "brighter-fatter", DemandsOnGain(0.01, "1 %", isNamed) },
           { "defects", DemandsOnNoGain() },
           { "median", DemandsOnNoGain() },
           { "blocks", DemandsOnNoGain() } };
}
} // namespace

std::optional<std::vector<RealSensorDemand>>
FindProcessedDemands(const std::string & line)
{
  const auto all = MakeProcessedDemands();
  const auto found = all.find(line);
  return found == all.end() ? std::nullopt : std::optional<Demands>(found->second);
}

} // namespace sensornoise::tools
