// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "studies/RealSensorDemands.h"

namespace sensornoise::tools
{
namespace
{
using Setting = RealSensorSetting;
using Outcome = RealSensorOutcome;
using Verdict = std::optional<bool>;
using Demands = std::vector<RealSensorDemand>;

constexpr double LeastCoverage = 0.9;
constexpr double LeastBracketCoverage = 0.95;

/** Where the offset is known or found. */
RealSensorDemand
ReadNoiseWithin()
{
  return { "read noise within 3 % or 3 standard errors", [](const Setting &, const Outcome & outcome) -> Verdict {
            const bool isOffsetKnown = outcome.Of(JudgedQuantity::Offset).IsIdentified();
            return isOffsetKnown ? Verdict(outcome.Of(JudgedQuantity::ReadNoise).IsWithin(0.03)) : std::nullopt;
          } };
}

RealSensorDemand
MedianWithin()
{
  return { "median read noise within 3 %", [](const Setting &, const Outcome & outcome) -> Verdict {
            const Judged & median = outcome.Of(JudgedQuantity::ReadNoiseMedian);
            const double   slack = 0.03 * median.truth;
            return median.IsIdentified() ? Verdict(*median.estimate.value >= median.truth - slack &&
                                                   *median.estimate.value <= median.truth + slack)
                                         : std::nullopt;
          } };
}

RealSensorDemand
MapsCover(const std::string & what, std::optional<double> Outcome::* coverage)
{
  return { what + " map: 93 to 97 % of the pixels' intervals hold",
           [coverage](const Setting &, const Outcome & outcome) -> Verdict {
             const std::optional<double> & share = outcome.*coverage;
             return share ? Verdict(*share >= 0.93 && *share <= 0.97) : std::nullopt;
           } };
}

RealSensorDemand
BracketHolds(JudgedQuantity quantity)
{
  return { std::string("bracket holds ") + NameOf(quantity),
           [quantity](const Setting &, const Outcome & outcome) { return outcome.Of(quantity).BracketHolds(); },
           LeastBracketCoverage };
}

RealSensorDemand
IdentifiedInBracket(JudgedQuantity quantity)
{
  return { std::string("identified ") + NameOf(quantity) + " lies in its own bracket",
           [quantity](const Setting &, const Outcome & outcome) { return outcome.Of(quantity).IsInBracket(); } };
}

Demands
DemandsOnToneCurves()
{
  return { { "target: refused",
             [](const Setting & setting, const Outcome & outcome) -> Verdict {
               return setting.scene == RealSensorScene::Target ? Verdict(outcome.IsRefused()) : std::nullopt;
             },
             0.95 },
           { "texture: refused, or interval holds gain",
             [](const Setting & setting, const Outcome & outcome) -> Verdict {
               const bool isRight = outcome.IsRefused() || outcome.Of(JudgedQuantity::Gain).Holds().value_or(true);
               return setting.scene == RealSensorScene::Texture ? Verdict(isRight) : std::nullopt;
             },
             LeastCoverage },
           Coverage(JudgedQuantity::Gain) };
}

RealSensorDemand
ResponseUnchecked()
{
  return { "response-unchecked, of those not refused", [](const Setting &, const Outcome & outcome) -> Verdict {
            return outcome.IsRefused() ? std::nullopt : Verdict(outcome.HasWarning(WarningCode::ResponseUnchecked));
          } };
}

Demands
DemandsOnFlats(bool hasDarkFrames)
{
  Demands demands{ Coverage(JudgedQuantity::Gain),
                   Coverage(JudgedQuantity::Offset),
                   Coverage(JudgedQuantity::Flicker),
                   { "flicker that cannot be told from 0 is below its limit",
                     [](const Setting &, const Outcome & outcome) {
                       return outcome.Of(JudgedQuantity::Flicker).LimitHolds();
                     },
                     LeastCoverage } };
  const auto gainIdentified = [](const Outcome & outcome) { return outcome.Of(JudgedQuantity::Gain).IsIdentified(); };
  if (!hasDarkFrames)
  {
    demands.push_back({ "gain identified: no pattern, shading 3 %, 50 frames",
                        [=](const Setting & setting, const Outcome & outcome) -> Verdict {
                          const bool counts =
                            !setting.HasPattern() && setting.shading == 0.03 && setting.settings.frames >= 50;
                          return counts ? Verdict(gainIdentified(outcome)) : std::nullopt;
                        } });
    return demands;
  }
  demands.push_back({ "gain identified",
                      [=](const Setting &, const Outcome & outcome) -> Verdict { return gainIdentified(outcome); } });
  demands.push_back({ "standard error of gain at most 0.5 %", [](const Setting &, const Outcome & outcome) -> Verdict {
                       const Judged & gain = outcome.Of(JudgedQuantity::Gain);
                       return gain.IsIdentified()
                                ? Verdict(gain.estimate.standardError.value_or(gain.truth) <= 0.005 * gain.truth)
                                : std::nullopt;
                     } });
  return demands;
}

Demands
DemandsOnScmos(bool hasDarkFrames)
{
  Demands demands{ NeverRefused(),
                   GainWithin(0.02, "2 %"),
                   Coverage(JudgedQuantity::Gain),
                   Coverage(JudgedQuantity::Offset),
                   Coverage(JudgedQuantity::Flicker),
                   ReadNoiseWithin(),
                   Coverage(JudgedQuantity::ReadNoise) };
  if (hasDarkFrames)
  {
    demands.push_back(MedianWithin());
    demands.push_back(MapsCover("offset", &Outcome::offsetMapCoverage));
    demands.push_back(MapsCover("read noise", &Outcome::readNoiseMapCoverage));
  }
  return demands;
}
} // namespace

RealSensorDemand
NeverRefused()
{
  return { "not refused", [](const Setting &, const Outcome & outcome) -> Verdict { return !outcome.IsRefused(); } };
}

RealSensorDemand
Coverage(JudgedQuantity quantity)
{
  return { std::string("interval holds ") + NameOf(quantity),
           [quantity](const Setting &, const Outcome & outcome) { return outcome.Of(quantity).Holds(); },
           LeastCoverage,
           true };
}

RealSensorDemand
GainWithin(double fraction, const std::string & text)
{
  return { "gain within " + text + " or 3 standard errors",
           [fraction](const Setting &, const Outcome & outcome) -> Verdict {
             return outcome.Of(JudgedQuantity::Gain).IsWithin(fraction);
           } };
}

Demands
GetDemands(const std::string & line)
{
  using Q = JudgedQuantity;
  if (const auto demands = FindProcessedDemands(line))
  {
    return *demands;
  }
  if (line == "bends")
  {
    return { NeverRefused(), Coverage(Q::Gain) };
  }
  if (line == "gamma")
  {
    return DemandsOnToneCurves();
  }
  if (line == "narrow")
  {
    return { ResponseUnchecked() };
  }
  if (line == "flats" || line == "flats-dark")
  {
    return DemandsOnFlats(line == "flats-dark");
  }
  if (line == "scmos" || line == "scmos-dark")
  {
    return DemandsOnScmos(line == "scmos-dark");
  }
  if (line == "brackets")
  {
    return { BracketHolds(Q::Offset), IdentifiedInBracket(Q::Offset), BracketHolds(Q::ReadNoise), Coverage(Q::Offset) };
  }
  return { NeverRefused(), GainWithin(0.01, "1 %"), Coverage(Q::Gain) };
}

} // namespace sensornoise::tools
