// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "pixels/StaticPixels.h"

#include "sensornoise/Parallel.h"
#include "base/Quantiles.h"
#include "base/Significance.h"
#include "base/Avx2.h"
#include "pixels/Constants.h"
#include "pixels/TestedRun.h"
#include "pixels/RejectionModel.h"
#include "pixels/ProjectedVariance.h"
#include "scene/ReferenceFrame.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace sensornoise
{

namespace
{
constexpr std::size_t Classes = ProjectedVariance::Classes;
constexpr std::size_t FlatClasses = Classes / 2;

/** Sums over the pixels of a class. */
enum ClassSum : std::size_t
{
  Pixels,
  Kept,          // pixels that are no outliers
  Weight,        // weights of kept pixels
  WeightedRatio, // variance over the model, times the weight
  SquaredErrors, // sampling variance and dispersion of the weighted ratios
  ClassSums
};
using SumsOfClasses = std::array<double, ClassSums * Classes>;

SumsOfClasses
SumClasses(const ProjectedVariance &         projected,
           const RejectionModel &            line,
           const std::vector<std::uint8_t> & mask,
           const ParallelFor &               parallelFor)
{
  const ReferenceFrame & frame = projected.GetFrame();
  const double           sampling = 2.0 * line.varianceInflation / static_cast<double>(frame.frames - 1);
  const auto             sumRun = [&](std::size_t first, std::size_t pixels, TestedRun & run, double * sums) {
    OfRun weight{};
    OfRun error{};
    CallWithAvx2([&,
                  level = frame.neighbourMean.data() + first,
                  divisor = projected.GetDivisor().data() + first,
                  dof = projected.GetDof().data() + first,
                  spread = line.line.noiseDispersionDn4] {
      run.Judge(projected, line, first, pixels);
      line.FillVariance(level, pixels, weight);
      for (std::size_t i = 0; i < pixels; ++i)
      {
        const double near = run.expected[i] / weight[i];
        weight[i] = near * near;
        const double ofFrames = static_cast<double>(divisor[i]) / static_cast<double>(dof[i]);
        error[i] = sampling * ofFrames + spread / (run.expected[i] * run.expected[i]);
      }
    });
    for (std::size_t i = 0; i < pixels; ++i)
    {
      if (mask[first + i] != 0)
      {
        double * own = sums + ClassSums * projected.ClassOf(first + i);
        own[Pixels] += 1.0;
        if (run.isOff[i] == 0.0)
        {
          own[Kept] += 1.0;
          own[Weight] += weight[i];
          own[WeightedRatio] += weight[i] * run.ratio[i];
          own[SquaredErrors] += error[i];
        }
      }
    }
  };
  return SumBlocks<ClassSums * Classes>(
    mask.size(), parallelFor, [&](std::size_t begin, std::size_t end, SumsOfClasses & sums) {
      TestedRun run{};
      ForRuns(begin, end, [&](std::size_t first, std::size_t pixels) { sumRun(first, pixels, run, sums.data()); });
    });
}

/** Quantities by which the classes are tested. */
struct ClassTable
{
  std::array<double, Classes> kept{};     // number of pixels without outliers
  std::array<double, Classes> outliers{}; // fraction of outliers [1]
  std::array<double, Classes> excess{};   // mean of variance over model, relative to the flat classes, minus 1 [1]
  std::array<double, Classes> error{};    // standard error of the excess [1]
};

/** Computes the table and \a ratio, the mean of variance over model of each class. */
ClassTable
MakeTable(const SumsOfClasses & sums, std::vector<double> & ratio)
{
  ClassTable table;
  double     reference = 0.0;
  double     count = 0.0;
  for (std::size_t c = 0; c < Classes; ++c)
  {
    const double * own = sums.data() + ClassSums * c;
    ratio.push_back(own[WeightedRatio] / std::max(1e-30, own[Weight]));
    table.kept[c] = own[Kept];
    table.outliers[c] = 1.0 - own[Kept] / std::max(1.0, own[Pixels]);
    table.error[c] = std::sqrt(own[SquaredErrors]) / std::max(1.0, own[Kept]);
    if (c < FlatClasses)
    {
      reference += own[Kept] * ratio[c];
      count += own[Kept];
    }
  }
  reference /= std::max(1.0, count);
  std::transform(
    ratio.begin(), ratio.end(), table.excess.begin(), [reference](double own) { return own / reference - 1.0; });
  return table;
}

std::size_t
FirstBadClass(const ClassTable & table)
{
  const double usual = QuantileOf({ table.outliers.begin(), table.outliers.begin() + FlatClasses }, 0.5);
  const auto   isBad = [&](std::size_t c) {
    return table.excess[c] > std::max(Significance.oneTest * table.error[c], InPixels.leastClassExcess) ||
           table.outliers[c] > usual + InPixels.leastClassOutliers;
  };
  for (std::size_t c = InPixels.firstTestedClass; c < Classes; ++c)
  {
    if (isBad(c) && (c + 1 == Classes || isBad(c + 1)))
    {
      return c;
    }
  }
  return Classes;
}

} // namespace

ClassFit
TestClasses(const ProjectedVariance &         projected,
            const RejectionModel &            line,
            const std::vector<std::uint8_t> & mask,
            const ParallelFor &               parallelFor)
{
  ClassFit            fit;
  const SumsOfClasses sums = SumClasses(projected, line, mask, parallelFor);
  for (std::size_t c = 0; c < Classes; ++c)
  {
    fit.pixels.push_back(sums[ClassSums * c + Pixels]);
  }
  const ClassTable table = MakeTable(sums, fit.ratio);
  fit.firstBad = FirstBadClass(table);
  double chi2 = 0.0;
  double used = 0.0;
  for (std::size_t c = 0; c < fit.firstBad; ++c)
  {
    if (table.kept[c] > 0.0)
    {
      chi2 += std::pow(table.excess[c] / table.error[c], 2);
      used += 1.0;
    }
  }
  fit.reducedChi2 = used > 1.0 ? chi2 / (used - 1.0) : 1.0;
  return fit;
}

} // namespace sensornoise
