// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "tools/EstimateOptions.h"

#include "report/StackSettings.h"
#include "sensornoise/Settings.h"
#include "tools/EstimateOptionList.h"
#include "tools/ExposureList.h"
#include "tools/FileNames.h"
#include "tools/HelpText.h"
#include "tools/LowerCase.h"
#include "tools/OptionHints.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <set>
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

/** Calls a check of the library. What it throws becomes an error of the option. */
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
ReadCodes(EstimateOptions & options, const EstimateTexts & texts)
{
  CodeSettings codes;
  if (texts.bitDepth != "auto")
  {
    codes.bitDepth = ReadNumbers<int>("--bit-depth", texts.bitDepth, ',', 1, "auto or 1 to 16")[0];
    CheckOption("--bit-depth", [&codes] { ValidateCodeSettings(codes); });
    options.bitDepth = static_cast<unsigned int>(*codes.bitDepth);
  }
  if (!texts.step.empty())
  {
    options.step = ReadNumbers<double>("--step", texts.step, ',', 1, "one number above 0")[0];
    codes.quantisationStepDn = options.step;
    CheckOption("--step", [&codes] { ValidateCodeSettings(codes); });
  }
  if (!texts.clip.empty())
  {
    const auto levels = ReadNumbers<double>("--clip", texts.clip, ',', 2, "LOW,HIGH");
    codes.clipLowDn = levels[0];
    codes.clipHighDn = levels[1];
    CheckOption("--clip", [&codes] { ValidateCodeSettings(codes); });
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

/** Throws std::invalid_argument for a command line without frames. It explains that --dark and --check take all
 * names that follow. */
[[noreturn]] void
RefuseMissingFrames(const EstimateOptions & options)
{
  const std::string tool = "estimate-sensor-noise ";
  if (LowerCaseEnding(options.json) != ".json" && std::filesystem::exists(options.json))
  {
    throw std::invalid_argument("no FRAME is left: --json takes the name behind it, " + options.json +
                                ", for the report. Name the report, too: " + tool + options.json +
                                " --json report.json");
  }
  if (options.dark.empty() && options.check.empty())
  {
    throw std::invalid_argument("no FRAME was given; expected image files, a folder or a stack: " + tool +
                                "FRAMES [OPTIONS] (--help explains the options)");
  }
  const bool        isDark = !options.dark.empty();
  const std::string option = isDark ? "--dark" : "--check";
  const std::string files = isDark ? "DARKS" : "OTHERS";
  const std::size_t names = isDark ? options.dark.size() : options.check.size();
  throw std::invalid_argument("no FRAME is left: " + option + " takes all names behind it, here " +
                              std::to_string(names) + ". Write the frames first: " + tool + "FRAMES " + option + " " +
                              files + ". Or end the list with --: " + tool + option + " " + files + " -- FRAMES");
}

/** Throws if an option is given that a sweep has no use for. */
void
RequireSweepOptions(const CLI::App & app, const EstimateOptions & options)
{
  for (const char * const name : { "--exposures", "--check", "--check-profile", "--compare", "--maps", "--dark" })
  {
    if (app.count(name) > 0)
    {
      throw CLI::ValidationError("--sweep",
                                 std::string("it measures many bursts, and ") + name +
                                   (std::string(name) == "--dark"
                                      ? " gives the dark frames of one setting; put those of each setting into the "
                                        "folder dark of its folder, or into the column dark of a table"
                                      : " is for one of them; leave it out, or measure the burst by itself"));
    }
  }
  if (!options.files.empty())
  {
    throw CLI::ValidationError("--sweep", "it takes the place of FRAME; leave out " + options.files.front());
  }
  if (options.method != "refined")
  {
    throw CLI::ValidationError("--sweep", "the method is " + options.method + "; expected --method refined");
  }
  if (!options.plot.empty() && options.Plot() != PlotKind::Page)
  {
    throw CLI::ValidationError("--sweep", options.plot + " (--plot) is no page; expected for example sweep.html");
  }
}

/** Returns the options of a sweep that change numbers, as they were given. */
std::string
NumericOptions(const CLI::App & app)
{
  const std::set<std::string> others{ "--sweep", "--json",    "--plot",         "--quiet",
                                      "--hash",  "--threads", "--memory-limit", "FRAME" };
  std::string                 text;
  for (const CLI::Option * const option : app.get_options())
  {
    if (option->count() > 0 && others.count(option->get_name()) == 0)
    {
      text += (text.empty() ? "" : " ") + option->get_name();
      for (const std::string & value : option->results())
      {
        text += " " + value;
      }
    }
  }
  return text;
}

/** Throws if there are no frames to be measured. With --compare it throws if an option for measurements is given, or
 * fewer than two reports. With --sweep it throws as RequireSweepOptions(). */
void
RequireWork(const CLI::App & app, const EstimateOptions & options)
{
  if (!options.sweep.empty())
  {
    RequireSweepOptions(app, options);
    return;
  }
  if (app.count("--compare") == 0)
  {
    if (options.files.empty())
    {
      RefuseMissingFrames(options);
    }
    return;
  }
  const std::set<std::string> forBoth{ "--compare", "--plot", "--quiet", "--help" };
  for (const CLI::Option * const option : app.get_options())
  {
    if (option->count() > 0 && forBoth.count(option->get_name()) == 0)
    {
      throw CLI::ValidationError("--compare",
                                 "it reads stored reports and measures nothing; leave out " + option->get_name() +
                                   ", or leave out --compare");
    }
  }
  if (options.compare.size() < 2)
  {
    throw CLI::ValidationError("--compare", "there is one report; expected two or more to be compared");
  }
}

/** Throws if an option is given that the method emva1288 does not have, or --xml with another method. */
void
RequireOptionsOfEmva(const CLI::App & app, const EstimateOptions & options)
{
  if (options.method != "emva1288")
  {
    if (!options.xml.empty())
    {
      throw CLI::ValidationError(
        "--xml", "the method " + options.method + " writes no XML; leave it out, or set --method emva1288");
    }
    return;
  }
  const std::set<std::string> known{ "FRAME",   "--method",  "--exposures", "--dark", "--json", "--xml",
                                     "--plot",  "--quiet",   "--raw",       "--step", "--roi",  "--channel",
                                     "--plane", "--threads", "--bit-depth", "--bayer" };
  for (const CLI::Option * const option : app.get_options())
  {
    if (option->count() > 0 && known.count(option->get_name()) == 0)
    {
      throw CLI::ValidationError("--method",
                                 "the method emva1288 does not use " + option->get_name() +
                                   "; leave it out. A part of the frame is selected by --roi");
    }
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
    "FRAME...: images in time order, one frame a file; or stacks (.mha .mhd .nrrd .tif .ser .mraw .fits .npy), "
    "which together are one burst; or a folder, or a pattern in quotation marks ('frame_*.tif'), whose files "
    "are read in the order of their numbers.\n\n"
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
  ReadCodes(*this, texts);
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
                                (frames ? ", also for those that --frames leaves out" : ""));
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
