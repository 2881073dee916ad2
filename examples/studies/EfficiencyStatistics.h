// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef EfficiencyStatistics_h
#define EfficiencyStatistics_h

#include "sensornoise/Report.h"

#include <array>
#include <cstddef>
#include <cstdint>
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

/** Judges parameter \a row of the runs. Only identified estimates count. */
EfficiencyStatistics
JudgeEfficiency(const std::vector<const EfficiencyRun *> & runs, std::size_t row);

} // namespace sensornoise::tools

#endif
