// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef RealSensorDemands_h
#define RealSensorDemands_h

#include "studies/RealSensorRun.h"
#include "studies/RealSensorSetting.h"

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace sensornoise::tools
{

/** What the stacks of a line have to show. */
struct RealSensorDemand
{
  /** Whether a stack shows it; null: the stack does not count. */
  using Test = std::function<std::optional<bool>(const RealSensorSetting &, const RealSensorOutcome &)>;

  std::string what;
  Test        test;
  double      lowestShare{ 1.0 };  ///< of the stacks that count
  bool        isCoverage{ false }; ///< of 95 % intervals: a single setting that is improbable is shown, too
};

/** The demands on a line, by its name: refusals, coverage, errors. */
std::vector<RealSensorDemand>
GetDemands(const std::string & line);

/** Those on the lines of processed frames; null for another line. */
std::optional<std::vector<RealSensorDemand>>
FindProcessedDemands(const std::string & line);

/** The gain is not `failed`. */
RealSensorDemand
NeverRefused();

/** 95 % intervals of what is called identified hold the truth in 90 % of the stacks or more. */
RealSensorDemand
Coverage(JudgedQuantity quantity);

/** The gain is identified, and off by \a fraction or three standard errors at most. \param text the fraction in words
 */
RealSensorDemand
GainWithin(double fraction, const std::string & text);

} // namespace sensornoise::tools

#endif
