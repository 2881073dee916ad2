// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
// Measures frames of bare numbers with changed constants of the refined method, and prints the report as JSON.
// examples/python/study_ablation.py writes such frames. See --help.

#include "studies/InfluenceConstants.h"
#include "studies/MeasuredStack.h"
#include "mosaic/MosaicGeometry.h"
#include "sensornoise/FrameGeometry.h"
#include "sensornoise/Parallel.h"
#include "sensornoise/Settings.h"

#include <CLI/CLI.hpp>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <fstream>
#include <iostream>
#include <iterator>
#include <stdexcept>
#include <string>
#include <vector>

namespace
{
using namespace sensornoise;
using Pixels = std::vector<std::uint16_t>;

struct Options
{
  std::string              stack;
  std::string              dark;
  std::vector<std::size_t> size;
  std::vector<std::string> constants;
};

/** Returns the pixels of a file: 16 bits each, without a sign, in the byte order of this machine. Throws
 * std::runtime_error unless they are at least \a fewest frames of \a pixels pixels. */
Pixels
ReadFrames(const std::string & name, std::size_t pixels, std::size_t fewest)
{
  std::ifstream     file(name, std::ios::binary);
  const std::string bytes{ std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>() };
  const std::size_t ofFrame = pixels * sizeof(Pixels::value_type);
  if (!file || bytes.size() % ofFrame != 0 || bytes.size() / ofFrame < fewest)
  {
    throw std::runtime_error(name + " has " + std::to_string(bytes.size()) + " bytes; expected at least " +
                             std::to_string(fewest) + " frames of " + std::to_string(ofFrame) + " bytes");
  }
  Pixels read(bytes.size() / sizeof(Pixels::value_type));
  bytes.copy(reinterpret_cast<char *>(read.data()), bytes.size());
  return read;
}

KnownOffset
MeasureDark(const Pixels & frames, const FrameGeometry & geometry)
{
  DarkFrameSums<std::uint16_t> sums(geometry);
  sums.AddFrames(frames.data(), frames.size() / geometry.Pixels(), SerialFor);
  return sums.Measure({}, SerialFor).front();
}

void
Measure(const Options & options)
{
  const FrameGeometry geometry{ options.size[0], options.size[1], 1 };
  RefinedSettings     settings;
  if (!options.dark.empty())
  {
    settings.offset = MeasureDark(ReadFrames(options.dark, geometry.Pixels(), 2), geometry);
  }
  const Pixels      stack = ReadFrames(options.stack, geometry.Pixels(), 2);
  const std::size_t frames = stack.size() / geometry.Pixels();
  std::cout << tools::MeasureBy(RefinedMethod<std::uint16_t>(settings, geometry, frames), stack, frames).ReportRecord()
            << '\n';
}
} // namespace

int
main(int argc, char * argv[])
{
  Options  options;
  CLI::App app("Measures frames with changed constants of the refined method, and prints the report as JSON.");
  app.add_option("STACK", options.stack, "file of frames: pixels of 16 bits without a sign, and nothing else")
    ->required();
  app.add_option("--size", options.size, "WIDTH,HEIGHT of the frames [pixels]")
    ->required()
    ->delimiter(',')
    ->expected(2);
  app.add_option("--dark", options.dark, "such a file of dark frames");
  app.add_option("--constant", options.constants, "NAME=FACTOR: multiply a constant, which measure-varied-cases lists");
  CLI11_PARSE(app, argc, argv);
  try
  {
    tools::MultiplyConstants(options.constants);
    Measure(options);
  }
  catch (const std::exception & error)
  {
    std::cerr << "error: " << error.what() << '\n';
    return 2;
  }
  return 0;
}
