// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "tools/ComparedFiles.h"

#include "sensornoise/ReportText.h"
#include "tools/ReportFile.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <filesystem>
#include <iterator>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace sensornoise::tools
{
namespace
{
using nlohmann::json;

std::string
WordIn(const json & record, const char * name)
{
  return record.contains(name) && record[name].is_string() ? record[name].get<std::string>() : "";
}

/** Returns a member as a count; 0 if it is missing, negative or not a number. */
std::size_t
CountIn(const json & record, const char * name)
{
  constexpr double mostThatIsExact = 9e15;
  const double     number = NumberIn(record, name).value_or(0.0);
  return number >= 0.0 && number < mostThatIsExact ? static_cast<std::size_t>(number) : 0;
}

std::optional<Interval>
IntervalIn(const json & quantity, const char * name)
{
  if (!quantity.contains(name) || !quantity[name].is_array() || quantity[name].size() != 2)
  {
    return std::nullopt;
  }
  const auto end = [&](std::size_t i) {
    const json & number = quantity[name][i];
    return number.is_number() ? std::optional<double>(number.get<double>()) : std::nullopt;
  };
  return Interval{ end(0), end(1) };
}

Quantity
QuantityIn(const json & record, const char * name, const std::string & file)
{
  const auto found = record.find(name);
  if (found == record.end() || !found->is_object())
  {
    throw UnfitReport("the report " + file + " has no " + name + "; expected a whole report of estimate-sensor-noise");
  }
  constexpr std::array statuses{
    EstimateStatus::Identified, EstimateStatus::NotIdentifiable, EstimateStatus::UpperLimit, EstimateStatus::Failed
  };
  const std::string word = WordIn(*found, "status");
  const auto *      status =
    std::find_if(statuses.begin(), statuses.end(), [&word](EstimateStatus each) { return word == NameOf(each); });
  if (status == statuses.end())
  {
    throw UnfitReport("the report " + file + " has the status \"" + word + "\" of " + name +
                      "; expected identified, not-identifiable, upper-limit or failed");
  }
  Quantity quantity = Quantity::Without(*status);
  quantity.value = NumberIn(*found, "value");
  quantity.standardError = NumberIn(*found, "standard_error");
  quantity.interval95 = IntervalIn(*found, "interval95");
  quantity.bracket = IntervalIn(*found, "bracket");
  return quantity;
}

CameraSettings
CameraIn(const json & record)
{
  CameraSettings camera;
  const auto     found = record.find("camera");
  if (found != record.end() && found->is_object())
  {
    constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
    camera.camera = WordIn(*found, "name");
    camera.isoSpeed = NumberIn(*found, "iso_speed").value_or(unknown);
    camera.exposureSeconds = NumberIn(*found, "exposure_seconds").value_or(unknown);
  }
  return camera;
}

std::optional<InputRecord>
InputIn(const json & record)
{
  const auto found = record.find("input");
  if (found == record.end() || !found->is_object())
  {
    return std::nullopt;
  }
  InputRecord input;
  input.frames = { WordIn(*found, "sha256"), CountIn(*found, "files"), CountIn(*found, "bytes") };
  return input;
}

void
ReadWarnings(const json & record, Report & report)
{
  const auto found = record.find("warnings");
  if (found == record.end() || !found->is_array())
  {
    return;
  }
  for (const json & warning : *found)
  {
    const std::string code = warning.is_object() ? WordIn(warning, "code") : "";
    const auto *      kind = std::find_if(
      WarningTable.begin(), WarningTable.end(), [&code](const WarningKind & each) { return code == each.name; });
    if (kind != WarningTable.end())
    {
      report.Warn(kind->code, WordIn(warning, "message"));
    }
  }
}

Report
ReportIn(const json & record, const std::string & file)
{
  Report report;
  report.method = WordIn(record, "method");
  report.channel = WordIn(record, "channel");
  const std::array<const char *, 5> channels{ "mono", "R", "G1", "G2", "B" };
  if (std::find(channels.begin(), channels.end(), report.channel) == channels.end())
  {
    throw UnfitReport("the report " + file + " has the channel \"" + report.channel +
                      "\"; expected mono, R, G1, G2 or B");
  }
  report.frames = CountIn(record, "frames");
  report.width = CountIn(record, "width");
  report.height = CountIn(record, "height");
  if (const std::size_t bits = CountIn(record, "bit_depth"); bits > 0 && bits <= 64)
  {
    report.bitDepth = static_cast<int>(bits);
  }
  report.camera = CameraIn(record);
  report.gain = QuantityIn(record, "gain", file);
  report.offset = QuantityIn(record, "offset", file);
  report.readNoise = QuantityIn(record, "read_noise", file);
  report.readNoiseElectrons = QuantityIn(record, "read_noise_electrons", file);
  report.intercept = QuantityIn(record, "intercept", file);
  report.varianceSlope = QuantityIn(record, "variance_slope", file);
  report.totalIntercept = QuantityIn(record, "total_intercept", file);
  ReadWarnings(record, report);
  return report;
}

/** Returns the last \a parts parts of a path, without the file name extension. */
std::string
EndOfPath(const std::filesystem::path & file, std::size_t parts)
{
  std::filesystem::path end = file.stem();
  for (std::filesystem::path folder = file.parent_path(); parts > 1 && !folder.filename().empty();
       folder = folder.parent_path(), --parts)
  {
    end = folder.filename() / end;
  }
  return end.string();
}

std::vector<std::string>
LabelsOf(const std::vector<std::string> & files)
{
  std::vector<std::string> labels;
  constexpr std::size_t    mostFolders = 8; // a file that is listed twice cannot be distinguished
  for (std::size_t parts = 1; parts <= mostFolders; ++parts)
  {
    labels.clear();
    std::transform(files.begin(), files.end(), std::back_inserter(labels), [parts](const std::string & file) {
      return EndOfPath(file, parts);
    });
    if (std::set<std::string>(labels.begin(), labels.end()).size() == labels.size())
    {
      return labels;
    }
  }
  return labels;
}
} // namespace

std::vector<ComparedReport>
ReadComparedReports(const std::vector<std::string> & files)
{
  std::vector<ComparedReport>    reports;
  const std::vector<std::string> labels = LabelsOf(files);
  for (std::size_t i = 0; i < files.size(); ++i)
  {
    const json        record = ReadReportRecord(files[i]);
    const auto        channels = record.find("channels");
    const bool        isMosaic = channels != record.end() && channels->is_array() && !channels->empty();
    std::vector<json> records;
    if (isMosaic)
    {
      records.assign(channels->begin(), channels->end());
    }
    else
    {
      records.push_back(record);
    }
    for (const json & one : records)
    {
      if (!one.is_object())
      {
        throw UnfitReport("the report " + files[i] + " has a channel that is no report");
      }
      reports.push_back({ labels[i], ReportIn(one, files[i]) });
      reports.back().report.input = InputIn(record);
    }
  }
  return reports;
}

} // namespace sensornoise::tools
