// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
// Removes the noise of images by the noise model of their camera, a report of estimate-sensor-noise:
//   denoise-with-noise-model --report report.json frame.tif clean.tif

#include "tools/DenoiseOptions.h"
#include "tools/DenoisedFile.h"
#include "tools/Denoiser.h"
#include "tools/ErrorSentence.h"
#include "tools/FilesInUse.h"
#include "tools/NoiseModelFile.h"
#include "itkMultiThreaderBase.h"

#include <exception>
#include <filesystem>
#include <iostream>
#include <stdexcept>
#include <string>
#include <system_error>
#include <vector>

namespace
{
using namespace sensornoise::tools;

constexpr int ExitDone = 0;
constexpr int ExitWrongUse = 2;
constexpr int ExitUnfitReport = 3;

/** To be called before anything is written. */
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

void
MakeFolder(const std::string & folder)
{
  std::error_code error;
  if (!folder.empty() && !std::filesystem::is_directory(folder, error))
  {
    std::filesystem::create_directories(folder, error);
    if (error)
    {
      throw std::runtime_error("cannot make the folder " + folder + ": " + error.message());
    }
  }
}

void
SetThreads(unsigned int threads)
{
  if (threads > 0)
  {
    itk::MultiThreaderBase::SetGlobalMaximumNumberOfThreads(threads);
    itk::MultiThreaderBase::SetGlobalDefaultNumberOfThreads(threads);
  }
}

void
Run(const DenoiseOptions & options)
{
  SetThreads(options.threads);
  const auto           jobs = options.Jobs();
  const NoiseModelFile report = ReadNoiseModel(options.report);
  const Denoiser       denoise = MakeDenoiser(options.denoiser, options.strength, options.threads);
  MakeFolder(options.outputFolder);
  RequireOutputsApart(options, jobs);
  for (const DenoiseOptions::Job & job : jobs)
  {
    WriteDenoised(job.first, job.second, report, denoise, options.pixelType == "float");
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
    std::cerr << "error: " << SentenceOf(error) << '\n';
    return ExitUnfitReport;
  }
  catch (const std::exception & error)
  {
    std::cerr << "error: " << SentenceOf(error) << '\n';
  }
  return ExitWrongUse;
}
