/*=========================================================================
 *
 *  Copyright the ITKSensorNoise contributors
 *
 *  Licensed under the Apache License, Version 2.0 (the "License");
 *  you may not use this file except in compliance with the License.
 *  You may obtain a copy of the License at
 *
 *         https://www.apache.org/licenses/LICENSE-2.0.txt
 *
 *  Unless required by applicable law or agreed to in writing, software
 *  distributed under the License is distributed on an "AS IS" BASIS,
 *  WITHOUT WARRANTIES OR CONDITIONS OF ANY KIND, either express or implied.
 *  See the License for the specific language governing permissions and
 *  limitations under the License.
 *
 *=========================================================================*/
#ifndef EfficiencyOptions_h
#define EfficiencyOptions_h

#include "sensornoise/simulation/Scenes.h"

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
