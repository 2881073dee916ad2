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
#ifndef RobustnessTable_h
#define RobustnessTable_h

#include "sensornoise/report/Quantities.h"
#include "sensornoise/report/Report.h"
#include "studies/RobustnessRun.h"

#include <cmath>
#include <cstddef>
#include <cstdio>
#include <optional>
#include <string>
#include <vector>

namespace sensornoise::tools
{

inline std::string
Text(const std::optional<double> & number, const char * format)
{
  char text[64] = "-";
  if (number)
  {
    std::snprintf(text, sizeof(text), format, *number);
  }
  return text;
}

inline const char *
Text(EstimateStatus status)
{
  switch (status)
  {
    case EstimateStatus::Identified:
      return "identified";
    case EstimateStatus::NotIdentifiable:
      return "not-identifiable";
    case EstimateStatus::UpperLimit:
      return "upper-limit";
    default:
      return "failed";
  }
}

/** The 95 % interval, or the physical limits, or nothing. */
inline std::string
Text(const Quantity & quantity)
{
  const auto & interval = quantity.interval95 ? quantity.interval95 : quantity.bracket;
  return interval ? '[' + Text(interval->low, "%.2f") + ", " + Text(interval->high, "%.2f") + ']' : "-";
}

inline std::string
JoinCodes(const std::vector<Warning> & warnings)
{
  std::string codes;
  for (const Warning & warning : warnings)
  {
    codes += (codes.empty() ? "" : ",") + warning.code;
  }
  return codes.empty() ? "-" : codes;
}

/** What the columns of PrintRun are. */
inline void
PrintRunHeader(const std::string & method, std::size_t size)
{
  std::printf("method %s, %zu x %zu pixels; mu interval: 95 %%, or the physical limits where mu is not identified\n",
              method.c_str(),
              size,
              size);
  std::printf("%-20s %-8s %4s  %9s %6s  %10s %6s  %9s %6s  %-20s %-16s  %5s  %9s  %s\n",
              "case",
              "ref.",
              "seed",
              "g err %",
              "z",
              "c err DN^2",
              "z",
              "mu err DN",
              "z",
              "mu interval DN",
              "mu status",
              "used",
              "sigma DN",
              "warnings");
}

inline void
PrintRun(const Run & run)
{
  const Report & report = run.report;
  std::printf("%-20s %-8s %4llu  %9s %6s  %10s %6s  %9s %6s  %-20s %-16s  %5.3f  %9s  %s\n",
              run.stressCase.name.c_str(),
              run.reference.c_str(),
              static_cast<unsigned long long>(run.seed),
              Text(run.gainPercent.error, "%+.3f").c_str(),
              Text(run.gainPercent.z, "%+.1f").c_str(),
              Text(run.intercept.error, "%+.3f").c_str(),
              Text(run.intercept.z, "%+.1f").c_str(),
              Text(run.offset.error, "%+.3f").c_str(),
              Text(run.offset.z, "%+.1f").c_str(),
              Text(report.offset).c_str(),
              Text(report.offset.status),
              UsedFraction(report),
              Text(report.readNoise.value, "%.4g").c_str(),
              JoinCodes(report.warnings).c_str());
  std::fflush(stdout);
}

/** One line a case and reference: over the seeds, mean error and rms z, and the verdict. */
inline void
PrintSummary(const std::vector<Run> & runs)
{
  std::printf(
    "\nover the seeds: mean error, rms of error / standard error; id: runs that identify the offset; verdict ok: "
    "every gain within 1 %%\nand every intercept within 3 standard errors (if there are any); an identified "
    "offset is only marked\n");
  std::printf("%-20s %-8s  %9s %6s  %10s %6s  %9s %6s  %-5s  %5s  %s\n",
              "case",
              "ref.",
              "g err %",
              "z",
              "c err DN^2",
              "z",
              "mu err DN",
              "z",
              "id",
              "used",
              "verdict");
  std::size_t misses = 0;
  std::size_t groups = 0;
  for (std::size_t first = 0, end = 0; first < runs.size(); first = end)
  {
    std::vector<const Run *> group;
    std::string              fault;
    double                   used = 0.0;
    std::size_t              identified = 0;
    bool                     isOffsetOff = false;
    for (; end < runs.size() && runs[end].stressCase.name == runs[first].stressCase.name &&
           runs[end].reference == runs[first].reference;
         ++end)
    {
      group.push_back(&runs[end]);
      fault = fault.empty() ? FindFault(runs[end]) : fault;
      used += UsedFraction(runs[end].report);
      identified += runs[end].offset.error ? 1 : 0;
      isOffsetOff = isOffsetOff || std::abs(runs[end].offset.z.value_or(0.0)) > 3.0;
    }
    const bool        isRefusal = runs[first].stressCase.expectation == StressExpectation::Refused;
    const Deviation   gain = Summarise(group, &Run::gainPercent);
    const Deviation   intercept = Summarise(group, &Run::intercept);
    const Deviation   offset = Summarise(group, &Run::offset);
    const std::string verdict = !fault.empty() ? "MISS (" + fault + ')' : isRefusal ? "failed as expected" : "ok";
    std::printf("%-20s %-8s  %9s %6s  %10s %6s  %9s %6s  %2zu/%-2zu  %5.3f  %s%s\n",
                runs[first].stressCase.name.c_str(),
                runs[first].reference.c_str(),
                Text(gain.error, "%+.3f").c_str(),
                Text(gain.z, "%.1f").c_str(),
                Text(intercept.error, "%+.3f").c_str(),
                Text(intercept.z, "%.1f").c_str(),
                Text(offset.error, "%+.3f").c_str(),
                Text(offset.z, "%.1f").c_str(),
                identified,
                group.size(),
                used / static_cast<double>(group.size()),
                verdict.c_str(),
                isOffsetOff ? ", offset beyond 3 standard errors" : "");
    misses += fault.empty() ? 0 : 1;
    ++groups;
  }
  std::printf("%zu of %zu missed\n", misses, groups);
}

} // namespace sensornoise::tools

#endif
