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
#ifndef EfficiencyTable_h
#define EfficiencyTable_h

#include "sensornoise/report/Report.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <string>
#include <vector>

namespace sensornoise::tools
{

/** What an estimate is judged by, in the order of the table's rows. */
inline constexpr std::array<const char *, 7> EfficiencyParameters{ "gain",          "intercept",  "offset",
                                                                   "read_noise",    "flicker_sd", "vibration_sd_x",
                                                                   "vibration_sd_y" };
inline constexpr std::size_t                 GainRow = 0;
inline constexpr std::size_t                 OffsetRow = 2;
inline constexpr std::size_t                 FirstVibrationRow = 5;

/** One parameter of one stack. */
struct EfficiencySample
{
  double   truth;
  double   limit; ///< the smallest standard deviation that an unbiased estimate can have; infinite: no estimate can be
  Quantity estimate;

  bool
  IsIdentified() const
  {
    return estimate.status == EstimateStatus::Identified && estimate.value;
  }
};

/** One simulated stack. */
struct EfficiencyRun
{
  std::string                     experiment; ///< camera and condition: "B3"
  std::uint64_t                   seed{ 0 };
  std::array<EfficiencySample, 7> samples{};
  double                          offsetLimitOfRange{ 0.0 }; ///< closed form, over gain times electrons
  double                          usedFraction{ 0.0 };       ///< of the pixels, for the gain
  double                          keptFraction{ 0.0 };       ///< of the pixels, those that the bound is for
};

/** An offset should be reported where its limit is below this fraction of the range. */
inline constexpr double IdentifiableOffsetLimit = 0.05;

/** What the estimates of one parameter are like over several stacks; NaN where nothing is known. */
struct EfficiencyStatistics
{
  std::size_t stacks{ 0 };
  std::size_t identified{ 0 };
  double      truth{ 0.0 };
  double      relativeBias{ 0.0 };    ///< mean of error / |truth|
  double      rmsError{ 0.0 };        ///< in the parameter's unit
  double      relativeRms{ 0.0 };     ///< root mean square of error / |truth|
  double      rmsOverLimit{ 0.0 };    ///< root mean square of error / limit
  double      biasOverLimit{ 0.0 };   ///< mean of error / limit
  double      coverage{ 0.0 };        ///< fraction of the 95 % intervals that hold the truth
  double      rmsOverStandard{ 0.0 }; ///< root mean square of error / standard error
};

namespace detail
{
/** Sum and count of some numbers. */
class Average
{
public:
  void
  Add(double value)
  {
    m_Sum += value;
    ++m_Count;
  }
  double
  Get() const
  {
    return m_Count == 0 ? std::numeric_limits<double>::quiet_NaN() : m_Sum / static_cast<double>(m_Count);
  }

private:
  double      m_Sum{ 0.0 };
  std::size_t m_Count{ 0 };
};

inline bool
Holds(const Interval & interval, double value)
{
  return value >= interval.low.value_or(value) && value <= interval.high.value_or(value);
}

/** A number in a column of \a width; a dash where there is none. */
inline std::string
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
} // namespace detail

/** Judges parameter \a row of the runs. Only identified estimates count. */
inline EfficiencyStatistics
JudgeEfficiency(const std::vector<const EfficiencyRun *> & runs, std::size_t row)
{
  EfficiencyStatistics statistics;
  detail::Average      truth;
  detail::Average      relative;
  detail::Average      squared;
  detail::Average      relativeSquared;
  detail::Average      limitSquared;
  detail::Average      limit;
  detail::Average      held;
  detail::Average      standardSquared;
  for (const EfficiencyRun * run : runs)
  {
    const EfficiencySample & sample = run->samples[row];
    ++statistics.stacks;
    truth.Add(sample.truth);
    if (!sample.IsIdentified())
    {
      continue;
    }
    ++statistics.identified;
    const double error = *sample.estimate.value - sample.truth;
    squared.Add(error * error);
    if (sample.truth != 0.0)
    {
      relative.Add(error / std::abs(sample.truth));
      relativeSquared.Add(error * error / (sample.truth * sample.truth));
    }
    if (std::isfinite(sample.limit))
    {
      limit.Add(error / sample.limit);
      limitSquared.Add(error * error / (sample.limit * sample.limit));
    }
    if (sample.estimate.interval95)
    {
      held.Add(detail::Holds(*sample.estimate.interval95, sample.truth) ? 1.0 : 0.0);
    }
    if (sample.estimate.standardError)
    {
      standardSquared.Add(std::pow(error / *sample.estimate.standardError, 2));
    }
  }
  statistics.truth = truth.Get();
  statistics.relativeBias = relative.Get();
  statistics.rmsError = std::sqrt(squared.Get());
  statistics.relativeRms = std::sqrt(relativeSquared.Get());
  statistics.rmsOverLimit = std::sqrt(limitSquared.Get());
  statistics.biasOverLimit = limit.Get();
  statistics.coverage = held.Get();
  statistics.rmsOverStandard = std::sqrt(standardSquared.Get());
  return statistics;
}

/** The last column of a row. */
inline std::string
EfficiencyRemark(const std::vector<const EfficiencyRun *> & runs, std::size_t row)
{
  char text[120] = "";
  if (row == GainRow)
  {
    detail::Average used;
    detail::Average kept;
    double          least = 1.0;
    for (const EfficiencyRun * run : runs)
    {
      used.Add(run->usedFraction);
      kept.Add(run->keptFraction);
      least = std::min(least, run->usedFraction);
    }
    std::snprintf(text, sizeof(text), "pixels used %.3f (least %.3f), unclipped %.3f", used.Get(), least, kept.Get());
  }
  if (row == OffsetRow)
  {
    std::size_t possible = 0;
    std::size_t identified = 0;
    for (const EfficiencyRun * run : runs)
    {
      const bool isPossible = run->offsetLimitOfRange < IdentifiableOffsetLimit;
      possible += isPossible ? 1 : 0;
      identified += isPossible && run->samples[row].IsIdentified() ? 1 : 0;
    }
    std::snprintf(text, sizeof(text), "limit < 5 %% of range: %zu, identified %zu", possible, identified);
  }
  if (row >= FirstVibrationRow)
  {
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
  }
  return text;
}

inline void
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

/** One line a parameter; none for no runs. Over several experiments, \a isPooled, the rms error is relative and there
 * is no one truth. */
inline void
PrintEfficiencyRows(const std::vector<const EfficiencyRun *> & runs, const std::string & label, bool isPooled)
{
  for (std::size_t row = 0; row < EfficiencyParameters.size() && !runs.empty(); ++row)
  {
    const EfficiencyStatistics statistics = JudgeEfficiency(runs, row);
    const std::string          counts = std::to_string(statistics.identified) + "/" + std::to_string(statistics.stacks);
    const double               none = std::numeric_limits<double>::quiet_NaN();
    std::printf("%-5s %-14s %s %s %s %s %s %s %s %8s  %s\n",
                row == 0 ? label.c_str() : "",
                EfficiencyParameters[row],
                detail::Cell(isPooled ? none : statistics.truth, 9, "%.5g").c_str(),
                detail::Cell(100.0 * statistics.relativeBias, 9, "%+.3f").c_str(),
                (isPooled ? detail::Cell(100.0 * statistics.relativeRms, 8, "%.3g") + " %"
                          : detail::Cell(statistics.rmsError, 10, "%.3g"))
                  .c_str(),
                detail::Cell(statistics.rmsOverLimit, 8, "%.2f").c_str(),
                detail::Cell(statistics.biasOverLimit, 8, "%+.2f").c_str(),
                detail::Cell(statistics.coverage, 6, "%.3f").c_str(),
                detail::Cell(statistics.rmsOverStandard, 7, "%.2f").c_str(),
                counts.c_str(),
                EfficiencyRemark(runs, row).c_str());
  }
  std::fflush(stdout);
}

} // namespace sensornoise::tools

#endif
