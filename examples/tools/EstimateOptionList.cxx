// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "tools/EstimateOptionList.h"

#include "sensornoise/Version.h"
#include "tools/EstimateOptions.h"
#include "tools/OptionHints.h"

#include <limits>

namespace sensornoise::tools
{
namespace
{
CLI::Option *
AddText(CLI::App & app, const std::string & name, std::string & text, const char * type, const std::string & words)
{
  return app.add_option(name, text, words)->type_name(type);
}

/** Returns the bytes of a size such as 4G. Throws CLI::ValidationError for other texts. */
std::string
BytesOfSize(const std::string & text)
{
  std::string bytes = text;
  bool        isSize = IsWholeNumber(text.substr(0, 1)); // CLI11 reads -1 as the largest number
  try
  {
    isSize = isSize && CLI::AsSizeValue(true)(bytes).empty();
  }
  catch (const CLI::ValidationError &)
  {
    isSize = false;
  }
  if (!isSize)
  {
    throw CLI::ValidationError("it is \"" + text + "\"; expected a whole number of bytes, for example 4G or 500M");
  }
  return bytes;
}

void
AddInputOptions(CLI::App & app, EstimateOptions & options, EstimateTexts & texts)
{
  app.add_option("FRAME", options.files, "frames in time order, or stacks")->group("Input");
  app
    .add_option(
      "--dark",
      options.dark,
      "frames without light, of the same size and type and at the same exposure, gain and temperature: they determine "
      "offset and read noise. A folder or a pattern in quotation marks, too. Takes all names behind it: write the "
      "frames "
      "before it, or end the list with --")
    ->type_name("FILE")
    ->group("Input");
  AddText(
    app,
    "--raw",
    options.raw,
    "LAYOUT",
    "WxH:TYPE[:SKIP[:ROW[:GAP[:END]]]]: frames without a header, for instance 640x480:uint16le, or "
    "1920x1080:Mono12p:64 behind 64 other bytes. TYPE: uint8, uint16le, uint16be, int16le, uint32le, int32le, "
    "float32le, float64le, Mono10p, Mono12p, Mono12Packed, BayerRG12p, RAW10, RAW12, SRGGB10P, uint12msb and the "
    "like. ROW: bytes from a row to the next (0: the bytes of its pixels). GAP: bytes behind each frame. END: bytes at "
    "the end of the file. Dark frames and the frames of --check are read in the same way")
    ->group("Input");
  app
    .add_option("--channel",
                options.choice.channel,
                "the channel that is measured, from 0, where a TIFF of OME or ImageJ has several")
    ->check(ReasonNotWhole)
    ->type_name("N")
    ->group("Input");
  app.add_option("--plane", options.choice.plane, "the same, of the planes (Z, slices)")
    ->check(ReasonNotWhole)
    ->type_name("N")
    ->group("Input");
  AddText(app, "--frames", texts.frames, "A:B", "only the frames A, A+1, ... B-1, counted from 0")->group("Input");
  AddText(app, "--roi", texts.roi, "X,Y,W,H", "only these pixels")->group("Input");
  AddText(app, "--mask", options.mask, "FILE", "image: only pixels that are not 0")->group("Input");
  AddText(app,
          "--exposures",
          options.exposuresText,
          "LIST",
          "exposures of the frames, in their order and in any unit, 0 for dark frames: numbers with commas, or a "
          "file with one frame a line, whose exposure is the last column. With them the linearity error of EMVA "
          "1288 is measured. For all frames, also the frames that --frames leaves out")
    ->group("Input");
}

void
AddSweepOption(CLI::App & app, EstimateOptions & options)
{
  app
    .add_option(
      "--sweep",
      options.sweep,
      "a camera at all its settings, in place of FRAME. NAME is a folder with a folder for each setting (iso100, "
      "iso200, gain2.5, gain6dB, or 10ms at one gain), whose dark frames are in its folder dark. It may also be "
      "stacks, "
      "or frames that record their ISO speed, or a table, file.csv, with the columns iso, gain, gain_db, exposure or "
      "exposure_ms, then frames and dark. "
      "--json writes the passport, from which export-noise-model makes every format. A setting that is in it, "
      "with the same files and options, is not measured again")
    ->expected(1, std::numeric_limits<int>::max())
    ->type_name("NAME")
    ->group("Input");
}

void
AddSensorOptions(CLI::App & app, EstimateOptions & options, EstimateTexts & texts)
{
  app
    .add_option(
      "--bayer",
      options.bayer,
      "colour filters of the sensor: RGGB, GRBG, GBRG or BGGR, from the upper left pixel on, whose four planes "
      "are measured each by itself; none: a monochrome sensor; auto: as the file says, else as the levels "
      "show, which do not distinguish red from blue")
    ->check(CLI::IsMember({ "auto", "none", "RGGB", "GRBG", "GBRG", "BGGR" }))
    ->type_name("PATTERN")
    ->capture_default_str()
    ->group("Sensor");
  AddText(app, "--bit-depth", texts.bitDepth, "BITS", "bits of the digital numbers, 1 to 16, or auto")
    ->capture_default_str()
    ->group("Sensor");
  AddText(app, "--clip", texts.clip, "LOW,HIGH", "lowest and highest level that the sensor attains [DN]; else found")
    ->group("Sensor");
  AddText(app, "--step", texts.step, "DN", "quantization step [DN]; else found")->group("Sensor");
  AddText(app,
          "--level-range",
          texts.levelRange,
          "LOW,HIGH",
          "levels between which the variance is fitted [DN], where the response is linear in a part of its range; else "
          "all")
    ->group("Sensor");
  const auto offset = AddText(app,
                              "--offset",
                              texts.offset,
                              "DN[,ERROR]",
                              "dark offset and its standard error [DN], if known; else found. Not with --dark");
  offset->excludes(app.get_option("--dark"))->group("Sensor");
  app
    .add_option("--excess-noise-factor",
                options.excessNoiseFactor,
                "F, 1 or more, if the sensor multiplies electrons at random: 2 for an EMCCD. The gain is the slope of "
                "the variance divided by F, which the frames do not determine")
    ->check(CLI::Range(1.0, std::numeric_limits<double>::max(), "NUMBER >= 1"))
    ->type_name("F")
    ->capture_default_str()
    ->group("Sensor");
  AddText(app,
          "--rolling-shutter",
          texts.rollingShutter,
          "ROWS",
          "auto, off, or (for published) the width sigma_y of a row's neighbourhood [rows]")
    ->capture_default_str()
    ->group("Sensor");
}

/** Adds the options for output files. */
void
AddOutputOptions(CLI::App & app, EstimateOptions & options)
{
  AddText(app, "--json", options.json, "FILE", "file for the report, or - for standard output")->group("Output");
  AddText(app,
          "--xml",
          options.xml,
          "FILE",
          "with --method emva1288: file for the results, as the package emva1288 writes them")
    ->group("Output");
  AddText(app,
          "--plot",
          options.plot,
          "FILE",
          "file.html: the report as a page to look at, with figures and maps, that needs no other file; "
          "file.svg or, where the program was built with librsvg, file.png: variance against mean alone")
    ->group("Output");
  AddText(app,
          "--maps",
          options.maps,
          "FOLDER",
          "folder for mean, variance, corrected variance and pixel use (.mha); from two dark frames on also the "
          "pixels' offset and read noise, with the ends of their 95 % intervals. Without them, the maps of dark frames "
          "that an "
          "earlier estimate wrote into the folder are removed")
    ->group("Output");
  app
    .add_flag(
      "--hash",
      options.hash,
      "also the SHA-256 of the frames' files in the report, as a page always has it: cat FRAME... | sha256sum, where a "
      "header stands for the files of its pixels. Reads the files once more")
    ->group("Output");
  app.add_flag("--quiet", options.quiet, "no table and no progress")->group("Output");
}

void
AddCheckOptions(CLI::App & app, EstimateOptions & options)
{
  app
    .add_option(
      "--check",
      options.check,
      "says at which levels the report's noise model is true of other frames of the same camera and setting; without a "
      "name, of the frames themselves. Takes all names behind it, as --dark does")
    ->expected(0, std::numeric_limits<int>::max())
    ->type_name("FILE")
    ->group("Checks");
  AddText(app,
          "--check-profile",
          options.checkProfile,
          "FILE",
          "says whether the noise profile of another program is true of the frames, and what is wrong with it: DNG, "
          "tuning file of libcamera, PYME, picasso, every format of export-noise-model that determines the variance")
    ->group("Checks");
  const auto addLevel = [&](const char * name, auto & value, const char * words) {
    app.add_option(name, value, words)->needs("--check-profile")->type_name("DN")->group("Checks");
  };
  addLevel("--black", options.profileLevels.blackLevelDn, "black level for --check-profile; else the files' own");
  addLevel("--white", options.profileLevels.whiteLevelDn, "white level for --check-profile; else the files' own");
  app
    .add_option(
      "--analogue-gain", options.profileLevels.analogueGain, "analogue gain of the frames, for a profile of libcamera")
    ->needs("--check-profile")
    ->type_name("G")
    ->capture_default_str()
    ->group("Checks");
  app
    .add_option(
      "--compare",
      options.compare,
      "two or more stored reports (--json), of exposures, settings, cameras or days: what differs by more than "
      "its errors, and by how much, in place of a measurement; with --plot as a page or a figure")
    ->expected(1, std::numeric_limits<int>::max())
    ->type_name("FILE")
    ->group("Checks");
}

void
AddOtherOptions(CLI::App & app, EstimateOptions & options)
{
  app
    .add_option(
      "--method",
      options.method,
      "refined; or published: Figure 2 of Sur & Grediac 2015; or single-image: the even areas of one frame, "
      "after Foi et al. 2008, which gives the gain, but neither offset nor read noise; or emva1288: flat fields and "
      "dark frames at several exposures, after EMVA Standard 1288 Release 4. FRAME is then a list of exposures "
      "(.csv, or a descriptor .txt of the package emva1288), or --exposures gives them; or FRAME and --dark are raw "
      "files that record their exposures")
    ->check(CLI::IsMember({ "refined", "published", "single-image", "emva1288" }))
    ->type_name("NAME")
    ->capture_default_str()
    ->group("Other");
  app
    .add_option(
      "--memory-limit",
      options.memoryLimit,
      "most memory for the estimate, for instance 4G [bytes]: the stack is read more often where it would need "
      "more, with the same result")
    ->transform(BytesOfSize)
    ->type_name("SIZE")
    ->group("Other");
  app.add_option("--threads", options.threads, "number of threads; else all")
    ->check(CLI::Range(1, 1024))
    ->type_name("N")
    ->group("Other");
  app.set_version_flag("--version", std::string("estimate-sensor-noise ") + GetModuleVersion(), "prints the version")
    ->group("Other");
  app.set_help_flag("-h,--help", "prints this text")->group("Other");
}
} // namespace

void
AddEstimateOptions(CLI::App & app, EstimateOptions & options, EstimateTexts & texts)
{
  AddInputOptions(app, options, texts);
  AddSweepOption(app, options);
  AddSensorOptions(app, options, texts);
  AddOutputOptions(app, options);
  AddCheckOptions(app, options);
  AddOtherOptions(app, options);
}

} // namespace sensornoise::tools
