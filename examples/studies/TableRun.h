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
#ifndef TableRun_h
#define TableRun_h

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <thread>
#include <vector>

namespace sensornoise::tools
{

/** One simulated stack and what was estimated from it. */
struct TableRun
{
  std::string                          reference;
  char                                 camera;
  int                                  condition;
  std::size_t                          frames;
  std::uint64_t                        seed;
  std::array<std::optional<double>, 7> estimates{}; ///< as TableParameters
  std::array<double, 7>                truth{};
};

/** The command line of reproduce-tables. */
struct TableOptions
{
  std::string              reference{ "target" };
  unsigned int             seeds{ 20 };
  std::size_t              size{ 512 };
  std::size_t              frames{ 100 };
  double                   rollingShutterPeriod{ 0.0 };
  double                   flickerSd{ -1.0 };
  std::vector<std::string> experiments{ "A1", "A2", "A3", "B1", "B2", "B3", "C1", "C2", "C3" };
  std::vector<double>      clip;
  unsigned int             threads{ std::max(1U, std::thread::hardware_concurrency()) };
  bool                     figure6{ false };
  std::string              csv;
};

/** Simulates and estimates all runs, some at a time. */
void
ExecuteAll(std::vector<TableRun> & runs, const TableOptions & options);

} // namespace sensornoise::tools

#endif
