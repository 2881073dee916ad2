// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "studies/EfficiencyTable.h"

#include "sensornoise/Report.h"
#include "sensornoise/ReportText.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <fstream>
#include <limits>
#include <optional>
#include <stdexcept>

namespace sensornoise::tools
{
namespace
{
/** A number in a column of \a width; a dash where there is none. */
std::string
Cell(double value, int width, const char * format)
{
  char text[40] = "-";
  if (!std::isnan(value))
  {
    std::snprintf(text, sizeof(text), format, value);
  }
  const std::string cell(text);
  const auto        columns = static_cast<std::size_t>(width);
  return std::string(columns > cell.size() ? columns - cell.size() : 0, ' ') + cell;
}
/** The last column of the gain: how much of the frame was used. */
std::string
RemarkOnPixels(const std::vector<const EfficiencyRun *> & runs)
{
  char    text[120] = "";
  Average used;
  Average kept;
  double  least = 1.0;
  for (const EfficiencyRun * run : runs)
  {
    used.Add(run->usedFraction);
    kept.Add(run->keptFraction);
    least = std::min(least, run->usedFraction);
  }
  std::snprintf(text, sizeof(text), "pixels used %.3f (least %.3f), unclipped %.3f", used.Get(), least, kept.Get());
  return text;
}

/** Of the offset: was it found where it could be? */
std::string
RemarkOnOffset(const std::vector<const EfficiencyRun *> & runs)
{
  char        text[120] = "";
  std::size_t possible = 0;
  std::size_t identified = 0;
  for (const EfficiencyRun * run : runs)
  {
    const bool isPossible = run->offsetLimitOfRange < IdentifiableOffsetLimit;
    possible += isPossible ? 1 : 0;
    identified += isPossible && run->samples[OffsetRow].IsIdentified() ? 1 : 0;
  }
  std::snprintf(text, sizeof(text), "limit < 5 %% of range: %zu, identified %zu", possible, identified);
  return text;
}

/** Of a vibration: the largest error. */
std::string
RemarkOnVibration(const std::vector<const EfficiencyRun *> & runs, std::size_t row)
{
  char   text[120] = "";
  double worst = -1.0;
  for (const EfficiencyRun * run : runs)
  {
    const EfficiencySample & sample = run->samples[row];
    const double             error = std::abs(sample.estimate.value.value_or(sample.truth) - sample.truth);
    worst = sample.IsIdentified() ? std::max(worst, error / std::max(0.03 * sample.truth, 0.0005)) : worst;
  }
  if (worst >= 0.0)
  {
    std::snprintf(text, sizeof(text), "worst %.2f of max(3 %%, 0.0005 px)", worst);
  }
  return text;
}

std::string
Remark(const std::vector<const EfficiencyRun *> & runs, std::size_t row)
{
  return row == GainRow             ? RemarkOnPixels(runs)
         : row == OffsetRow         ? RemarkOnOffset(runs)
         : row >= FirstVibrationRow ? RemarkOnVibration(runs, row)
                                    : "";
}
} // namespace

void
PrintEfficiencyHeader()
{
  std::printf("%-5s %-14s %9s %9s %10s %8s %8s %6s %7s %8s  remark\n",
              "exp.",
              "parameter",
              "truth",
              "bias %",
              "rms error",
              "rms/lim",
              "bias/lim",
              "cover",
              "z-rms",
              "n/N");
}

void
PrintEfficiencyRows(const std::vector<const EfficiencyRun *> & runs, const std::string & label, bool isPooled)
{
  for (std::size_t row = 0; row < EfficiencyParameters.size() && !runs.empty(); ++row)
  {
    const EfficiencyStatistics statistics = JudgeEfficiency(runs, row);
    const std::string          counts = std::to_string(statistics.identified) + "/" + std::to_string(statistics.stacks);
    const double               none = std::numeric_limits<double>::quiet_NaN();
    std::printf(
      "%-5s %-14s %s %s %s %s %s %s %s %8s  %s\n",
      row == 0 ? label.c_str() : "",
      EfficiencyParameters[row],
      Cell(isPooled ? none : statistics.truth, 9, "%.5g").c_str(),
      Cell(100.0 * statistics.relativeBias, 9, "%+.3f").c_str(),
      (isPooled ? Cell(100.0 * statistics.relativeRms, 8, "%.3g") + " %" : Cell(statistics.rmsError, 10, "%.3g"))
        .c_str(),
      Cell(statistics.rmsOverLimit, 8, "%.2f").c_str(),
      Cell(statistics.biasOverLimit, 8, "%+.2f").c_str(),
      Cell(statistics.coverage, 6, "%.3f").c_str(),
      Cell(statistics.rmsOverStandard, 7, "%.2f").c_str(),
      counts.c_str(),
      Remark(runs, row).c_str());
  }
  std::fflush(stdout);
}

void
WriteEfficiencyCsv(const std::string & name, const std::vector<EfficiencyRun> & runs)
{
  std::ofstream file(name);
  file << "experiment,seed,parameter,truth,estimate,standard_error,low95,high95,status,limit,used_fraction,"
          "unclipped_fraction\n";
  file.precision(10);
  const auto write = [&file](const std::optional<double> & number) {
    if (number)
    {
      file << *number;
    }
    file << ',';
  };
  for (const EfficiencyRun & run : runs)
  {
    for (std::size_t row = 0; row < EfficiencyParameters.size(); ++row)
    {
      const EfficiencySample & sample = run.samples[row];
      const Interval           interval = sample.estimate.interval95.value_or(Interval{});
      file << run.experiment << ',' << run.seed << ',' << EfficiencyParameters[row] << ',' << sample.truth << ',';
      write(sample.estimate.value);
      write(sample.estimate.standardError);
      write(interval.low);
      write(interval.high);
      file << NameOf(sample.estimate.status) << ',' << sample.limit << ',' << run.usedFraction << ','
           << run.keptFraction << '\n';
    }
  }
  if (!file.flush())
  {
    throw std::runtime_error("cannot write " + name);
  }
}

} // namespace sensornoise::tools
