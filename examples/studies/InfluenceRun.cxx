// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "studies/InfluenceRun.h"

#include "base/ForAll.h"
#include "sensornoise/RefinedMethod.h"
#include "sensornoise/ReportText.h"
#include "studies/RobustnessEstimate.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <functional>
#include <stdexcept>
#include <thread>

namespace sensornoise::tools
{

namespace
{
/** Calls function(k) for k = 0 ... count - 1, \a threads at a time; throws what one of them threw. */
template <typename TFunction>
void
ForEach(std::size_t count, unsigned int threads, TFunction function)
{
  const auto spread = [threads](std::size_t ofAll, const std::function<void(std::size_t)> & call) {
    std::atomic<std::size_t> next{ 0 };
    std::vector<std::thread> workers;
    for (unsigned int i = 0; i < std::max(1U, threads); ++i)
    {
      workers.emplace_back([&] {
        for (std::size_t k = next++; k < ofAll; k = next++)
        {
          call(k);
        }
      });
    }
    for (std::thread & worker : workers)
    {
      worker.join();
    }
  };
  ForAll(count, spread, function);
}
} // namespace

InfluenceCase
MakeInfluenceCase(const std::string & name,
                  const std::string & reference,
                  std::size_t         size,
                  std::uint64_t       seeds,
                  unsigned int        threads)
{
  const std::vector<StressCase> known = GetStressCases();
  const auto                    found =
    std::find_if(known.begin(), known.end(), [&](const StressCase & other) { return other.name == name; });
  if (found == known.end())
  {
    throw std::invalid_argument("the case \"" + name + "\" is not known; measure-robustness --list names them all");
  }
  InfluenceCase made{ *found, reference, std::vector<StressStack>(seeds) };
  ForEach(seeds, threads, [&](std::size_t k) { made.stacks[k] = MakeStressStack(name, reference, size, k + 1); });
  return made;
}

std::vector<Run>
MeasureCase(const InfluenceCase & stacks, unsigned int threads)
{
  std::vector<Run> runs;
  for (std::size_t k = 0; k < stacks.stacks.size(); ++k)
  {
    runs.push_back({ stacks.stressCase, stacks.reference, k + 1, {}, {}, {}, {}, {} });
  }
  ForEach(runs.size(), threads, [&](std::size_t k) {
    FileEstimation(runs[k], stacks.stacks[k], EstimateStack<RefinedMethod>(stacks.stacks[k]));
  });
  return runs;
}

InfluenceResult
SummariseInfluence(const std::vector<Run> & runs, const std::vector<Run> & asIs)
{
  InfluenceResult result;
  double          bias = 0.0;
  double          error = 0.0;
  for (std::size_t k = 0; k < runs.size(); ++k)
  {
    const Deviation & gain = runs[k].gainPercent;
    result.changed += ToJson(runs[k].report) != ToJson(asIs[k].report) ? 1 : 0;
    if (gain.error && gain.z)
    {
      ++result.told;
      result.right += std::abs(*gain.z) <= 3.0 ? 1 : 0;
      bias += *gain.error;
      error += *runs[k].report.gain.standardError / (0.01 * runs[k].gain);
      result.largestZ = std::max(result.largestZ.value_or(0.0), std::abs(*gain.z));
    }
  }
  if (result.told > 0)
  {
    result.biasPercent = bias / static_cast<double>(result.told);
    result.errorPercent = error / static_cast<double>(result.told);
  }
  return result;
}

} // namespace sensornoise::tools
