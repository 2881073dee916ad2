// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef RealSensorStatistics_h
#define RealSensorStatistics_h

#include "studies/RealSensorRun.h"

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace sensornoise::tools
{

/** What 95 % intervals should hold [1]. */
inline constexpr double NominalCoverage = 0.95;

/** How often something was so among the stacks where it could be. */
struct Share
{
  std::size_t met{ 0 };
  std::size_t count{ 0 };

  void
  Add(const std::optional<bool> & isMet)
  {
    met += isMet && *isMet ? 1 : 0;
    count += isMet ? 1 : 0;
  }
  /** met / count; NaN if it never could be. */
  double
  Get() const;
};

/** The estimates of one quantity over several stacks; NaN where nothing is known. */
struct JudgedStatistics
{
  Share  held;                ///< 95 % intervals that hold the truth, of those called identified
  Share  limitsHeld;          ///< limits above the truth, of those that cannot be told from zero
  Share  bracketsHeld;        ///< physical limits that hold the truth
  Share  inBracket;           ///< values within their own physical limits
  double rmsZ{ 0.0 };         ///< root mean square of error / standard error
  double meanZ{ 0.0 };        ///< mean of the same
  double errorPercent{ 0.0 }; ///< mean standard error, in % of the truth
  double biasPercent{ 0.0 };  ///< mean error, in % of the truth
};

JudgedStatistics
Judge(const std::vector<RealSensorOutcome> & outcomes, JudgedQuantity quantity);

/** The share whose gain is `failed`. */
Share
CountRefused(const std::vector<RealSensorOutcome> & outcomes);

/** How many stacks have each warning, by its code. */
std::map<std::string, std::size_t>
CountWarnings(const std::vector<RealSensorOutcome> & outcomes);

/** Probability of at most \a share.met out of share.count if each is met with \a probability (0 to 1, exclusive); 1 for
 * none. */
double
BinomialLowerTail(const Share & share, double probability);

} // namespace sensornoise::tools

#endif
