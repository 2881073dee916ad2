// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef InfluenceRun_h
#define InfluenceRun_h

#include "studies/RobustnessRun.h"
#include "studies/StressStacks.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace sensornoise::tools
{

/** The stacks of one case, seed by seed. */
struct InfluenceCase
{
  StressCase               stressCase;
  std::string              reference;
  std::vector<StressStack> stacks;
};

/** Simulates a case with the seeds 1 ... \a seeds, \a threads at a time.
 * \throws std::invalid_argument if the case or the reference is not known. */
InfluenceCase
MakeInfluenceCase(const std::string & name,
                  const std::string & reference,
                  std::size_t         size,
                  std::uint64_t       seeds,
                  unsigned int        threads);

/** Estimates the stacks of a case with the constants as they are now, \a threads at a time. */
std::vector<Run>
MeasureCase(const InfluenceCase & stacks, unsigned int threads);

/** What the stacks of a case gave. */
struct InfluenceResult
{
  std::optional<double> biasPercent;  ///< mean error of the gain
  std::optional<double> errorPercent; ///< mean of its standard errors
  std::optional<double> largestZ;     ///< of the gain, in units of its standard error, without its sign
  std::size_t           told{ 0 };    ///< stacks whose gain is told
  std::size_t           right{ 0 };   ///< within 3 standard errors of the truth
  std::size_t           changed{ 0 }; ///< reports that are not those of \a asIs
};

/** \a asIs are the runs of the same stacks with all constants as they are. */
InfluenceResult
SummariseInfluence(const std::vector<Run> & runs, const std::vector<Run> & asIs);

} // namespace sensornoise::tools

#endif
