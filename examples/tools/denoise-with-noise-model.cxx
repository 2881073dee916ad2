// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
// Removes the noise of images with the noise model of their camera, a report of estimate-sensor-noise:
//   denoise-with-noise-model --report report.json frame.tif clean.tif

#include "tools/DenoiseOptions.h"
#include "tools/DenoisedFile.h"
#include "tools/Denoiser.h"
#include "tools/ErrorSentence.h"
#include "tools/FilesInUse.h"
#include "tools/NoiseModelFile.h"
#include "tools/ReportFile.h"
#include "tools/TerminalText.h"
#include "tools/ItkThreads.h"

#include <exception>
#include <filesystem>
#include <iostream>
#include <stdexcept>
#include <string>
#include <system_error>
#include <vector>

namespace
{
namespace fs = std::filesystem;
using namespace sensornoise::tools;

constexpr int ExitDone = 0;
constexpr int ExitWrongUse = 2;
constexpr int ExitUnfitReport = 3;

/** Throws if an output is also an input or another output. It must be called before anything is written. */
void
RequireOutputsApart(const DenoiseOptions & options, const std::vector<DenoiseOptions::Job> & jobs)
{
  FilesInUse files;
  files.Read(options.report, "the report");
  for (const DenoiseOptions::Job & job : jobs)
  {
    files.Read(job.first, "the input");
  }
  for (const DenoiseOptions::Job & job : jobs)
  {
    files.Write(job.second, options.outputFolder.empty() ? "OUTPUT" : "--output-folder");
  }
}

/** Folder of the outputs. It is made if there is none, and removed again if nothing is written into it. */
class OutputFolder
{
public:
  explicit OutputFolder(const std::string & folder)
  {
    std::error_code error;
    for (fs::path path = folder; !path.empty() && !fs::exists(path, error); path = path.parent_path())
    {
      m_Made.push_back(path);
    }
    if (!m_Made.empty() && !fs::create_directories(m_Made.front(), error) && error)
    {
      throw std::runtime_error("cannot make the folder " + folder + ": " + error.message());
    }
  }
  OutputFolder(const OutputFolder &) = delete;
  OutputFolder &
  operator=(const OutputFolder &) = delete;
  ~OutputFolder()
  {
    for (const fs::path & path : m_Made)
    {
      std::error_code stays; // a folder with files stays
      fs::remove(path, stays);
    }
  }

private:
  std::vector<fs::path> m_Made; // folders that were made, the innermost first
};

void
Run(const DenoiseOptions & options)
{
  SetItkThreads(options.threads);
  const auto           jobs = options.Jobs();
  const NoiseModelFile report = ReadNoiseModel(options.report);
  const Denoiser       denoise = MakeDenoiser(options.denoiser, options.strength, options.threads);
  const OutputFolder   folder(options.outputFolder);
  RequireOutputsApart(options, jobs);
  for (const DenoiseOptions::Job & job : jobs)
  {
    WriteDenoised(job.first, job.second, report, denoise, options.pixelType == "float", options.raw);
  }
}
} // namespace

int
main(int argc, char * argv[])
{
  try
  {
    DenoiseOptions options;
    if (const auto finished = options.Parse(argc, argv, DenoiserNames()))
    {
      return *finished;
    }
    Run(options);
    return ExitDone;
  }
  catch (const UnfitReport & error)
  {
    std::cerr << "error: " << ForStandardError(SentenceOf(error)) << '\n';
    return ExitUnfitReport;
  }
  catch (const std::exception & error)
  {
    std::cerr << "error: " << ForStandardError(SentenceOf(error)) << '\n';
  }
  return ExitWrongUse;
}
