// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "tools/EmvaRun.h"

#include "sensornoise/Emva1288.h"
#include "tools/EmvaFrames.h"
#include "tools/EmvaList.h"
#include "tools/EmvaSources.h"
#include "tools/EstimateOptions.h"
#include "tools/ExposureList.h"
#include "tools/FilesHash.h"
#include "tools/FilesInUse.h"
#include "tools/FramesTitle.h"
#include "tools/PendingFile.h"
#include "tools/SvgAsPng.h"
#include "tools/TerminalText.h"
#include "itkSensorNoiseFrameFiles.h"

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <optional>
#include <stdexcept>
#include <string>
#include <variant>

namespace sensornoise::tools
{
namespace
{
EmvaSourceList
SourcesOf(const EstimateOptions & options)
{
  const bool isList = options.files.size() == 1 && IsEmvaList(options.files.front());
  if (!options.dark.empty() && (isList || !options.exposures.empty()))
  {
    throw std::invalid_argument("--dark gives dark frames whose files record their exposures, and " +
                                (isList ? "the list " + options.files.front() : "--exposures") +
                                " says which frames are dark; leave one of them out");
  }
  if (isList)
  {
    if (!options.exposures.empty())
    {
      throw std::invalid_argument("--exposures and the list " + options.files.front() +
                                  " both say exposures; leave one of them out");
    }
    return ReadEmvaList(options.files.front(), !options.raw.empty());
  }
  if (options.exposures.empty())
  {
    return GroupByRecordedExposure(options.files, options.dark);
  }
  const FrameList list = OpenFrames(options.files, {}, options.raw, options.choice);
  if (list.frames != options.exposures.size())
  {
    throw std::invalid_argument("--exposures holds " + std::to_string(options.exposures.size()) +
                                " numbers, but there are " + std::to_string(list.frames) +
                                " frames; expected one exposure for each frame");
  }
  return GroupByExposure(options.files, options.exposures);
}

/** Throws if an output is also an input or another output. */
void
RequireApart(const EstimateOptions & options, const EmvaSourceList & all)
{
  FilesInUse files;
  for (const std::string & name : options.files)
  {
    files.Read(name, "the list of exposures or the frame");
  }
  for (const EmvaSource & source : all.sources)
  {
    for (const std::string & name : source.files)
    {
      files.Read(name, "the frame");
    }
  }
  if (!options.exposuresText.empty() && !IsExposureList(options.exposuresText))
  {
    files.Read(options.exposuresText, "--exposures");
  }
  if (options.HasReportFile())
  {
    files.Write(options.json, "--json");
  }
  if (!options.xml.empty())
  {
    files.Write(options.xml, "--xml");
  }
  if (!options.plot.empty())
  {
    files.Write(options.plot, "--plot");
  }
}

/** Returns the name of the list, or of the first and the last file, without folders. The date is the date of the
 * last file of frames. */
PageTitle
TitleOfEvaluation(const EstimateOptions & options, const EmvaMeasured & measured)
{
  const auto        name = [](const std::string & file) { return std::filesystem::path(file).filename().string(); };
  const std::string last = options.files.size() == 1 ? "" : " to " + name(options.files.back());
  return { name(options.files.front()) + last, TitleOf(measured.frames).date };
}

/** Returns the text of the file that --plot selects. */
std::string
MakePlot(const EstimateOptions & options, const EmvaMeasured & measured)
{
  if (options.Plot() == PlotKind::Page)
  {
    const bool        hasDark = !measured.dark.files.empty();
    const InputRecord input{ HashOf(measured.frames),
                             hasDark ? std::optional<InputFiles>(HashOf(measured.dark)) : std::nullopt };
    const PageTitle   title = TitleOfEvaluation(options, measured);
    return std::visit([&](const auto & report) { return ToHtml(report, title, input); }, measured.evaluation);
  }
  const std::string svg = std::visit([](const auto & report) { return ToSvg(report); }, measured.evaluation);
  return options.Plot() == PlotKind::Png ? SvgAsPng(svg) : svg;
}

bool
HasGain(const EmvaReport & report)
{
  return report.gain.value.has_value();
}

/** Returns whether any plane has a gain. */
bool
HasGain(const EmvaMosaicReport & report)
{
  return std::any_of(
    report.planes.begin(), report.planes.end(), [](const EmvaReport & plane) { return HasGain(plane); });
}

/** File of an output; none if no file is asked for. */
class EmvaOutput
{
public:
  /** Makes the file, under a temporary name. Throws std::exception if it cannot be written. */
  EmvaOutput(const std::string & name, const char * option)
  {
    if (!name.empty())
    {
      RequireReportName(name, option);
      m_File.emplace(name);
    }
  }

  template <typename TFunction>
  void
  Write(TFunction makeText)
  {
    if (m_File)
    {
      m_File->Write(makeText());
      m_File->Commit();
    }
  }

private:
  std::optional<PendingFile> m_File;
};
} // namespace

bool
RunEmva1288(const EstimateOptions & options)
{
  if (options.Plot() == PlotKind::Png)
  {
    RequirePng(options.plot);
  }
  const EmvaSourceList all = SourcesOf(options);
  // throws before the work begins if an output cannot be written
  EmvaOutput json(options.HasReportFile() ? options.json : "", "--json");
  EmvaOutput xml(options.xml, "--xml");
  EmvaOutput plot(options.plot, "--plot");
  RequireApart(options, all);
  const EmvaMeasured     measured = EvaluateFrames(options, all);
  const EmvaEvaluation & evaluation = measured.evaluation;
  const auto             toJson = [&] { return std::visit([](const auto & of) { return ToJson(of); }, evaluation); };
  json.Write(toJson);
  xml.Write([&] { return std::visit([](const auto & of) { return ToXml(of); }, evaluation); });
  plot.Write([&] { return MakePlot(options, measured); });
  if (!options.quiet)
  {
    std::cout << ForStandardOutput(std::visit([](const auto & of) { return MakeTable(of); }, evaluation));
  }
  if (options.json == "-")
  {
    std::cout << toJson();
  }
  if (!std::cout.flush())
  {
    throw std::runtime_error(
      "cannot write the result to standard output: it is full or closed. Write a file: --json FILE");
  }
  return std::visit([](const auto & of) { return HasGain(of); }, evaluation);
}

} // namespace sensornoise::tools
