// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sweep/SweepSummary.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace sensornoise
{
namespace
{
std::optional<NumberWithError>
Known(const ReportedNumber & number)
{
  const bool isKnown = number.value && number.standardError && std::isfinite(*number.value) &&
                       std::isfinite(*number.standardError) && *number.standardError >= 0.0;
  return isKnown ? std::optional<NumberWithError>({ *number.value, *number.standardError }) : std::nullopt;
}

std::optional<NumberWithError>
KnownPositive(const ReportedNumber & number)
{
  const auto known = Known(number);
  return known && known->value > 0.0 ? known : std::nullopt;
}

std::optional<NumberWithError>
ElectronsOf(const ChannelNoise & channel)
{
  const auto gain = KnownPositive(channel.gain);
  const auto sigma = KnownPositive(channel.readNoise);
  if (!gain || !sigma || !channel.readNoiseElectronsError)
  {
    return std::nullopt;
  }
  return NumberWithError{ sigma->value / gain->value, *channel.readNoiseElectronsError };
}

SweepRow
RowOf(double setting, const CameraNoise & noise, const ChannelNoise & channel)
{
  SweepRow row;
  row.setting = setting;
  row.channel = channel.channel;
  row.gain = KnownPositive(channel.gain);
  row.offsetDn = Known(channel.offset);
  row.readNoiseDn = KnownPositive(channel.readNoise);
  row.readNoiseElectrons = ElectronsOf(channel);
  const std::optional<double> top = channel.clipHighDn ? channel.clipHighDn : noise.whiteLevelDn;
  if (!top || !row.offsetDn || !(*top > row.offsetDn->value) || !row.gain)
  {
    return row;
  }
  const double signal = *top - row.offsetDn->value;
  const double offsetError = row.offsetDn->standardError / signal;
  const double well = signal / row.gain->value;
  row.fullWellElectrons = { well, well * std::hypot(offsetError, row.gain->standardError / row.gain->value) };
  if (row.readNoiseDn)
  {
    const double decibels = 20.0 / std::log(10.0);
    row.dynamicRangeDb = { decibels * std::log(signal / row.readNoiseDn->value),
                           decibels *
                             std::hypot(offsetError, row.readNoiseDn->standardError / row.readNoiseDn->value) };
  }
  return row;
}

using NumberOfChannel = std::function<std::optional<NumberWithError>(const ChannelNoise &)>;

/** Returns the channel that has a number at the most settings, and all other channels that have the number at these
 * settings. */
std::set<std::string>
CommonChannels(const MeasuredRange & range, const NumberOfChannel & of)
{
  std::map<std::string, std::set<double>> settings; // settings of each channel
  for (std::size_t i = 0; i < range.noise.size(); ++i)
  {
    for (const ChannelNoise & channel : range.noise[i].channels)
    {
      if (of(channel))
      {
        settings[channel.channel].insert(range.settings[i]);
      }
    }
  }
  const auto most = std::max_element(
    settings.begin(), settings.end(), [](const auto & a, const auto & b) { return a.second.size() < b.second.size(); });
  std::set<std::string> common;
  for (const auto & [channel, known] : settings)
  {
    const std::set<double> & needed = most->second;
    if (std::includes(known.begin(), known.end(), needed.begin(), needed.end()))
    {
      common.insert(channel);
    }
  }
  return common;
}

std::optional<NumberWithError>
MeanOf(const CameraNoise & noise, const std::set<std::string> & channels, const NumberOfChannel & of)
{
  double sum = 0.0;
  double squares = 0.0;
  double count = 0.0;
  for (const ChannelNoise & channel : noise.channels)
  {
    const auto number = of(channel);
    if (number && channels.count(channel.channel) > 0)
    {
      sum += std::log(number->value);
      squares += std::pow(number->standardError / number->value, 2.0);
      count += 1.0;
    }
  }
  if (count == 0.0 || count < static_cast<double>(channels.size()))
  {
    return std::nullopt;
  }
  const double mean = std::exp(sum / count);
  return NumberWithError{ mean, mean * std::sqrt(squares) / count };
}

/** Tests and pools the gains of each channel. */
void
FindCommonGains(SweepSummary & summary)
{
  std::vector<std::string>                         channels; // channels in the order of the rows
  std::map<std::string, std::vector<SettingNoise>> settings; // settings of each channel
  for (const SweepRow & row : summary.rows)
  {
    if (settings.count(row.channel) == 0)
    {
      channels.push_back(row.channel);
    }
    settings[row.channel].push_back({ row.setting, row.gain, row.readNoiseElectrons });
  }
  for (const std::string & channel : channels)
  {
    if (auto common = FindCommonGain(settings[channel]))
    {
      common->channel = channel;
      summary.commonGains.push_back(*common);
    }
  }
}

/** Returns the noise of all ISO speeds in a format. If the format cannot hold the noise, returns none and sets
 * \a reason. */
std::optional<NoiseExport>
ExportOf(const MeasuredRange & range, const char * format, std::string & reason)
{
  try
  {
    return ExportNoise(format, range.noise);
  }
  catch (const ExportError & error)
  {
    reason = error.what();
    return std::nullopt;
  }
}
} // namespace

std::vector<SettingNoise>
MeanOverChannels(const MeasuredRange & range)
{
  const auto gain = [](const ChannelNoise & channel) { return KnownPositive(channel.gain); };
  const auto gainChannels = CommonChannels(range, gain);
  const auto readNoiseChannels = CommonChannels(range, ElectronsOf);

  std::vector<SettingNoise> settings;
  for (std::size_t i = 0; i < range.noise.size(); ++i)
  {
    settings.push_back({ range.settings[i],
                         MeanOf(range.noise[i], gainChannels, gain),
                         MeanOf(range.noise[i], readNoiseChannels, ElectronsOf) });
  }
  return settings;
}

SweepSummary
SummariseSweep(const MeasuredRange & range, const std::vector<UnmeasuredSetting> & unmeasured)
{
  SweepSummary summary;
  summary.kind = range.kind;
  summary.unmeasured = unmeasured;
  for (std::size_t i = 0; i < range.noise.size(); ++i)
  {
    const CameraNoise & noise = range.noise[i];
    summary.camera = summary.camera.empty() ? noise.camera : summary.camera;
    for (const ChannelNoise & channel : noise.channels)
    {
      summary.rows.push_back(RowOf(range.settings[i], noise, channel));
    }
  }
  summary.settings = MeanOverChannels(range);
  if (range.kind == SettingKind::Exposure)
  {
    summary.line.deviation.resize(summary.settings.size());
    summary.line.isBeside.resize(summary.settings.size(), false);
    FindCommonGains(summary);
    return summary;
  }
  summary.conversionSwitch = FindGainSwitch(summary.settings);
  summary.line = FitGainLine(summary.settings, summary.conversionSwitch);
  if (range.kind == SettingKind::Iso && range.noise.size() > 1)
  {
    summary.android = ExportOf(range, "android", summary.androidReason);
    summary.darktable = ExportOf(range, "darktable", summary.darktableReason);
  }
  return summary;
}

std::map<double, double>
SettingsOffLine(const SweepSummary & summary)
{
  std::map<double, double> offLine;
  for (std::size_t i = 0; i < summary.settings.size(); ++i)
  {
    if (summary.line.isBeside[i] && summary.line.deviation[i])
    {
      offLine[summary.settings[i].setting] = *summary.line.deviation[i];
    }
  }
  return offLine;
}

} // namespace sensornoise
