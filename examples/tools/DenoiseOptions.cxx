// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "tools/DenoiseOptions.h"

#include "sensornoise/Version.h"
#include "tools/HelpText.h"
#include "tools/LowerCase.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <memory>
#include <stdexcept>

namespace sensornoise::tools
{
namespace
{
namespace fs = std::filesystem;

void
RequireImageName(const std::string & file)
{
  const std::vector<std::string> known{ ".mha", ".nrrd", ".png", ".tif", ".tiff" };
  if (std::find(known.begin(), known.end(), LowerCaseEnding(file)) == known.end())
  {
    throw std::runtime_error("the output is " + file +
                             "; expected a name that ends in .mha, .nrrd, .png, .tif or .tiff");
  }
}

/** Returns the name of an output in the folder. A header with pixels in a separate file becomes a single file.
 * Formats that are not written become .mha. */
std::string
NameInFolder(const std::string & folder, const std::string & input, const std::string & pixelType)
{
  fs::path                       name = fs::path(input).filename();
  const std::string              ending = LowerCaseEnding(name);
  const std::vector<std::string> unwritten{ ".mhd", ".ser", ".mraw", ".cihx", ".cih", ".raw", ".bin" };
  if (std::find(unwritten.begin(), unwritten.end(), ending) != unwritten.end())
  {
    name.replace_extension(".mha");
  }
  else if (ending == ".nhdr")
  {
    name.replace_extension(".nrrd");
  }
  else if (ending == ".png" && pixelType == "float")
  {
    name.replace_extension(".tif"); // PNG has no floating-point pixels
  }
  return (fs::path(folder) / name).string();
}
} // namespace

std::optional<int>
DenoiseOptions::Parse(int argc, char ** argv, const std::vector<std::string> & denoisers)
{
  CLI::App app("Removes the noise of images by the noise model of their camera, a report of estimate-sensor-noise:\n"
               "generalized Anscombe transform, denoiser of unit Gaussian noise, exact unbiased inverse.\n"
               "INPUT OUTPUT, or with --output-folder INPUT...: 2-D images, or 3-D stacks frame by frame (.mha .mhd\n"
               ".nrrd .nhdr .png .tif). The report may lack gain and offset; it needs a variance_slope.\n"
               "Exit code: 0 done, 2 wrong use or unreadable input, 3 the report cannot serve.",
               "denoise-with-noise-model");
  app.formatter(std::make_shared<HelpFormatter>(TerminalWidth()));
  denoiser = denoisers.front();
  app.add_option("FILE", files, "INPUT OUTPUT, or INPUT... with --output-folder")->required();
  app.add_option("--report", report, "JSON file of the camera at this setting (estimate-sensor-noise --json)")
    ->required();
  app.add_option("--output-folder", outputFolder, "folder for the images, under the names of the inputs");
  app.add_option(
    "--raw", raw, "WxH:TYPE[:SKIP[:ROW[:GAP[:END]]]]: inputs without a header, as estimate-sensor-noise --raw has it");
  app
    .add_option("--denoiser",
                denoiser,
                "nlm: OpenCV's non-local means; bm3d: OpenCV's, where its build has it; itk: ITK's bilateral filter")
    ->check(CLI::IsMember({ "nlm", "bm3d", "itk" }))
    ->capture_default_str();
  app.add_option("--strength", strength, "of the denoiser, relative to what is best for the noise")
    ->capture_default_str();
  app.add_option("--pixel-type", pixelType, "input: the type of the input, rounded and clamped; float: neither")
    ->check(CLI::IsMember({ "input", "float" }))
    ->capture_default_str();
  app.add_option("--threads", threads, "number of threads; else all")->check(CLI::Range(1, 1024));
  app.set_version_flag("--version", std::string("denoise-with-noise-model ") + GetModuleVersion());
  try
  {
    app.parse(argc, argv);
  }
  catch (const CLI::Success & request)
  {
    return app.exit(request); // --help or --version
  }
  if (!(strength > 0.0 && strength <= 10.0))
  {
    throw std::runtime_error("--strength is " + app["--strength"]->as<std::string>() +
                             "; expected a number above 0, at most 10");
  }
  return std::nullopt;
}

std::vector<DenoiseOptions::Job>
DenoiseOptions::Jobs() const
{
  std::vector<Job> jobs;
  if (outputFolder.empty())
  {
    if (files.size() != 2)
    {
      throw std::runtime_error(
        std::to_string(files.size()) +
        " files are named; expected INPUT OUTPUT, or --output-folder DIR and any number of inputs");
    }
    jobs.emplace_back(files[0], files[1]);
  }
  else
  {
    for (const std::string & input : files)
    {
      jobs.emplace_back(input, NameInFolder(outputFolder, input, pixelType));
    }
  }
  for (const Job & job : jobs)
  {
    RequireImageName(job.second);
  }
  return jobs;
}

} // namespace sensornoise::tools
