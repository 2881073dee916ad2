// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "pixels/VarianceFit.h"

#include "base/Simd.h"
#include "base/ChiSquare.h"
#include "base/Quantiles.h"
#include "sensornoise/Parallel.h"
#include "moments/Constants.h"
#include "moments/DarkFrames.h"
#include "pixels/Constants.h"
#include "pixels/VarianceLine.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

/** \file
 * Weights, trimming and the dispersion of the noise in VarianceFit. */

namespace sensornoise
{

ChiSquareTrim::ChiSquareTrim(double lowest, double highest, double tail)
  : m_First(static_cast<std::size_t>(std::max(1.0, std::round(lowest))))
{
  for (auto k = static_cast<double>(m_First); k <= std::max(1.0, std::round(highest)); k += 1.0)
  {
    const double low = ChiSquareQuantile(tail, k);
    const double high = ChiSquareUpperQuantile(tail, k);
    m_Limits.push_back({ low / k,
                         high / k,
                         (ChiSquareCdf(high, k + 2.0) - ChiSquareCdf(low, k + 2.0)) / (1.0 - 2.0 * tail),
                         ChiSquareQuantile(0.5, k) / k });
  }
}

namespace
{
/** Sets the weights of pixels that do not count to 0. This is a separate loop, because a branch around a division
 * prevents SIMD instructions for both. */
template <typename TNumbers>
void
TakeWeights(const TNumbers & counts, std::size_t pixels, TNumbers & weights)
{
  for (std::size_t i = 0; i < pixels; ++i)
  {
    const double weight = weights[i];
    weights[i] = counts[i] > 0.0 ? weight : 0.0;
  }
}

/** Sets the numbers after the first \a pixels of a run to 0, so that they add nothing. */
template <typename... TNumbers>
void
ClearBehind(std::size_t pixels, TNumbers &... numbers)
{
  (std::fill(numbers.begin() + static_cast<std::ptrdiff_t>(pixels), numbers.end(), 0.0), ...);
}

/** Returns the weight of a variance with the degrees of freedom 2 \a halfDof and the expectation \a expected
 * [1/DN^4]. */
double
WeightAt(const VarianceLine & line, double halfDof, double expected)
{
  return halfDof / (expected * expected + halfDof * line.noiseDispersionDn4);
}

/** Returns 1 between two limits, else 0: numbers, for SIMD instructions. */
double
IsBetween(double value, double low, double high)
{
  return (value > low ? 1.0 : 0.0) * (value < high ? 1.0 : 0.0);
}

/** Deviation of variances from a line. The members are copies that no pointer can alias. */
struct Deviation
{
  VarianceLine line{};
  VarianceData data{};
  double       reach{};      ///< largest excess that is kept [DN^2]
  double       reachBelow{}; ///< largest deficit that is kept [DN^2]

  /** Returns the variance by the line at the level of the pixel's neighbours [DN^2]. */
  double
  Expected(std::size_t p) const
  {
    return line.At(data.neighbourMean[p]);
  }
  /** Returns the excess of \a variance of pixel \a p over the line at the pixel's level [DN^2]. */
  double
  Excess(std::size_t p, double variance) const
  {
    return variance - line.At(data.mean[p]);
  }
  /** Returns 1 if \a excess is kept, else 0. */
  double
  IsWithinReach(double excess) const
  {
    return IsBetween(excess, -reachBelow, reach);
  }
};
} // namespace

void
VarianceFit::WeighRun(std::size_t first, std::size_t pixels, Run & run) const
{
  m_Rule == TrimRule::Distance ? this->WeighByDistance(first, pixels, run) : this->WeighByLevel(first, pixels, run);
}

void
VarianceFit::WeighByDistance(std::size_t first, std::size_t pixels, Run & run) const
{
  CallWithAvx2([&] {
    const Deviation of{ m_Line, m_Data, m_ReachDn2, m_ReachBelowDn2 };
    RunValues       counts;
    m_Data.variance.Fill(first, pixels, run.value.data());
    for (std::size_t i = 0; i < pixels; ++i)
    {
      const std::size_t p = first + i;
      run.weight[i] = WeightAt(of.line, 0.5 * of.data.dof[p], of.Expected(p));
      counts[i] = of.IsWithinReach(of.Excess(p, run.value[i]));
    }
    TakeWeights(counts, pixels, run.weight);
  });
}

void
VarianceFit::WeighByLevel(std::size_t first, std::size_t pixels, Run & run) const
{
  CallWithAvx2([&] {
    const VarianceLine line = m_Line; // copies that no pointer can alias
    const VarianceData data = m_Data;
    RunValues          variance;
    RunValues          dof;
    RunValues          ratio;
    RunValues          counts;
    data.variance.Fill(first, pixels, variance.data());
    for (std::size_t i = 0; i < pixels; ++i)
    {
      const std::size_t p = first + i;
      const double      own = line.At(data.mean[p]);
      const double      expected = line.At(data.neighbourMean[p]);
      run.weight[i] = WeightAt(line, 0.5 * data.dof[p], expected);
      dof[i] = line.EffectiveDof(data.dof[p], own);
      ratio[i] = variance[i] / own;
    }
    for (std::size_t i = 0; i < pixels; ++i)
    {
      const auto & limits = m_Trim->Of(dof[i]);
      counts[i] = IsBetween(ratio[i], limits.low, limits.high);
      run.value[i] = limits.mean;
    }
    TakeWeights(counts, pixels, run.weight);
    for (std::size_t i = 0; i < pixels; ++i)
    {
      run.value[i] = variance[i] / run.value[i];
    }
  });
}

void
VarianceFit::KeepRun(std::size_t first, std::size_t pixels, Run & run, KeptRun & kept) const
{
  this->WeighRun(first, pixels, run);
  CallWithAvx2([&,
                mean = m_Data.mean + first,
                neighbours = m_Data.neighbourMean + first,
                used = m_Data.mask + first,
                pivot = m_Line.pivotDn] {
    for (std::size_t i = 0; i < pixels; ++i)
    {
      const double weight = run.weight[i];
      const bool   isKept = used[i] != 0 && weight > 0.0;
      const double x = mean[i] - pivot;
      const double z = neighbours[i] - pivot;
      const double value = run.value[i];
      kept.weight[i] = isKept ? weight : 0.0;
      kept.x[i] = isKept ? x : 0.0;
      kept.neighbours[i] = isKept ? z : 0.0;
      kept.value[i] = isKept ? value : 0.0;
    }
  });
  ClearBehind(pixels, kept.weight, kept.x, kept.neighbours, kept.value);
}

void
VarianceFit::SetReach()
{
  const double darkest = m_Line.At(m_DarkestDn);
  const double brightest = m_Line.At(m_BrightestDn);
  const double largest = std::max(darkest, brightest);
  const double dof = std::max(1.0, m_Line.SamplingDof(m_BrightDof, largest));
  const double chance = largest * (ChiSquareUpperQuantile(InPixels.reachTail, dof) / dof - 1.0);
  const double atBlack = std::max(0.0, m_Line.intercept + m_Line.gain * m_BlackDn);
  const double noisy =
    (InMoments.defectiveNoiseFactor * InMoments.defectiveNoiseFactor - 1.0) * std::min({ darkest, brightest, atBlack });
  m_ReachDn2 = std::max(chance, noisy);
  m_ReachBelowDn2 = largest * (1.0 - ChiSquareQuantile(InPixels.reachTail, dof) / dof);
}

void
VarianceFit::EstimateNoiseDispersion(std::size_t first, std::size_t pixels, DispersionTerms & terms) const
{
  CallWithAvx2([&] {
    const Deviation of{ m_Line, m_Data, m_ReachDn2, m_ReachBelowDn2 };
    RunValues       variance;
    RunValues       counts;
    m_Data.variance.Fill(first, pixels, variance.data());
    for (std::size_t i = 0; i < pixels; ++i)
    {
      const std::size_t p = first + i;
      const double      expected = of.Expected(p);
      const double      chance = of.line.SamplingVariance(of.data.dof[p], expected);
      const double      excess = of.Excess(p, variance[i]);
      terms.weight[i] = 1.0 / (chance * chance);
      terms.more[i] = excess * excess - chance;
      terms.chance[i] = chance;
      counts[i] = of.IsWithinReach(excess) * of.data.mask[p];
    }
    TakeWeights(counts, pixels, terms.weight);
    for (std::size_t i = 0; i < pixels; ++i)
    {
      const double weight = terms.weight[i];
      const double more = weight * terms.more[i];
      const double chance = weight * terms.chance[i];
      terms.more[i] = weight > 0.0 ? more : 0.0; // the term is infinite without degrees of freedom
      terms.chance[i] = weight > 0.0 ? chance : 0.0;
    }
  });
  ClearBehind(pixels, terms.weight, terms.more, terms.chance);
}

void
VarianceFit::SetNoiseDispersion()
{
  // Sums of the squared weight, of its product with the squared excess beyond sampling noise, and of its product with
  // the sampling variance.
  enum : std::size_t
  {
    WW,
    WWMore,
    WWChance,
    Sums
  };
  const auto   s = SumBlocks<Sums>(m_Data.pixels, m_ParallelFor, [&](std::size_t begin, std::size_t end, auto & sums) {
    DispersionTerms terms{};
    ForRuns(begin, end, [&](std::size_t first, std::size_t pixels) {
      this->EstimateNoiseDispersion(first, pixels, terms);
      AddTerms(
        [](double weight, double more, double chance) { return std::array<double, Sums>{ weight, more, chance }; },
        sums,
        terms.weight,
        terms.more,
        terms.chance);
    });
  });
  const double spread = s[WWMore] / std::max(1e-300, s[WW]);
  m_Line.noiseDispersionDn4 = spread * s[WW] > InPixels.leastNoiseDispersion * s[WWChance] ? spread : 0.0;
}

} // namespace sensornoise
