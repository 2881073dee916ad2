// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
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
