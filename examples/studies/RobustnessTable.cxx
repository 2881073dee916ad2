// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "studies/RobustnessTable.h"

#include "sensornoise/Report.h"
#include "sensornoise/ReportText.h"

#include <cmath>
#include <cstdio>
#include <optional>

namespace sensornoise::tools
{
namespace
{
std::string
NumberText(const std::optional<double> & number, const char * format)
{
  char text[64] = "-";
  if (number)
  {
    std::snprintf(text, sizeof(text), format, *number);
  }
  return text;
}

/** The 95 % interval, or the physical limits, or nothing. */
std::string
IntervalText(const Quantity & quantity)
{
  const auto & interval = quantity.interval95 ? quantity.interval95 : quantity.bracket;
  return interval ? '[' + NumberText(interval->low, "%.2f") + ", " + NumberText(interval->high, "%.2f") + ']' : "-";
}

std::string
JoinCodes(const std::vector<Warning> & warnings)
{
  std::string codes;
  for (const Warning & warning : warnings)
  {
    codes += (codes.empty() ? "" : ",");
    codes += KindOf(warning.code).name;
  }
  return codes.empty() ? "-" : codes;
}

/** The runs of one case and reference. */
struct RunGroup
{
  std::vector<const Run *> runs;
  std::string              fault;
  double                   used{ 0.0 };
  std::size_t              identified{ 0 };
  bool                     isOffsetOff{ false };

  void
  Add(const Run & run)
  {
    runs.push_back(&run);
    fault = fault.empty() ? FindFault(run) : fault;
    used += UsedFraction(run.report);
    identified += run.offset.error ? 1 : 0;
    isOffsetOff = isOffsetOff || std::abs(run.offset.z.value_or(0.0)) > 3.0;
  }
};

bool
IsSameGroup(const Run & run, const Run & other)
{
  return run.stressCase.name == other.stressCase.name && run.reference == other.reference;
}

void
PrintGroup(const RunGroup & group)
{
  const Run &       first = *group.runs.front();
  const auto        expectation = first.stressCase.expectation;
  const Deviation   gain = Summarise(group.runs, &Run::gainPercent);
  const Deviation   intercept = Summarise(group.runs, &Run::intercept);
  const Deviation   offset = Summarise(group.runs, &Run::offset);
  const std::string verdict = !group.fault.empty()                          ? "MISS (" + group.fault + ')'
                              : expectation == StressExpectation::Refused   ? "failed as expected"
                              : expectation == StressExpectation::Processed ? "processed"
                                                                            : "ok";
  std::printf("%-20s %-8s  %9s %6s  %10s %6s  %9s %6s  %2zu/%-2zu  %5.3f  %s%s\n",
              first.stressCase.name.c_str(),
              first.reference.c_str(),
              NumberText(gain.error, "%+.3f").c_str(),
              NumberText(gain.z, "%.1f").c_str(),
              NumberText(intercept.error, "%+.3f").c_str(),
              NumberText(intercept.z, "%.1f").c_str(),
              NumberText(offset.error, "%+.3f").c_str(),
              NumberText(offset.z, "%.1f").c_str(),
              group.identified,
              group.runs.size(),
              group.used / static_cast<double>(group.runs.size()),
              verdict.c_str(),
              group.isOffsetOff ? ", offset beyond 3 standard errors" : "");
}
} // namespace

void
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

void
PrintRun(const Run & run)
{
  const Report & report = run.report;
  std::printf("%-20s %-8s %4llu  %9s %6s  %10s %6s  %9s %6s  %-20s %-16s  %5.3f  %9s  %s\n",
              run.stressCase.name.c_str(),
              run.reference.c_str(),
              static_cast<unsigned long long>(run.seed),
              NumberText(run.gainPercent.error, "%+.3f").c_str(),
              NumberText(run.gainPercent.z, "%+.1f").c_str(),
              NumberText(run.intercept.error, "%+.3f").c_str(),
              NumberText(run.intercept.z, "%+.1f").c_str(),
              NumberText(run.offset.error, "%+.3f").c_str(),
              NumberText(run.offset.z, "%+.1f").c_str(),
              IntervalText(report.offset).c_str(),
              NameOf(report.offset.status),
              UsedFraction(report),
              NumberText(report.readNoise.value, "%.4g").c_str(),
              JoinCodes(report.warnings).c_str());
  std::fflush(stdout);
}

void
PrintSummary(const std::vector<Run> & runs)
{
  std::printf(
    "\nover the seeds: mean error, rms of error / standard error; id: runs that identify the offset; verdict ok: "
    "every gain within 1 %%,\nor its 95 %% interval holds the mean gain where the response bends, and every intercept "
    "within 3 standard errors (if there are any);\nan identified offset is only marked; processed: noise is shared "
    "between pixels or frames, which is not counted\n");
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
    RunGroup group;
    for (; end < runs.size() && IsSameGroup(runs[end], runs[first]); ++end)
    {
      group.Add(runs[end]);
    }
    PrintGroup(group);
    misses += group.fault.empty() ? 0 : 1;
    groups += group.runs.front()->stressCase.expectation == StressExpectation::Processed ? 0 : 1;
  }
  std::printf("%zu of %zu missed\n", misses, groups);
}

} // namespace sensornoise::tools
