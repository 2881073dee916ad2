// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef EfficiencyOptions_h
#define EfficiencyOptions_h

#include "sensornoise/Simulator.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <thread>
#include <vector>

namespace sensornoise::tools
{

/** The command line of measure-efficiency. */
struct EfficiencyOptions
{
  std::string              method{ "refined" };
  std::string              reference{ "target" };
  std::uint64_t            sceneSeed{ DefaultSceneSeed };
  std::vector<std::string> experiments{ "A1", "A2", "A3", "B1", "B2", "B3", "C1", "C2", "C3" };
  std::uint64_t            seeds{ 20 };
  std::uint64_t            firstSeed{ 1 };
  std::size_t              size{ 512 };
  std::size_t              frames{ 100 };
  std::optional<double>    flickerSd;
  std::vector<double>      vibrationSd;
  std::optional<double>    gain;
  std::optional<double>    offset;
  std::optional<double>    readNoise;
  std::optional<double>    electrons;
  std::string              bayer{ "none" };
  double                   rollingShutterPeriod{ 0.0 };
  bool                     isFullBound{ false };
  unsigned int             threads{ std::max(1U, std::thread::hardware_concurrency()) };
  std::string              csv;

  /** Reads the command line; the exit code if there is nothing left to do (--help) or it is wrong. */
  std::optional<int>
  Parse(int argc, char ** argv);
};

} // namespace sensornoise::tools

#endif
