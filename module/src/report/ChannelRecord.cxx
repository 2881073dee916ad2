// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/ReportText.h"

#include "base/Text.h"
#include "report/JsonWriter.h"
#include "report/ReportParts.h"
#include "sensornoise/Version.h"

#include <algorithm>
#include <cstddef>

namespace sensornoise
{

namespace
{
/** Column of the table of channels: a quantity. Title and unit are in ASCII. */
struct Column
{
  const char * title;
  const char * unit;
  Quantity Report::* member;
};

const std::vector<Column> &
Columns()
{
  static const std::vector<Column> columns{
    { "gain g", "DN/e-", &Report::gain },
    { "offset mu", "DN", &Report::offset },
    { "read noise sigma", "DN", &Report::readNoise },
    { "sigma^2 - g mu", "DN^2", &Report::intercept },
    { "sigma_alpha", "pixel", &Report::vibrationSdX },
    { "sigma_beta", "pixel", &Report::vibrationSdY },
    { "Cov(alpha, beta)", "pixel^2", &Report::vibrationCovariance },
    { "sigma_gamma", "1", &Report::flickerSd },
  };
  return columns;
}

/** Returns the value with its error, else the upper limit, else the name of the status. */
std::string
CellOf(const Quantity & quantity)
{
  if (quantity.value)
  {
    return quantity.standardError ? WithSigns(Measured(*quantity.value, *quantity.standardError))
                                  : Text(*quantity.value);
  }
  const auto & range = quantity.interval95 ? quantity.interval95 : quantity.bracket;
  if (quantity.status == EstimateStatus::UpperLimit && range && range->high)
  {
    return "< " + Rounded(*range->high);
  }
  return NameOf(quantity.status);
}

/** Returns the rows as text, each column as wide as its widest cell and two blanks. All rows have the same number of
 * cells. */
std::string
Align(const std::vector<std::vector<std::string>> & rows)
{
  std::vector<std::size_t> widths(rows.front().size(), 0);
  for (const auto & row : rows)
  {
    for (std::size_t k = 0; k < row.size(); ++k)
    {
      widths[k] = std::max(widths[k], CharactersIn(row[k]));
    }
  }
  std::string table;
  for (const auto & row : rows)
  {
    std::string line;
    for (std::size_t k = 0; k < row.size(); ++k)
    {
      line += PaddedRight(row[k], widths[k] + 2);
    }
    table += line.substr(0, line.find_last_not_of(' ') + 1) + '\n';
  }
  return table;
}

/** Returns a line about the joint offset, or about the contradiction between the channels. */
std::string
DescribeJoint(const JointOffset & joint)
{
  if (!joint.precisionGain)
  {
    return "joint offset: none, the channels' differ by more than their errors\n";
  }
  return "joint offset: " + CellOf(joint.offset) + " DN, " + Rounded(*joint.precisionGain) +
         " times as precise as the best channel's (chi2 of the four " + Rounded(joint.reducedChi2) + ")\n";
}

/** Returns a line about the joint vibration. */
std::string
DescribeMotion(const JointMotion & motion)
{
  return "joint vibration: x " + CellOf(motion.sdX) + ", y " + CellOf(motion.sdY) + " pixel of a plane, covariance " +
         CellOf(motion.covariance) + WithSigns(" pixel^2\n");
}
} // namespace

std::string
ToJson(const ChannelReports & reports)
{
  std::string text;
  JsonWriter  json(text);
  json.Object([&] {
    json.Member("schema", ReportSchema).Member("version", GetModuleVersion());
    if (reports.input)
    {
      json.Member("input", *reports.input);
    }
    json.ObjectMember(
      "bayer", [&] { json.Member("pattern", NameOf(reports.pattern)).Member("source", NameOf(reports.source)); });
    if (reports.joint)
    {
      json.ObjectMember("joint", [&] {
        WriteQuantity(json, "offset", reports.joint->offset, "DN");
        json.Member("precision_gain", reports.joint->precisionGain).Member("reduced_chi2", reports.joint->reducedChi2);
      });
    }
    else
    {
      json.Member("joint", std::optional<double>());
    }
    if (reports.motion)
    {
      json.ObjectMember("joint_vibration", [&] {
        WriteQuantity(json, "sd_x", reports.motion->sdX, "pixel");
        WriteQuantity(json, "sd_y", reports.motion->sdY, "pixel");
        WriteQuantity(json, "covariance", reports.motion->covariance, "pixel^2");
        json.Member("motion", reports.motion->series);
      });
    }
    else
    {
      json.Member("joint_vibration", std::optional<double>());
    }
    json.Member("warnings", reports.warnings).Member("channels", reports.channels);
  });
  text += '\n';
  return text;
}

std::string
MakeTable(const ChannelReports & reports)
{
  const Report & first = reports.channels.front();
  std::string    table = CountText(first.frames, "frame") + ", planes of " + std::to_string(first.width) + " x " +
                      std::to_string(first.height) + " pixels of a " + NameOf(reports.pattern) + " mosaic (" +
                      NameOf(reports.source) + ")\nmethod: " + first.method + "\n" + DescribeInput(reports.input) +
                      "\n";
  std::vector<std::vector<std::string>> rows{ { "channel" }, { "" } };
  for (const Column & column : Columns())
  {
    rows[0].push_back(WithSigns(column.title));
    rows[1].push_back(WithSigns(std::string("[") + column.unit + "]"));
  }
  for (const Report & channel : reports.channels)
  {
    rows.push_back({ channel.channel });
    for (const Column & column : Columns())
    {
      rows.back().push_back(CellOf(channel.*column.member));
    }
  }
  table += Align(rows);
  table += reports.joint || reports.motion ? "\n" : "";
  return table + (reports.joint ? DescribeJoint(*reports.joint) : "") +
         (reports.motion ? DescribeMotion(*reports.motion) : "");
}

std::vector<Warning>
WarningsOf(const ChannelReports & reports)
{
  std::vector<Warning>     all = reports.warnings;
  std::vector<std::string> channels; // for each of ofChannels, the names of its channels
  std::vector<Warning>     ofChannels;
  for (const Report & channel : reports.channels)
  {
    for (const Warning & warning : channel.warnings)
    {
      const auto same = std::find_if(ofChannels.begin(), ofChannels.end(), [&warning](const Warning & other) {
        return other.code == warning.code && other.message == warning.message;
      });
      if (same == ofChannels.end())
      {
        ofChannels.push_back(warning);
        channels.push_back(channel.channel);
      }
      else
      {
        channels.at(static_cast<std::size_t>(same - ofChannels.begin())) += ", " + channel.channel;
      }
    }
  }
  for (std::size_t k = 0; k < ofChannels.size(); ++k)
  {
    all.push_back({ ofChannels[k].code, channels[k] + ": " + ofChannels[k].message });
  }
  return all;
}

std::string
MakeText(const ChannelReports & reports)
{
  std::string                text = MakeTable(reports);
  const std::vector<Warning> warnings = WarningsOf(reports);
  for (const Warning & warning : warnings)
  {
    text += (&warning == &warnings.front() ? "\n" : "") + TextOf(warning);
  }
  return text;
}

} // namespace sensornoise
