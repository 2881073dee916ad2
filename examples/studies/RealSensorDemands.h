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
