// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "tools/SimulateFlawOptions.h"

#include <CLI/CLI.hpp>

namespace sensornoise::tools
{
namespace
{
constexpr const char * SensorGroup = "The sensor";
constexpr const char * CameraGroup = "Processing in the camera";

/** Adds an option with two numbers, which is empty by default. */
void
AddPair(CLI::App & app, const char * name, std::vector<double> & values, const char * help, const char * group)
{
  app.add_option(name, values, help)->delimiter(',')->expected(2)->default_str("")->group(group);
}
} // namespace

void
SimulateFlawOptions::AddTo(CLI::App & app)
{
  const auto add = [&app](const char * name, auto & value, const char * help, const char * group) {
    app.add_option(name, value, help)->group(group);
  };
  app.add_option("--bayer", bayer, "Mosaic of colour filters: RGGB, GRBG, GBRG or BGGR")
    ->check(CLI::IsMember({ "none", "RGGB", "GRBG", "GBRG", "BGGR" }))
    ->group(SensorGroup);
  app
    .add_option("--transmission",
                transmission,
                "R,G,B: transmission of each filter, relative to the electrons of the scene; 0.6,1,0.5")
    ->delimiter(',')
    ->expected(3)
    ->default_str("")
    ->group(SensorGroup);
  add("--prnu", prnu, "Relative standard deviation of the pixels' efficiency", SensorGroup);
  add("--dsnu", dsnu, "Standard deviation of the pixels' offset [DN]", SensorGroup);
  AddPair(app,
          "--hot-pixels",
          hotPixels,
          "FRACTION,FACTOR: fraction of hot pixels, and the factor of their read noise",
          SensorGroup);
  add("--gain-pattern", gainPattern, "Relative standard deviation of the pixels' gain", SensorGroup);
  add("--column-gain-pattern", columnGainPattern, "Relative standard deviation of the columns' gain", SensorGroup);
  add("--column-efficiency-pattern",
      columnEfficiencyPattern,
      "Relative standard deviation of the columns' efficiency",
      SensorGroup);
  add("--column-offset-pattern", columnOffsetPattern, "Standard deviation of the columns' offset [DN]", SensorGroup);
  add("--brighter-fatter",
      brighterFatter,
      "Shift of the border between two pixels for each electron of difference, for example 1e-6",
      SensorGroup);
  add("--coupling", coupling, "Fraction of its charge that a pixel gives to each of its four neighbours", SensorGroup);
  add("--read-noise-spread",
      readNoiseSpread,
      "Standard deviation of the logarithm of the pixels' read noise; --read-noise is their median",
      SensorGroup);
  AddPair(app,
          "--read-noise-tail",
          readNoiseTail,
          "FRACTION,SPREAD: fraction of pixels whose logarithm is greater by |normal| times SPREAD",
          SensorGroup);
  app
    .add_option("--response",
                response,
                "SHAPE,SIZE: quadratic, wave or shoulder and the deviation of the local gain, gamma and its exponent, "
                "s-curve and its weight; straight,0")
    ->delimiter(',')
    ->group(SensorGroup);
  add("--row-noise",
      rowNoise,
      "Standard deviation of the noise common to the pixels of a row in a frame [DN]",
      SensorGroup);
  add("--column-noise",
      columnNoise,
      "Standard deviation of the noise common to the pixels of a column in a frame [DN]",
      SensorGroup);
  AddPair(app,
          "--banding",
          banding,
          "AMPLITUDE,PERIOD of a sine along y [DN], [rows], with another phase in each frame",
          SensorGroup);
  app.add_flag("--dark", isDark, "Frames with the shutter closed: the same sensor and fixed pattern, other noise")
    ->group(SensorGroup);
  this->AddProcessingTo(app);
}

void
SimulateFlawOptions::AddProcessingTo(CLI::App & app)
{
  const auto add = [&app](const char * name, auto & value, const char * help) {
    app.add_option(name, value, help)->group(CameraGroup);
  };
  add("--defect-correction",
      defectCorrection,
      "Deviation from the neighbours, in their standard deviations, from which a pixel becomes their median; 0: none");
  add("--temporal-filter", temporalFilter, "Weight of the last frame in each frame; 0: none");
  add("--median", median, "Radius of a median filter [pixels], 1: 3 x 3; 0: none");
  add("--smoothing", smoothing, "Standard deviation of a Gaussian filter [pixels]; 0: none");
  add(
    "--binning", binning, "Side of the square tiles whose pixels become their mean, at the old size [pixels]; 1: none");
  add("--binning-interpolation", binningInterpolation, "Interpolation between the tiles: nearest or linear");
  AddPair(app, "--resampling", resampling, "X,Y: shift by interpolation [pixels]", CameraGroup);
  add("--resampling-interpolation", resamplingInterpolation, "linear or cubic");
  add("--block-quality", blockQuality, "JPEG-like quantization of 8 x 8 pixels: libjpeg's quality, 1 to 100; 0: none");
  add("--companding", companding, "Bits of the square-root quantization that is expanded again; 0: none");
  add("--repeat", repeat, "Number of times that each exposure is written");
  add("--repeat-period", repeatPeriod, "Number of exposures in a period, whose last one alone is repeated");
}

} // namespace sensornoise::tools
