// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef SimulateOptions_h
#define SimulateOptions_h

#include "tools/SimulateFlawOptions.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace sensornoise::tools
{

/** The command line of simulate-sensor-noise. */
struct SimulateOptions
{
  std::string           output;
  std::string           truth;
  std::string           reference{ "target" };
  std::string           size;
  std::string           camera{ "B" };
  int                   condition{ 3 };
  std::optional<double> gain;
  std::optional<double> offset;
  std::optional<double> readNoise;
  std::optional<double> electrons;
  std::optional<double> flickerSd;
  std::string           illumination{ "steady" };
  std::vector<double>   vibrationSd;
  std::vector<double>   clip;
  double                opticalBlur{ 0.5 };
  double                rollingShutterPeriod{ 0.0 };
  unsigned int          frames{ 100 };
  unsigned int          bitDepth{ 12 };
  std::uint64_t         seed{ 1 };
  SimulateFlawOptions   flaws;

  /** Reads the command line. Returns false if nothing is left to do (--help, --version). Throws std::exception on
   * wrong use. */
  bool
  Parse(int argc, char ** argv);
};

} // namespace sensornoise::tools

#endif
