/*=========================================================================
 *
 *  Copyright the ITKSensorNoise contributors
 *
 *  Licensed under the Apache License, Version 2.0 (the "License");
 *  you may not use this file except in compliance with the License.
 *  You may obtain a copy of the License at
 *
 *         https://www.apache.org/licenses/LICENSE-2.0.txt
 *
 *  Unless required by applicable law or agreed to in writing, software
 *  distributed under the License is distributed on an "AS IS" BASIS,
 *  WITHOUT WARRANTIES OR CONDITIONS OF ANY KIND, either express or implied.
 *  See the License for the specific language governing permissions and
 *  limitations under the License.
 *
 *=========================================================================*/
#include "sensornoise/base/BinaryStream.h"
#include "sensornoise/base/RollingShutter.h"
#include "tools/EstimateOptions.h"
#include "input/FrameInput.h"

#include <CLI/CLI.hpp>
#include <cstddef>
#include <iostream>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

namespace sensornoise::tools
{
namespace
{
/** Reads "a,b,...", exactly \a count numbers. */
template <typename TNumber>
std::vector<TNumber>
ReadNumbers(const std::string & option, const std::string & text, char separator, std::size_t count)
{
  std::vector<TNumber> numbers;
  std::istringstream   stream(text);
  for (std::string part; std::getline(stream, part, separator);)
  {
    std::istringstream field(part);
    TNumber            number{};
    if (!(field >> number) || !field.eof())
    {
      throw CLI::ValidationError(option, "\"" + part + "\" in \"" + text + "\" is not a number");
    }
    numbers.push_back(number);
  }
  if (numbers.size() != count)
  {
    throw CLI::ValidationError(option,
                               "\"" + text + "\" holds " + std::to_string(numbers.size()) + " numbers; expected " +
                                 std::to_string(count));
  }
  return numbers;
}
} // namespace

std::optional<int>
EstimateOptions::Parse(int argc, char ** argv)
{
  std::string bitDepthText = "auto";
  std::string clipText;
  std::string rollingText = "auto";
  std::string roiText;
  std::string framesText;
  std::string stepText;
  std::string offsetText;

  CLI::App app("Measures gain, offset and read noise of a camera from a burst of raw frames of a static scene.\n"
               "FRAME...: 2-D image files in time order, or one 3-D stack file (.mha .mhd .nrrd .tif).\n"
               "Exit code: 0 done, 2 wrong use or unreadable input, 3 nothing could be estimated.");
  app.add_option("FRAME", files, "frames in time order, or one stack")->required();
  app.add_option("--method", method, "refined, or published: Figure 2 of Sur & Grediac 2015")
    ->check(CLI::IsMember({ "refined", "published" }))
    ->capture_default_str();
  app.add_option("--bit-depth", bitDepthText, "bits of the sensor's codes, 1 to 16, or auto")->capture_default_str();
  app.add_option("--clip", clipText, "LOW,HIGH: lowest and highest level that the sensor attains [DN]; else found");
  app.add_option("--step", stepText, "spacing of the codes [DN]; else found");
  app
    .add_option("--rolling-shutter",
                rollingText,
                "auto, off, or (for published) the width sigma_y of a row's neighbourhood [rows]")
    ->capture_default_str();
  const auto offsetOption =
    app.add_option("--offset", offsetText, "VALUE[,ERROR]: offset and its standard error [DN], if known; else found");
  app
    .add_option("--dark",
                dark,
                "frames without light, or one stack, of the same size and type and at the same exposure, gain and "
                "temperature: they tell offset and read noise. Write them behind FRAME...")
    ->excludes(offsetOption);
  app.add_option("--roi", roiText, "X,Y,W,H: only these pixels");
  app.add_option("--mask", mask, "image file: only pixels that are not 0");
  app.add_option("--frames", framesText, "A:B: only the frames A, A+1, ... B-1, counted from 0");
  app.add_option("--threads", threads, "number of threads; else all")->check(CLI::Range(1, 1024));
  app.add_option("--json", json, "file for the report, or - for standard output");
  app.add_option("--maps", maps, "folder for mean, variance, corrected variance and pixel use (.mha)");
  app.add_flag("--quiet", quiet, "no table and no progress");
  try
  {
    app.parse(argc, argv);
    if (bitDepthText != "auto")
    {
      bitDepth = ReadNumbers<unsigned int>("--bit-depth", bitDepthText, ',', 1)[0];
      if (bitDepth < 1 || bitDepth > 16)
      {
        throw CLI::ValidationError("--bit-depth", bitDepthText + " is not auto or a number from 1 to 16");
      }
    }
    if (!stepText.empty())
    {
      step = ReadNumbers<double>("--step", stepText, ',', 1)[0];
      if (!(step > 0.0))
      {
        throw CLI::ValidationError("--step", stepText + " is not a positive number");
      }
    }
    if (!clipText.empty())
    {
      const auto levels = ReadNumbers<double>("--clip", clipText, ',', 2);
      clipLow = levels[0];
      clipHigh = levels[1];
    }
    if (!offsetText.empty())
    {
      const bool hasError = offsetText.find(',') != std::string::npos;
      const auto numbers = ReadNumbers<double>("--offset", offsetText, ',', hasError ? 2 : 1);
      offset = numbers[0];
      offsetStandardError = hasError ? numbers[1] : 0.0;
    }
    if (method == "published" && (!offsetText.empty() || !dark.empty()))
    {
      throw CLI::ValidationError(offsetText.empty() ? "--dark" : "--offset",
                                 "the method published finds the offset from the flicker alone; leave it out, or set "
                                 "--method refined");
    }
    if (rollingText == "off")
    {
      rollingShutter = RollingShutter::Off;
    }
    else if (rollingText != "auto")
    {
      rollingShutter = RollingShutter::Fixed;
      rowSigma = ReadNumbers<double>("--rolling-shutter", rollingText, ',', 1)[0];
      if (!(rowSigma > 0.0))
      {
        throw CLI::ValidationError("--rolling-shutter", rollingText + " is not auto, off or a positive number of rows");
      }
    }
    if (!roiText.empty())
    {
      const auto numbers = ReadNumbers<long>("--roi", roiText, ',', 4);
      roi = { numbers[0], numbers[1], numbers[2], numbers[3] };
      if (numbers[0] < 0 || numbers[1] < 0 || numbers[2] < 1 || numbers[3] < 1)
      {
        throw CLI::ValidationError("--roi", roiText + " has a negative corner or no pixels");
      }
    }
    if (!framesText.empty())
    {
      const auto numbers = ReadNumbers<long>("--frames", framesText, ':', 2);
      if (numbers[0] < 0 || numbers[1] <= numbers[0])
      {
        throw CLI::ValidationError("--frames", framesText + " holds no frame; expected A:B with 0 <= A < B");
      }
      frames = { numbers[0], numbers[1] };
    }
  }
  catch (const CLI::Success & request)
  {
    return app.exit(request); // --help
  }
  return std::nullopt;
}

void
EstimateOptions::SelectFiles()
{
  if (!frames || files.size() == 1)
  {
    return;
  }
  if (frames->second > files.size())
  {
    throw InputError("--frames ends at " + std::to_string(frames->second) + ", but there are " +
                     std::to_string(files.size()) + " files");
  }
  files = { files.begin() + static_cast<std::ptrdiff_t>(frames->first),
            files.begin() + static_cast<std::ptrdiff_t>(frames->second) };
  frames.reset();
}

std::string
EstimateOptions::DescribeRegion() const
{
  std::ostringstream text;
  if (roi)
  {
    text << (*roi)[2] << " x " << (*roi)[3] << " pixels from " << (*roi)[0] << "," << (*roi)[1];
  }
  if (frames)
  {
    text << (roi ? " and " : "") << "frames " << frames->first << " to " << frames->second - 1;
  }
  return text.str();
}

} // namespace sensornoise::tools
