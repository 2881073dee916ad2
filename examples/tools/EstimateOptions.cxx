// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "tools/EstimateOptions.h"

#include "report/StackReport.h"
#include "sensornoise/Settings.h"
#include "tools/EstimateOptionList.h"
#include "tools/EstimateRules.h"
#include "tools/ExposureList.h"
#include "tools/FileNames.h"
#include "tools/HelpText.h"
#include "tools/LowerCase.h"
#include "tools/OptionHints.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstddef>
#include <memory>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

namespace sensornoise::tools
{
namespace
{
/** Reads exactly \a count numbers, separated by \a separator. Throws CLI::ValidationError, which states the expected
 * \a form, if the text holds anything else. */
template <typename TNumber>
std::vector<TNumber>
ReadNumbers(const std::string & option,
            const std::string & text,
            char                separator,
            std::size_t         count,
            const std::string & form)
{
  std::vector<TNumber> numbers;
  std::istringstream   stream(text);
  for (std::string part; std::getline(stream, part, separator);)
  {
    std::istringstream field(part);
    TNumber            number{};
    if (!(field >> number) || !field.eof())
    {
      throw CLI::ValidationError(option,
                                 "\"" + part + "\" in \"" + text + "\" is not a " +
                                   (std::is_integral_v<TNumber> ? "whole number" : "number") + "; expected " + form);
    }
    numbers.push_back(number);
  }
  if (numbers.size() != count)
  {
    throw CLI::ValidationError(option,
                               "\"" + text + "\" holds " + std::to_string(numbers.size()) +
                                 (numbers.size() == 1 ? " number" : " numbers") + "; expected " + form);
  }
  return numbers;
}

/** Calls a check of the library. An exception of the check becomes an error of the option. */
template <typename TCheck>
void
CheckOption(const std::string & option, TCheck check)
{
  try
  {
    check();
  }
  catch (const std::invalid_argument & error)
  {
    throw CLI::ValidationError(option, error.what());
  }
}

/** Throws if the method cannot use the setting of this option. */
void
RequireUsedBy(const std::string & method, const std::string & option, const std::string & setting)
{
  if (const std::string reason = ReasonUnused(method, setting); !reason.empty())
  {
    throw CLI::ValidationError(
      option, "the method " + method + " " + reason + "; leave the option out, or set --method refined");
  }
}

void
ReadDnSettings(EstimateOptions & options, const EstimateTexts & texts)
{
  DnSettings dnSettings;
  if (texts.bitDepth != "auto")
  {
    dnSettings.bitDepth = ReadNumbers<int>("--bit-depth", texts.bitDepth, ',', 1, "auto or 1 to 16")[0];
    CheckOption("--bit-depth", [&dnSettings] { ValidateDnSettings(dnSettings); });
    options.bitDepth = static_cast<unsigned int>(*dnSettings.bitDepth);
  }
  if (!texts.step.empty())
  {
    options.step = ReadNumbers<double>("--step", texts.step, ',', 1, "one number above 0")[0];
    dnSettings.quantisationStepDn = options.step;
    CheckOption("--step", [&dnSettings] { ValidateDnSettings(dnSettings); });
  }
  if (!texts.clip.empty())
  {
    const auto levels = ReadNumbers<double>("--clip", texts.clip, ',', 2, "LOW,HIGH");
    dnSettings.clipLowDn = levels[0];
    dnSettings.clipHighDn = levels[1];
    CheckOption("--clip", [&dnSettings] { ValidateDnSettings(dnSettings); });
    options.clipLow = levels[0];
    options.clipHigh = levels[1];
  }
}

void
ReadLevelRange(EstimateOptions & options, const std::string & text)
{
  if (text.empty())
  {
    return;
  }
  const auto levels = ReadNumbers<double>("--level-range", text, ',', 2, "LOW,HIGH");
  CheckOption("--level-range", [&levels] { ValidateLevelRange({ levels[0], levels[1] }); });
  RequireUsedBy(options.method, "--level-range", "level_range");
  options.levelRange = { levels[0], levels[1] };
}

void
RequireRefinedForProfile(const EstimateOptions & options)
{
  if (!options.checkProfile.empty() && options.method != "refined")
  {
    throw CLI::ValidationError("--check-profile",
                               "the method " + options.method +
                                 " does not measure the variance of each level without flicker and motion; leave the "
                                 "profile out, or set --method refined");
  }
}

void
ReadExposuresOf(EstimateOptions & options)
{
  if (options.exposuresText.empty())
  {
    return;
  }
  RequireUsedBy(options.method, "--exposures", "exposures");
  options.exposures = ReadExposures(options.exposuresText);
}

void
ReadOffset(EstimateOptions & options, const EstimateTexts & texts)
{
  if (!texts.offset.empty())
  {
    const bool hasError = texts.offset.find(',') != std::string::npos;
    const auto numbers = ReadNumbers<double>("--offset", texts.offset, ',', hasError ? 2 : 1, "VALUE or VALUE,ERROR");
    options.offset = numbers[0];
    options.offsetStandardError = hasError ? numbers[1] : 0.0;
  }
  if (!texts.offset.empty())
  {
    RequireUsedBy(options.method, "--offset", "offset");
  }
  if (!options.dark.empty())
  {
    RequireUsedBy(options.method, "--dark", "dark");
  }
  if (!options.maps.empty())
  {
    RequireUsedBy(options.method, "--maps", "maps");
  }
}

void
ReadRollingShutter(EstimateOptions & options, const std::string & text)
{
  if (text == "off")
  {
    options.rollingShutter = RollingShutter::Off;
  }
  else if (text != "auto")
  {
    options.rollingShutter = RollingShutter::Fixed;
    options.sigmaRows = ReadNumbers<double>("--rolling-shutter", text, ',', 1, "auto, off or a number of rows")[0];
    CheckOption("--rolling-shutter", [&options] { ValidateShutterRows(options.sigmaRows); });
    if (options.method != "published")
    {
      throw CLI::ValidationError("--rolling-shutter",
                                 "it is " + text + ", and the method " + options.method +
                                   " uses no number of rows; expected auto or off, or --method published");
    }
  }
}

void
RequirePlotName(const std::string & name)
{
  const std::string ending = LowerCaseEnding(name);
  if (!name.empty() && ending != ".html" && ending != ".htm" && ending != ".svg" && ending != ".png")
  {
    throw CLI::ValidationError("--plot",
                               name + " ends in none of .html, .svg and .png; expected for example report.html");
  }
}

void
ReadRegion(EstimateOptions & options, const EstimateTexts & texts)
{
  if (!texts.roi.empty())
  {
    const auto numbers = ReadNumbers<long>("--roi", texts.roi, ',', 4, "X,Y,W,H in pixels");
    options.roi = { numbers[0], numbers[1], numbers[2], numbers[3] };
    if (numbers[0] < 0 || numbers[1] < 0 || numbers[2] < 1 || numbers[3] < 1)
    {
      throw CLI::ValidationError("--roi",
                                 texts.roi + " has a negative corner or no pixels; expected X,Y,W,H in pixels");
    }
  }
  if (!texts.frames.empty())
  {
    const auto numbers =
      ReadNumbers<long>("--frames", texts.frames, ':', 2, "A:B for the frames A to B-1, counted from 0");
    if (numbers[0] < 0 || numbers[1] <= numbers[0])
    {
      throw CLI::ValidationError("--frames", texts.frames + " holds no frame; expected A:B with 0 <= A < B");
    }
    options.frames = { numbers[0], numbers[1] };
  }
}
} // namespace

std::optional<int>
EstimateOptions::Parse(int argc, char ** argv)
{
  CLI::App app(
    "Example:\n"
    "  estimate-sensor-noise frame_*.tif --dark dark_*.tif --plot report.html\n\n"
    "Measures gain, offset and read noise of a camera from a burst of raw frames of a static scene.\n\n"
    "FRAME...: images in time order, one frame a file, or stacks (.mha .mhd .nrrd .tif .ser .mraw .fits .npy), "
    "which together are one burst. A folder, or a pattern in quotation marks ('frame_*.tif'), stands for its files "
    "in the order of their numbers.\n\n"
    "Exit code: 0 done, 2 wrong use or unreadable input, 3 nothing could be estimated, 4 only some settings of --sweep "
    "could be measured.",
    "estimate-sensor-noise");
  app.formatter(std::make_shared<HelpFormatter>(TerminalWidth()));
  EstimateTexts texts;
  AddEstimateOptions(app, *this, texts);
  try
  {
    app.parse(argc, argv);
  }
  catch (const CLI::Success & request)
  {
    return app.exit(request); // --help or --version
  }
  catch (const CLI::ExtrasError &)
  {
    throw std::invalid_argument(UnknownOption(app, app.remaining(true).front()));
  }
  RequireValues(app);
  RequireWork(app, *this);
  RequireOptionsOfEmva(app, *this);
  optionsText = NumericOptions(app);
  hasCheck = app.count("--check") > 0;
  check.erase(std::remove(check.begin(), check.end(), ""), check.end()); // CLI11 stores "" for --check without a name
  for (std::vector<std::string> * const names : { &files, &dark, &check })
  {
    *names = ExpandNames(*names, !raw.empty());
  }
  ReadDnSettings(*this, texts);
  ReadLevelRange(*this, texts.levelRange);
  RequireRefinedForProfile(*this);
  ReadExposuresOf(*this);
  ReadOffset(*this, texts);
  ReadRollingShutter(*this, texts.rollingShutter);
  ReadRegion(*this, texts);
  RequirePlotName(plot);
  return std::nullopt;
}

void
EstimateOptions::SelectFiles(bool areStacks)
{
  if (!frames || areStacks)
  {
    cut = frames;
    return;
  }
  if (frames->second > files.size())
  {
    throw std::invalid_argument("--frames ends at " + std::to_string(frames->second) + ", but there are " +
                                std::to_string(files.size()) + " files; expected A:B with B of at most " +
                                std::to_string(files.size()));
  }
  files = { files.begin() + static_cast<std::ptrdiff_t>(frames->first),
            files.begin() + static_cast<std::ptrdiff_t>(frames->second) };
}

void
EstimateOptions::SelectExposures(std::size_t all)
{
  if (exposures.empty())
  {
    return;
  }
  if (exposures.size() != all)
  {
    throw std::invalid_argument("--exposures holds " + std::to_string(exposures.size()) + " numbers, but there are " +
                                std::to_string(all) + " frames; expected one exposure for each frame" +
                                (frames ? ", also for the frames that --frames leaves out" : ""));
  }
  if (frames && frames->second <= all)
  {
    exposures = { exposures.begin() + static_cast<std::ptrdiff_t>(frames->first),
                  exposures.begin() + static_cast<std::ptrdiff_t>(frames->second) };
  }
}

PlotKind
EstimateOptions::Plot() const
{
  const std::string ending = LowerCaseEnding(plot);
  return plot.empty()       ? PlotKind::None
         : ending == ".svg" ? PlotKind::Svg
         : ending == ".png" ? PlotKind::Png
                            : PlotKind::Page;
}

bool
EstimateOptions::WantsHash() const
{
  return hash || this->Plot() == PlotKind::Page;
}

std::string
EstimateOptions::DescribeRegion() const
{
  std::ostringstream text;
  if (roi)
  {
    text << (*roi)[2] << " x " << (*roi)[3] << " pixels from " << (*roi)[0] << "," << (*roi)[1];
  }
  if (cut)
  {
    text << (roi ? " and " : "") << "frames " << cut->first << " to " << cut->second - 1;
  }
  return text.str();
}

} // namespace sensornoise::tools
