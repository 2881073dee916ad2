// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sweep/Setting.h"

#include "base/Text.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace sensornoise
{
namespace
{
/** Relative difference of a setting that was typed with six digits. */
constexpr double sameSetting = 1e-6;

/** A number of a channel at one setting; none: it is not identified there. */
using NumberOfSetting = std::function<std::optional<NumberWithError>(const CameraNoise &)>;

/** The measured settings on one side of the switch, and the setting between two of them. */
class NoiseBetween
{
public:
  NoiseBetween(const MeasuredRange & range, double setting)
    : m_Setting(setting)
  {
    const auto isOnSide = [&](double each) {
      return !range.switchBetween || (each <= range.switchBetween->first) == (setting <= range.switchBetween->first);
    };
    for (std::size_t i = 0; i < range.settings.size(); ++i)
    {
      if (isOnSide(range.settings[i]) && range.offLine.count(range.settings[i]) == 0)
      {
        m_Settings.push_back(range.settings[i]);
        m_Noise.push_back(&range.noise[i]);
      }
    }
    m_Above =
      static_cast<std::size_t>(std::upper_bound(m_Settings.begin(), m_Settings.end(), setting) - m_Settings.begin());
  }

  const CameraNoise &
  Below() const
  {
    return *m_Noise[m_Above - 1];
  }
  const CameraNoise &
  Above() const
  {
    return *m_Noise[m_Above];
  }
  double
  SettingBelow() const
  {
    return m_Settings[m_Above - 1];
  }
  double
  SettingAbove() const
  {
    return m_Settings[m_Above];
  }

  /** Throws ExportError if the channels of the settings on this side differ. */
  void
  RequireSameChannels() const
  {
    for (const CameraNoise * const noise : m_Noise)
    {
      const auto & first = m_Noise.front()->channels;
      const bool   isSame = std::equal(
        first.begin(), first.end(), noise->channels.begin(), noise->channels.end(), [](const auto & a, const auto & b) {
          return a.channel == b.channel;
        });
      if (!isSame)
      {
        throw ExportError("the channels of " + m_Noise.front()->name + " and " + noise->name +
                          " differ; expected the settings of one camera. Measure them with the same --bayer.");
      }
    }
  }

  /** Interpolates a number that is known at both neighbours. Other settings give the curvature where they have it. */
  std::optional<NumberWithError>
  Number(const NumberOfSetting & of, bool isLogarithmic) const
  {
    std::vector<SettingNumber> points;
    for (std::size_t i = 0; i < m_Settings.size(); ++i)
    {
      const auto number = of(*m_Noise[i]);
      const bool isKnown = number && (!isLogarithmic || number->value > 0.0);
      if (isKnown)
      {
        points.push_back({ m_Settings[i], *number });
      }
      else if (i + 1 == m_Above || i == m_Above)
      {
        return std::nullopt;
      }
    }
    return InterpolateNumber(points, m_Setting, isLogarithmic);
  }

private:
  double                           m_Setting;
  std::vector<double>              m_Settings;
  std::vector<const CameraNoise *> m_Noise;
  std::size_t                      m_Above{ 0 };
};

std::optional<NumberWithError>
NumberOf(const ReportedNumber & reported)
{
  return reported.value ? std::optional<NumberWithError>({ *reported.value, reported.standardError.value_or(0.0) })
                        : std::nullopt;
}

ReportedNumber
Reported(const std::optional<NumberWithError> & number)
{
  ReportedNumber reported;
  if (number)
  {
    reported.value = number->value;
    reported.standardError = number->standardError;
  }
  reported.status = number ? "identified" : "not-identifiable";
  return reported;
}

std::optional<double>
Narrower(const std::optional<double> & a, const std::optional<double> & b, bool isLower)
{
  return a && b ? std::optional<double>(isLower ? std::max(*a, *b) : std::min(*a, *b)) : std::nullopt;
}

/** The level at which the variance is interpolated: the offset, else the black level. */
std::optional<double>
DarkLevelOf(const CameraNoise & noise, std::size_t channel)
{
  const auto & offset = noise.channels[channel].offset.value;
  return offset ? offset : noise.blackLevelDn;
}

/** The total intercept: the interpolated variance at the dark level minus slope times level. */
std::optional<NumberWithError>
InterceptOf(const NoiseBetween & between, std::size_t channel, const ReportedNumber & slope)
{
  const auto level = between.Number(
    [&](const CameraNoise & noise) {
      const auto dark = DarkLevelOf(noise, channel);
      return dark ? std::optional<NumberWithError>({ *dark, 0.0 }) : std::nullopt;
    },
    false);
  const auto variance = between.Number(
    [&](const CameraNoise & noise) -> std::optional<NumberWithError> {
      const ChannelNoise & of = noise.channels[channel];
      const auto           dark = DarkLevelOf(noise, channel);
      if (!dark || !of.varianceSlope.value || !of.totalIntercept.value)
      {
        return std::nullopt;
      }
      return NumberWithError{ *of.varianceSlope.value * *dark + *of.totalIntercept.value, 0.0 };
    },
    true);
  if (!level || !variance || !slope.value)
  {
    return std::nullopt;
  }
  return NumberWithError{ variance->value - *slope.value * level->value, 0.0 };
}

ChannelNoise
InterpolateChannel(const NoiseBetween & between, std::size_t channel)
{
  const auto number = [&](ReportedNumber ChannelNoise::* member, bool isLogarithmic) {
    return Reported(between.Number([&](const CameraNoise & noise) { return NumberOf(noise.channels[channel].*member); },
                                   isLogarithmic));
  };
  const ChannelNoise & below = between.Below().channels[channel];
  const ChannelNoise & above = between.Above().channels[channel];
  ChannelNoise         made;
  made.channel = below.channel;
  made.varianceSlope = number(&ChannelNoise::varianceSlope, true);
  made.gain = number(&ChannelNoise::gain, true);
  made.offset = number(&ChannelNoise::offset, false);
  made.readNoise = number(&ChannelNoise::readNoise, true);
  made.totalIntercept = Reported(InterceptOf(between, channel, made.varianceSlope));
  made.totalIntercept.standardError.reset();
  const auto electrons = between.Number(
    [&](const CameraNoise & noise) -> std::optional<NumberWithError> {
      const ChannelNoise & of = noise.channels[channel];
      if (!of.readNoise.value || !of.gain.value || !of.readNoiseElectronsError)
      {
        return std::nullopt;
      }
      return NumberWithError{ *of.readNoise.value / *of.gain.value, *of.readNoiseElectronsError };
    },
    true);
  made.readNoiseElectronsError = electrons ? std::optional<double>(electrons->standardError) : std::nullopt;
  made.lowestDn = Narrower(below.lowestDn, above.lowestDn, true);
  made.highestDn = Narrower(below.highestDn, above.highestDn, false);
  made.clipHighDn = Narrower(below.clipHighDn, above.clipHighDn, false);
  return made;
}

std::string
SettingWords(const MeasuredRange & range, double setting)
{
  return (range.kind == SettingKind::Iso ? "" : "the ") + SettingText(range.kind, setting);
}

/** Returns a sentence with the reason why the burst of a setting was not measured; "": it has no burst. */
std::string
UnmeasuredText(const MeasuredRange & range, double setting)
{
  const auto found = std::find_if(range.unmeasured.begin(), range.unmeasured.end(), [setting](const auto & each) {
    return std::abs(each.first / setting - 1.0) < sameSetting;
  });
  return found == range.unmeasured.end()
           ? ""
           : " The burst of this setting could not be measured: " + WithSigns(found->second);
}

/** Throws ExportError unless the setting can be interpolated. */
void
RequireInside(const MeasuredRange & range, double setting)
{
  if (range.settings.empty() || !(setting >= range.settings.front() && setting <= range.settings.back()))
  {
    throw ExportError(SettingWords(range, setting) + " is outside of the measured settings" +
                      (range.settings.empty()
                         ? ", as none was measured"
                         : ", " + Text(range.settings.front()) + " to " + Text(range.settings.back())) +
                      "; nothing is extrapolated. Measure a burst at this setting." + UnmeasuredText(range, setting));
  }
  if (range.switchBetween && setting > range.switchBetween->first && setting < range.switchBetween->second)
  {
    throw ExportError(SettingWords(range, setting) + " is between " + Text(range.switchBetween->first) + " and " +
                      Text(range.switchBetween->second) +
                      ", where the camera switches its conversion gain; expected a setting on either side. Measure a "
                      "burst at this setting.");
  }
}

/** Throws ExportError if a neighbour of the setting leaves the line of the gains. */
void
RequireNeighboursOnLine(const MeasuredRange & range, double setting)
{
  const auto   above = std::upper_bound(range.settings.begin(), range.settings.end(), setting);
  const double below = *(above - 1);
  for (const double neighbour : { below, *above })
  {
    const auto found = range.offLine.find(neighbour);
    if (found != range.offLine.end())
    {
      throw ExportError(SettingWords(range, setting) + " is between " + Text(below) + " and " + Text(*above) +
                        ", and " + SettingWords(range, neighbour) + " leaves the line of the gains: its gain is " +
                        Percent(std::abs(found->second)) + (found->second > 0.0 ? " above" : " below") +
                        " it. Measure a burst at this setting.");
    }
  }
}

/** Returns " gain 6.004 ± 0.016 DN/e⁻" of all channels that have the number; "": none has. */
std::string
NumbersText(const CameraNoise & noise, ReportedNumber ChannelNoise::* member, const char * name, const char * unit)
{
  std::string numbers;
  for (const ChannelNoise & channel : noise.channels)
  {
    const ReportedNumber & number = channel.*member;
    if (number.value)
    {
      numbers += (numbers.empty() ? "" : ", ") + (channel.channel == "mono" ? "" : channel.channel + " ") +
                 Measured(*number.value, number.standardError.value_or(0.0));
    }
  }
  return numbers.empty() ? "" : WithSigns(std::string(" ") + name + " " + numbers + " " + unit);
}
} // namespace

void
AddSetting(MeasuredRange & range, const CameraNoise & noise, double setting)
{
  range.noise.push_back(noise);
  range.settings.push_back(setting);
  CameraNoise & added = range.noise.back();
  if (range.kind == SettingKind::Iso)
  {
    added.isoSpeed = setting;
  }
  else if (range.kind == SettingKind::Gain && added.analogueGain == 1.0)
  {
    added.analogueGain = setting;
  }
}

InterpolatedNoise
InterpolateNoise(const MeasuredRange & range, double setting)
{
  for (std::size_t i = 0; i < range.settings.size(); ++i)
  {
    if (std::abs(range.settings[i] / setting - 1.0) < sameSetting)
    {
      return { range.noise[i], setting, setting };
    }
  }
  RequireInside(range, setting);
  if (range.kind == SettingKind::Exposure)
  {
    throw ExportError(SettingWords(range, setting) +
                      " was not measured; nothing is interpolated between exposures. Choose a measured one.");
  }
  RequireNeighboursOnLine(range, setting);
  const NoiseBetween between(range, setting);
  between.RequireSameChannels();
  InterpolatedNoise made{ between.Below(), between.SettingBelow(), between.SettingAbove() };
  const auto        level = [&](std::optional<double> CameraNoise::* member) {
    const auto number = between.Number(
      [member](const CameraNoise & noise) {
        return noise.*member ? std::optional<NumberWithError>({ *(noise.*member), 0.0 }) : std::nullopt;
      },
      false);
    return number ? std::optional<double>(number->value) : std::nullopt;
  };
  made.noise.name += " at " + SettingWords(range, setting);
  made.noise.blackLevelDn = level(&CameraNoise::blackLevelDn);
  made.noise.whiteLevelDn = level(&CameraNoise::whiteLevelDn);
  made.noise.isoSpeed = range.kind == SettingKind::Iso ? std::optional<double>(setting) : std::nullopt;
  made.noise.exposureSeconds.reset();
  const bool isAnalogue = made.noise.analogueGain == made.below && range.kind == SettingKind::Gain;
  made.noise.analogueGain = isAnalogue ? setting : made.noise.analogueGain;
  for (std::size_t channel = 0; channel < made.noise.channels.size(); ++channel)
  {
    made.noise.channels[channel] = InterpolateChannel(between, channel);
  }
  return made;
}

std::string
SentenceOf(const InterpolatedNoise & noise)
{
  if (noise.below == noise.above)
  {
    return "";
  }
  const std::string gains = NumbersText(noise.noise, &ChannelNoise::gain, "gain", "DN/e-");
  const std::string readNoises = NumbersText(noise.noise, &ChannelNoise::readNoise, "read noise", "DN");
  return "The noise is interpolated between the measured settings " + Text(noise.below) + " and " + Text(noise.above) +
         (gains.empty() && readNoises.empty() ? "" : ":") + gains + (gains.empty() || readNoises.empty() ? "" : ",") +
         readNoises + ".";
}

std::vector<CameraNoise>
ChooseSettings(const MeasuredRange &         range,
               const std::string &           format,
               const std::optional<double> & setting,
               const std::string &           passport,
               std::string &                 note)
{
  if (setting)
  {
    const InterpolatedNoise chosen = InterpolateNoise(range, *setting);
    note = SentenceOf(chosen);
    note += note.empty() ? "" : UnmeasuredText(range, *setting);
    return { chosen.noise };
  }
  const auto & formats = ExportFormats();
  const bool   takesSeveral = std::any_of(formats.begin(), formats.end(), [&format](const ExportFormat & each) {
    return format == each.name && each.takesSeveral;
  });
  if (range.noise.size() == 1 || takesSeveral)
  {
    return range.noise;
  }
  std::string list;
  for (const double each : range.settings)
  {
    list += (list.empty() ? "" : ", ") + Text(each);
  }
  throw ExportError("the passport " + passport + " has the settings " + list + "; " + format +
                    " takes one. Choose a setting (--setting).");
}

} // namespace sensornoise
