// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "tools/SimulateOptions.h"

#include "base/Text.h"
#include "sensornoise/Version.h"
#include "tools/HelpText.h"
#include "tools/OptionHints.h"

#include <CLI/CLI.hpp>
#include <cmath>
#include <memory>
#include <stdexcept>
#include <string>

namespace sensornoise::tools
{
namespace
{
/** Throws std::runtime_error if an option has no effect: a transmission without colour filters, or clip levels that the
 * converter does not reach. */
void
RequireEffect(const SimulateOptions & options)
{
  if (!options.flaws.transmission.empty() && options.flaws.bayer == "none")
  {
    throw std::runtime_error("--transmission is of the colour filters of a mosaic, and the sensor has none; expected "
                             "--bayer with it, for example --bayer RGGB");
  }
  constexpr unsigned int mostBits = 16; // pixels of the stack have 16 bits
  const unsigned int     bits = options.bitDepth == 0 ? mostBits : options.bitDepth;
  const double           highest = std::exp2(bits) - 1.0;
  if (!options.clip.empty() && bits <= mostBits && !(options.clip[0] >= 0.0 && options.clip[1] <= highest))
  {
    throw std::runtime_error("--clip is " + Text(options.clip[0]) + "," + Text(options.clip[1]) +
                             ", and the converter reaches 0 to " + Text(highest) +
                             " DN; expected levels between them. Leave --clip out, or set another --bit-depth");
  }
}
} // namespace

bool
SimulateOptions::Parse(int argc, char ** argv)
{
  CLI::App app{ "Example:\n"
                "  simulate-sensor-noise --output burst.mha --truth truth.json\n\n"
                "Simulates a burst of raw frames of a camera whose noise is known, under flickering illumination and "
                "vibrations (Sur and Grediac 2015, section 4.2).",
                "simulate-sensor-noise" };
  app.formatter(std::make_shared<HelpFormatter>(TerminalWidth()));
  app.option_defaults()->always_capture_default();
  app.add_option("--output", output, "Stack to write: .mha (streamed, any length), .nrrd, .tif or .tiff")->required();
  app.add_option("--truth", truth, "JSON file to write, with what an estimator should find");
  app.add_option("--reference", reference, "Scene: target, bars, texture, flat, or a grey image file");
  app.add_option("--size", size, "Width x height of the scene, as 512x512 (the default)");
  app.add_option("--camera", camera, "Camera of the paper's Table 1: A, B or C");
  app.add_option("--gain", gain, "System gain instead of the gain of the camera [DN/e-]");
  app.add_option("--offset", offset, "Dark offset instead of the offset of the camera [DN]");
  app.add_option("--read-noise", readNoise, "Read noise instead of the read noise of the camera [DN]");
  app.add_option("--electrons", electrons, "Electrons of the brightest pixel instead of the electrons of the camera");
  app.add_option("--condition", condition, "Illumination and vibration of the paper's Table 1: 1, 2 or 3");
  app.add_option(
    "--flicker-sd", flickerSd, "Standard deviation of the flicker instead of the flicker of the condition");
  app.add_option(
    "--illumination",
    illumination,
    "Illumination factor of the frames: steady, pulses, ramp, decay, sine, uniform or exponential, then the "
    "lowest factor and the period in frames (pulses:0.3:4); or a text file with one factor a frame");
  app
    .add_option("--vibration-sd",
                vibrationSd,
                "Standard deviations X,Y of the shifts instead of the vibration of the condition [pixel]")
    ->delimiter(',')
    ->expected(2)
    ->default_str("");
  app.add_option("--optical-blur", opticalBlur, "Standard deviation of the Gaussian optical blur [pixels]");
  app.add_option("--rolling-shutter",
                 rollingShutterPeriod,
                 "Period of pulsed illumination in rows of a rolling shutter; 0: the whole frame flickers");
  app.add_option("--frames", frames, "Number of frames");
  app.add_option(
    "--bit-depth", bitDepth, "Bits of the analogue-to-digital converter, at most 16; 0: no clipping below 65535");
  app.add_option("--clip", clip, "LOW,HIGH: lowest and highest level that the sensor attains [DN]")
    ->delimiter(',')
    ->expected(2)
    ->default_str("");
  app.add_option("--seed", seed, "Seed of the noise; the scene stays the same")->check(ReasonNotWhole);
  flaws.AddTo(app);
  app.set_version_flag("--version", std::string("simulate-sensor-noise ") + GetModuleVersion());
  try
  {
    app.parse(argc, argv);
  }
  catch (const CLI::Success & request)
  {
    app.exit(request); // --help or --version
    return false;
  }
  RequireEffect(*this);
  return true;
}

} // namespace sensornoise::tools
