// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef RobustnessRun_h
#define RobustnessRun_h

#include "sensornoise/Report.h"
#include "studies/StressStacks.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace sensornoise::tools
{

/** An estimate's error, and in units of its standard error; null: no estimate, no standard error. */
struct Deviation
{
  std::optional<double> error;
  std::optional<double> z;
};

/** One stack and what was made of it. */
struct Run
{
  StressCase    stressCase;
  std::string   reference;
  std::uint64_t seed;
  double        gain{ 0.0 }; ///< the true one [DN/e-]
  Deviation     gainPercent;
  Deviation     intercept;
  Deviation     offset;
  Report        report;
};

/** How far an estimate is from the truth, in units of \a unit and of its standard error. */
Deviation
Compare(const Quantity & quantity, double truth, double unit);

/** The share of the pixels that the estimate used. */
double
UsedFraction(const Report & report);

/** Mean error and root mean square of z over the runs that have them. */
Deviation
Summarise(const std::vector<const Run *> & runs, Deviation Run::* member);

/** What is wrong with one run: empty if the gain is within 1 % and the intercept within 3 standard errors, or if it is
 * refused and should be, or if the case is `Processed`. Where the response bends the gain has no one value: there its
 * 95 % interval must hold the mean. */
std::string
FindFault(const Run & run);

} // namespace sensornoise::tools

#endif
