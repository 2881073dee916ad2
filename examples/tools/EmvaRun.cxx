// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "tools/EmvaRun.h"

#include "files/PixelTypes.h"
#include "sensornoise/Emva1288.h"
#include "tools/EmvaSources.h"
#include "tools/EstimateOptions.h"
#include "tools/ExposureList.h"
#include "tools/FilesInUse.h"
#include "tools/PendingFile.h"
#include "tools/TerminalText.h"
#include "itkMultiThreaderBase.h"
#include "itkSensorNoiseFrameFiles.h"

#include <algorithm>
#include <cstddef>
#include <functional>
#include <iostream>
#include <numeric>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace sensornoise::tools
{
namespace
{
/** Returns loops over ITK's threads. */
ParallelFor
ItkParallelFor()
{
  return [](std::size_t count, const std::function<void(std::size_t)> & function) {
    itk::MultiThreaderBase::New()->ParallelizeArray(
      0, count, [&function](itk::SizeValueType i) { function(i); }, nullptr);
  };
}

EmvaSourceList
SourcesOf(const EstimateOptions & options)
{
  if (options.files.size() == 1 && IsEmvaList(options.files.front()))
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
    throw std::invalid_argument("--method emva1288 needs the exposures of the frames; expected a list of exposures in "
                                "place of the frames (.csv, .txt), or --exposures LIST");
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

/** Throws if the frames are not what the list says, or are a mosaic. */
void
RequireFrames(const FrameList & list, const EmvaSource & source, const EmvaSourceList & all)
{
  if (all.width > 0 && (list.width != all.width || list.height != all.height))
  {
    throw std::runtime_error(source.files.front() + " has " + DescribeFrame(list) + ", and the list says " +
                             std::to_string(all.width) + " x " + std::to_string(all.height) + "; expected one size");
  }
  if (!list.camera.bayerPattern.empty())
  {
    throw std::runtime_error(source.files.front() + " is a mosaic of colour filters (" + list.camera.bayerPattern +
                             "), which the method emva1288 does not read; write the frames of one colour, and "
                             "evaluate these");
  }
  const std::size_t frames = source.frames.empty() ? list.frames : source.frames.size();
  if (frames < 2)
  {
    throw std::runtime_error(source.where + " has one frame; expected two or more frames of each exposure");
  }
}

template <typename TPixel>
EmvaSeries
AddUp(const FrameList & list, const std::vector<std::size_t> & frames)
{
  const ParallelFor   parallelFor = ItkParallelFor();
  EmvaSeriesSums      sums(list.width, list.height);
  std::vector<TPixel> frame(list.width * list.height);
  for (const std::size_t t : frames)
  {
    ReadFrames(list, t, 1, frame.data());
    sums.AddFrame(frame.data(), parallelFor);
  }
  return sums.Measure(parallelFor);
}

EmvaSeries
AddUp(const FrameList & list, const EmvaSource & source)
{
  std::vector<std::size_t> frames = source.frames;
  if (frames.empty())
  {
    frames.resize(list.frames);
    std::iota(frames.begin(), frames.end(), std::size_t{ 0 });
  }
  return CallWithPixelType(list.pixel, [&](auto pixel) { return AddUp<decltype(pixel)>(list, frames); });
}

EmvaReport
Evaluate(const EstimateOptions & options, const EmvaSourceList & all)
{
  std::vector<EmvaSeries>  series;
  std::vector<std::string> opened;
  FrameList                list;
  for (const EmvaSource & source : all.sources)
  {
    if (source.files != opened)
    {
      list = OpenFrames(source.files, {}, options.raw, options.choice);
      opened = source.files;
    }
    RequireFrames(list, source, all);
    EmvaSeries measured = AddUp(list, source);
    measured.exposure = source.exposure;
    measured.photons = source.photons;
    measured.isDark = source.isDark;
    series.push_back(measured);
  }
  EmvaSettings settings;
  settings.quantizationStepDn = options.step > 0.0 ? options.step : 1.0;
  settings.bitDepth = options.bitDepth > 0 ? options.bitDepth : all.bitDepth > 0 ? all.bitDepth : list.camera.bitDepth;
  settings.exposureUnit = all.exposureUnit;
  return EvaluateEmva1288(series, settings);
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
}

/** Makes the file of an output, under a temporary name; empty: no file is asked for. */
std::optional<PendingFile>
MakeOutput(const std::string & name, const std::string & option)
{
  if (name.empty())
  {
    return std::nullopt;
  }
  RequireReportName(name, option);
  return std::optional<PendingFile>(std::in_place, name);
}
} // namespace

bool
RunEmva1288(const EstimateOptions & options)
{
  const EmvaSourceList all = SourcesOf(options);
  // throws before the work begins if an output cannot be written
  std::optional<PendingFile> json = MakeOutput(options.HasReportFile() ? options.json : "", "--json");
  std::optional<PendingFile> xml = MakeOutput(options.xml, "--xml");
  RequireApart(options, all);
  const EmvaReport report = Evaluate(options, all);
  if (json)
  {
    json->Write(ToJson(report));
    json->Commit();
  }
  if (xml)
  {
    xml->Write(ToXml(report));
    xml->Commit();
  }
  if (!options.quiet)
  {
    std::cout << ForStandardOutput(MakeTable(report));
  }
  if (options.json == "-")
  {
    std::cout << ToJson(report);
  }
  if (!std::cout.flush())
  {
    throw std::runtime_error(
      "cannot write the result to standard output: it is full or closed. Write a file: --json FILE");
  }
  return report.gain.value.has_value();
}

} // namespace sensornoise::tools
