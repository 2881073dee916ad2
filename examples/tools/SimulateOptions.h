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
  std::vector<double>   vibrationSd;
  std::vector<double>   clip;
  double                opticalBlur{ 0.5 };
  double                rollingShutterPeriod{ 0.0 };
  unsigned int          frames{ 100 };
  unsigned int          bitDepth{ 12 };
  std::uint64_t         seed{ 1 };
  SimulateFlawOptions   flaws;

  /** Reads the command line; false if there is nothing left to do (--help, --version). Throws std::exception on wrong
   * use. */
  bool
  Parse(int argc, char ** argv);
};

} // namespace sensornoise::tools

#endif
