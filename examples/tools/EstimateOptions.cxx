// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "tools/EstimateOptions.h"

#include "sensornoise/base/RollingShutter.h"
#include "sensornoise/report/Version.h"
#include "tools/ExposureList.h"
#include "tools/LowerCase.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstddef>
#include <limits>
#include <optional>
#include <set>
#include <sstream>
#include <stdexcept>
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

/** Values that are read once all options are known. */
struct Texts
{
  std::string bitDepth{ "auto" };
  std::string clip;
  std::string step;
  std::string levelRange;
  std::string offset;
  std::string rollingShutter{ "auto" };
  std::string roi;
  std::string frames;
};

/** What changes no number. */
void
AddMachineOptions(CLI::App & app, EstimateOptions & options)
{
  app
    .add_option(
      "--memory-limit",
      options.memoryLimit,
      "most memory for the estimate, for instance 4G [bytes]: the stack is read more often where it would need "
      "more, with the same result")
    ->transform(CLI::AsSizeValue(true));
  app.add_option("--threads", options.threads, "number of threads; else all")->check(CLI::Range(1, 1024));
}

/** What is written, and where. */
void
AddOutputOptions(CLI::App & app, EstimateOptions & options)
{
  app.add_option("--json", options.json, "file for the report, or - for standard output");
  app.add_option("--plot",
                 options.plot,
                 "file.html: the report as a page to look at, with figures and maps, that needs no other file; "
                 "file.svg or, where the program was built with librsvg, file.png: variance against mean alone");
  app.add_flag("--hash",
               options.hash,
               "also the SHA-256 of the frames' files in the report, as a page always has it: that of cat FRAME... | "
               "sha256sum, behind a header the files of its pixels. Reads the files once more");
  app.add_option(
    "--maps",
    options.maps,
    "folder for mean, variance, corrected variance and pixel use (.mha); from two --dark frames on also the "
    "pixels' offset and read noise, with the ends of their 95 % intervals");
  app
    .add_option(
      "--compare",
      options.compare,
      "two or more stored reports (--json), of exposures, settings, cameras or days: what differs by more than "
      "its errors, and by how much, in place of a measurement; with --plot as a page or a figure")
    ->expected(1, std::numeric_limits<int>::max());
  app.add_flag("--quiet", options.quiet, "no table and no progress");
}

void
AddOptions(CLI::App & app, EstimateOptions & options, Texts & texts)
{
  app.add_option("FRAME", options.files, "frames in time order, or one stack");
  app.add_option(
    "--raw",
    options.raw,
    "WxH:TYPE[:SKIP[:ROW]]: frames without a header, for instance 640x480:uint16le, or 1920x1080:Mono12p:64 "
    "behind 64 other bytes; TYPE: uint8, uint16le, uint16be, int16le, float32le, float64le, Mono10p, "
    "Mono12p, Mono12Packed, BayerRG12p, RAW10, RAW12, SRGGB10P, uint12msb and the like; ROW: bytes from a row "
    "to the next. Dark frames and those of --check are taken for the same");
  app.add_option("--method", options.method, "refined, or published: Figure 2 of Sur & Grediac 2015")
    ->check(CLI::IsMember({ "refined", "published" }))
    ->capture_default_str();
  app
    .add_option(
      "--bayer",
      options.bayer,
      "colour filters of the sensor: RGGB, GRBG, GBRG or BGGR, from the upper left pixel on, whose four planes "
      "are measured each by itself; none: a monochrome sensor; auto: as the file says, else as the levels "
      "tell, which cannot tell red from blue")
    ->check(CLI::IsMember({ "auto", "none", "RGGB", "GRBG", "GBRG", "BGGR" }))
    ->capture_default_str();
  app.add_option("--bit-depth", texts.bitDepth, "bits of the sensor's codes, 1 to 16, or auto")->capture_default_str();
  app.add_option("--clip", texts.clip, "LOW,HIGH: lowest and highest level that the sensor attains [DN]; else found");
  app.add_option("--step", texts.step, "spacing of the codes [DN]; else found");
  app.add_option("--level-range",
                 texts.levelRange,
                 "LOW,HIGH: levels between which the variance is fitted [DN], where the response is straight in a part "
                 "of its range; else all");
  app.add_option(
    "--exposures",
    options.exposuresText,
    "exposures of the frames, in their order and in any unit, 0 for dark frames: numbers with commas, or a "
    "file with one frame a line, whose exposure is the last column. With them the linearity error of EMVA "
    "1288 is measured. Of all FRAME..., also of those that --frames leaves out");
  app
    .add_option("--excess-noise-factor",
                options.excessNoiseFactor,
                "F, 1 or more, if the sensor multiplies electrons at random: 2 for an EMCCD. The gain is the slope of "
                "the variance divided by F, which the frames cannot tell")
    ->check(CLI::Range(1.0, std::numeric_limits<double>::max(), "NUMBER >= 1"))
    ->capture_default_str();
  app
    .add_option("--rolling-shutter",
                texts.rollingShutter,
                "auto, off, or (for published) the width sigma_y of a row's neighbourhood [rows]")
    ->capture_default_str();
  const auto offsetOption =
    app.add_option("--offset", texts.offset, "VALUE[,ERROR]: offset and its standard error [DN], if known; else found");
  app
    .add_option("--dark",
                options.dark,
                "frames without light, or one stack, of the same size and type and at the same exposure, gain and "
                "temperature: they tell offset and read noise. Write them behind FRAME...")
    ->excludes(offsetOption);
  app
    .add_option(
      "--check",
      options.check,
      "says at which levels the report's noise model is true of other frames, or one stack, of the same camera "
      "and setting; without a name, of FRAME... themselves. Write them behind FRAME...")
    ->expected(0, std::numeric_limits<int>::max());
  app.add_option("--roi", texts.roi, "X,Y,W,H: only these pixels");
  app.add_option("--mask", options.mask, "image file: only pixels that are not 0");
  app.add_option("--frames", texts.frames, "A:B: only the frames A, A+1, ... B-1, counted from 0");
  AddMachineOptions(app, options);
  AddOutputOptions(app, options);
  app.set_version_flag("--version", std::string("estimate-sensor-noise ") + GetModuleVersion());
}

void
ReadCodes(EstimateOptions & options, const Texts & texts)
{
  if (texts.bitDepth != "auto")
  {
    options.bitDepth = ReadNumbers<unsigned int>("--bit-depth", texts.bitDepth, ',', 1)[0];
    if (options.bitDepth < 1 || options.bitDepth > 16)
    {
      throw CLI::ValidationError("--bit-depth", texts.bitDepth + " is not auto or a number from 1 to 16");
    }
  }
  if (!texts.step.empty())
  {
    options.step = ReadNumbers<double>("--step", texts.step, ',', 1)[0];
    if (!(options.step > 0.0))
    {
      throw CLI::ValidationError("--step", texts.step + " is not a positive number");
    }
  }
  if (!texts.clip.empty())
  {
    const auto levels = ReadNumbers<double>("--clip", texts.clip, ',', 2);
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
  const auto levels = ReadNumbers<double>("--level-range", text, ',', 2);
  if (!(levels[0] < levels[1]))
  {
    throw CLI::ValidationError("--level-range", text + " holds no level; expected LOW,HIGH with LOW < HIGH");
  }
  if (options.method == "published")
  {
    throw CLI::ValidationError("--level-range",
                               text + " was given and the method published fits all levels; leave it out, or set "
                                      "--method refined");
  }
  options.levelRange = { levels[0], levels[1] };
}

void
ReadExposuresOf(EstimateOptions & options)
{
  if (options.exposuresText.empty())
  {
    return;
  }
  if (options.method == "published")
  {
    throw CLI::ValidationError("--exposures",
                               "the method published does not measure the linearity; leave the exposures out, or set "
                               "--method refined");
  }
  options.exposures = ReadExposures(options.exposuresText);
}

void
ReadOffset(EstimateOptions & options, const Texts & texts)
{
  if (!texts.offset.empty())
  {
    const bool hasError = texts.offset.find(',') != std::string::npos;
    const auto numbers = ReadNumbers<double>("--offset", texts.offset, ',', hasError ? 2 : 1);
    options.offset = numbers[0];
    options.offsetStandardError = hasError ? numbers[1] : 0.0;
  }
  if (options.method == "published" && (!texts.offset.empty() || !options.dark.empty()))
  {
    throw CLI::ValidationError(texts.offset.empty() ? "--dark" : "--offset",
                               "the method published finds the offset from the flicker alone; leave it out, or set "
                               "--method refined");
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
    options.sigmaRows = ReadNumbers<double>("--rolling-shutter", text, ',', 1)[0];
    if (!(options.sigmaRows > 0.0))
    {
      throw CLI::ValidationError("--rolling-shutter", text + " is not auto, off or a positive number of rows");
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

/** There are frames to be measured, or reports to be compared and nothing that is for measuring. */
void
RequireWork(const CLI::App & app, const EstimateOptions & options)
{
  if (app.count("--compare") == 0)
  {
    if (options.files.empty())
    {
      throw CLI::RequiredError("FRAME");
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

void
ReadRegion(EstimateOptions & options, const Texts & texts)
{
  if (!texts.roi.empty())
  {
    const auto numbers = ReadNumbers<long>("--roi", texts.roi, ',', 4);
    options.roi = { numbers[0], numbers[1], numbers[2], numbers[3] };
    if (numbers[0] < 0 || numbers[1] < 0 || numbers[2] < 1 || numbers[3] < 1)
    {
      throw CLI::ValidationError("--roi", texts.roi + " has a negative corner or no pixels");
    }
  }
  if (!texts.frames.empty())
  {
    const auto numbers = ReadNumbers<long>("--frames", texts.frames, ':', 2);
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
  CLI::App app("Measures gain, offset and read noise of a camera from a burst of raw frames of a static scene.\n"
               "FRAME...: 2-D image files in time order, or 3-D stack files of one burst (.mha .mhd .nrrd .tif .ser "
               ".mraw .fits .npy).\n"
               "Exit code: 0 done, 2 wrong use or unreadable input, 3 nothing could be estimated.");
  Texts    texts;
  AddOptions(app, *this, texts);
  try
  {
    app.parse(argc, argv);
  }
  catch (const CLI::Success & request)
  {
    return app.exit(request); // --help or --version
  }
  RequireWork(app, *this);
  hasCheck = app.count("--check") > 0;
  check.erase(std::remove(check.begin(), check.end(), ""), check.end()); // what CLI11 makes of no name
  ReadCodes(*this, texts);
  ReadLevelRange(*this, texts.levelRange);
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
                                std::to_string(files.size()) + " files");
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
