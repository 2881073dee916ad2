// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "tools/ModelCheck.h"

#include "sensornoise/ReportText.h"
#include "report/JsonWriter.h"
#include "sensornoise/NoiseModel.h"
#include "tools/CompanionFiles.h"
#include "tools/ErrorSentence.h"
#include "tools/EstimateOptions.h"
#include "tools/TerminalText.h"
#include "itkSensorNoiseFrameFiles.h"

#include <cstddef>
#include <exception>
#include <iostream>
#include <stdexcept>
#include <variant>

namespace sensornoise::tools
{
std::vector<const Report *>
ReportsOf(const MeasuredStack & measured)
{
  if (const auto * const report = std::get_if<Report>(&measured))
  {
    return { report };
  }
  std::vector<const Report *> reports;
  for (const Report & channel : std::get<ChannelReports>(measured).channels)
  {
    reports.push_back(&channel);
  }
  return reports;
}

namespace
{
/** Returns the options of the frames of --check, which are measured with the refined method. The other methods do not
 * give the variance of each pixel without the contributions of flicker and motion. The options for the frames of the
 * report apply to these frames as well. For frames of other files, --frames, --dark and --exposures do not apply. */
EstimateOptions
OptionsOfCheck(const EstimateOptions & options)
{
  EstimateOptions other = options;
  other.method = "refined";
  if (!options.check.empty())
  {
    other.files = options.check;
    other.frames.reset();
    other.cut.reset();
    other.dark.clear();
    other.exposures.clear();
  }
  return other;
}

MeasuredStack
MeasureFramesToCheck(const EstimateOptions & options, const MeasuredStack & measured, const FrameList & frames)
{
  EstimateOptions other = OptionsOfCheck(options);
  other.bayer = PatternOf(options, measured);
  return EstimateStack(other, frames, nullptr);
}

bool
HasModel(const Report & report)
{
  try
  {
    NoiseModelOf(report);
    return true;
  }
  catch (const std::invalid_argument & error)
  {
    const std::string channel = report.channel == "mono" ? "" : " of channel " + report.channel;
    std::cerr << "error: the noise model" << channel << " cannot be checked: " << error.what() << '\n';
    return false;
  }
}

std::string
JsonOf(const std::optional<NoiseModelCheck> & check)
{
  std::string text = check ? ToJson(*check) : "null";
  text.erase(text.find_last_not_of('\n') + 1);
  return text;
}

/** Adds the checks to a report: one as the member \a name, several as the list of this name in the plural, each with
 * its channel. */
void
AddChecks(const std::string & name, const ModelChecks & checks, std::string & text)
{
  if (checks.size() == 1 && checks.front())
  {
    text.insert(text.rfind('}'), ", \"" + name + "\": " + JsonOf(checks.front()));
  }
  if (checks.size() > 1)
  {
    std::string list;
    for (std::size_t k = 0; k < checks.size(); ++k)
    {
      std::string check = JsonOf(checks[k]);
      if (checks[k])
      {
        check.insert(check.find('{') + 1, "\"channel\": \"" + std::string(NameOf(BayerPlanes.at(k))) + "\", ");
      }
      list += (list.empty() ? "" : ", ") + check;
    }
    text.insert(text.rfind('}'), ", \"" + name + "s\": [" + list + "]");
  }
}

std::string
TableOf(const std::string & title, const ModelChecks & checks)
{
  std::string text;
  for (std::size_t k = 0; k < checks.size(); ++k)
  {
    if (checks[k])
    {
      const std::string channel = checks.size() > 1 ? "channel " + std::string(NameOf(BayerPlanes.at(k))) : "";
      const std::string heading = title + (title.empty() || channel.empty() ? "" : ", ") + channel;
      text += (heading.empty() ? "" : "\n" + heading + ":") + '\n' + sensornoise::MakeTable(*checks[k]);
    }
  }
  return text;
}
} // namespace

FrameList
OpenFramesToCheck(const EstimateOptions & options)
try
{
  const EstimateOptions other = OptionsOfCheck(options);
  FrameList             frames = OpenFrames(other.files, {}, other.raw, other.choice);
  PrintWarningOf(frames);
  RequireSelection(other, frames);
  return frames;
}
catch (const std::exception & error)
{
  throw std::runtime_error("--check: " + SentenceOf(error));
}

ModelChecks
CheckModel(const EstimateOptions & options, const MeasuredStack & measured, const FrameList & frames)
try
{
  const std::vector<const Report *> models = ReportsOf(measured);
  std::vector<bool>                 hasModel;
  bool                              hasAny = false;
  for (const Report * const model : models)
  {
    hasModel.push_back(HasModel(*model));
    hasAny = hasAny || hasModel.back();
  }
  ModelChecks checks(models.size());
  if (!hasAny)
  {
    return checks;
  }
  const bool                        isMeasured = options.check.empty() && options.method == "refined";
  const MeasuredStack               other = isMeasured ? measured : MeasureFramesToCheck(options, measured, frames);
  const std::vector<const Report *> reports = ReportsOf(other);
  for (std::size_t k = 0; k < models.size(); ++k)
  {
    if (hasModel[k])
    {
      checks[k] = CheckReport(*reports.at(k), *models[k]);
    }
  }
  return checks;
}
catch (const std::exception & error) // the report is written all the same
{
  std::cerr << "error: the noise model cannot be checked: " << ForStandardError(SentenceOf(error)) << '\n';
  return ModelChecks(ReportsOf(measured).size());
}

std::string
ToJson(const MeasuredStack & measured, const ModelChecks & checks, const ModelChecks & profileChecks)
{
  std::string text = std::visit([](const auto & reports) { return sensornoise::ToJson(reports); }, measured);
  AddChecks("check", checks, text);
  AddChecks("profile_check", profileChecks, text);
  return text;
}

std::string
MakeTable(const MeasuredStack & measured, const ModelChecks & checks, const ModelChecks & profileChecks)
{
  return std::visit([](const auto & reports) { return sensornoise::MakeTable(reports); }, measured) +
         TableOf("", checks) + TableOf("profile", profileChecks);
}

} // namespace sensornoise::tools
