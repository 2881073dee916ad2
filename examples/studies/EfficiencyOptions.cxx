// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "studies/EfficiencyOptions.h"

#include <CLI/CLI.hpp>

namespace sensornoise::tools
{

std::optional<int>
EfficiencyOptions::Parse(int argc, char ** argv)
{
  CLI::App app(
    "How close the estimates come to the theoretical limit, by simulation. One line an experiment and parameter:\n"
    "bias; rms error; rms error over the limit, per stack (rms/lim; 1 is the best there is); mean error over the "
    "limit;\n"
    "how many 95 % intervals hold the truth; rms of error over standard error (z-rms, should be 1); how many of the N\n"
    "stacks identify the parameter. Flicker and vibrations are compared with what the stack really had. Last, all\n"
    "experiments together, then conditions 2 and 3, and condition 1: rms error in % of the truth.");
  app.add_option("--method", method)->check(CLI::IsMember({ "refined", "published" }))->capture_default_str();
  app.add_option("--reference", reference, "target, texture, bars or an image file")->capture_default_str();
  app.add_option("--scene-seed", sceneSeed, "another target or texture")->capture_default_str();
  app.add_option("--experiments", experiments, "camera and condition, for example A1,B3")
    ->delimiter(',')
    ->check(CLI::IsMember({ "A1", "A2", "A3", "B1", "B2", "B3", "C1", "C2", "C3" }));
  app.add_option("--seeds", seeds, "stacks of each experiment")->check(CLI::Range(1, 10000))->capture_default_str();
  app.add_option("--first-seed", firstSeed)->capture_default_str();
  app.add_option("--size", size, "width and height of a scene [pixels]")
    ->check(CLI::Range(32, 4096))
    ->capture_default_str();
  app.add_option("--frames", frames)->check(CLI::Range(5, 10000))->capture_default_str();
  app.add_option("--flicker-sd", flickerSd, "instead of the condition's [1]");
  app.add_option("--vibration-sd", vibrationSd, "X,Y instead of the condition's [pixels]")->delimiter(',')->expected(2);
  app.add_option("--gain", gain, "instead of the camera's [DN/e-]");
  app.add_option("--offset", offset, "instead of the camera's [DN]");
  app.add_option("--read-noise", readNoise, "instead of the camera's [DN]");
  app.add_option("--electrons", electrons, "brightest pixel, instead of the camera's [e-]");
  auto * shutter = app.add_option("--rolling-shutter",
                                  rollingShutterPeriod,
                                  "bands of the flicker [rows]; 0: global. The limit is that of global flicker");
  auto * mosaic =
    app.add_option("--bayer", bayer, "pattern of colour filters: each plane by itself, a group of lines each")
      ->check(CLI::IsMember({ "none", "RGGB", "GRBG", "GBRG", "BGGR" }));
  app.add_flag("--full-bound", isFullBound, "the Cramer-Rao bound itself: 4 s a stack; else closed forms, 3 % off")
    ->excludes(shutter)
    ->excludes(mosaic);
  app.add_option("--threads", threads, "stacks at the same time")->check(CLI::Range(1, 1024));
  app.add_option("--csv", csv, "every single stack, one line a parameter");
  try
  {
    app.parse(argc, argv);
  }
  catch (const CLI::ParseError & error)
  {
    return app.exit(error);
  }
  return std::nullopt;
}

} // namespace sensornoise::tools
