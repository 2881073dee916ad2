// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "pixels/StaticVariance.h"

#include "base/Simd.h"
#include "base/Constants.h"
#include "base/ParallelWork.h"
#include "base/Quantiles.h"
#include "sensornoise/Parallel.h"
#include "pixels/Constants.h"
#include "pixels/ProjectedVariance.h"
#include "scene/ReferenceFrame.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
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
  Above,         // outliers above the model: motion adds variance, and takes none
  Kept,          // pixels that are no outliers
  Weight,        // weights of kept pixels
  WeightedRatio, // variance over the model, times the weight
  SquaredErrors, // sampling variance and dispersion of the weighted ratios
  WeightedLevel, // level over the model, times the weight: the change of the ratio with the gain of the model
  WeightedOne,   // one over the model, times the weight: the change of the ratio with its intercept
  // Sums for the slope of a line through the kept pixels. A term is the weight w, the inverse sampling variance, times
  // a product of x and z. x is the mean of the pixel above the pivot of the model, and z is the mean of the neighbours.
  SlopeW,
  SlopeWX,
  SlopeWZ,
  SlopeWZX,
  SlopeWZZ,
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
    RunValues weight{};
    RunValues error{};
    RunValues precision{};
    CallWithAvx2([&,
                  neighbours = frame.neighbourMean.data() + first,
                  divisor = projected.GetSquares().GetDivisor().data() + first,
                  dof = projected.GetDof().data() + first,
                  spread = line.line.noiseDispersionDn4] {
      run.Test(projected, line, first, pixels);
      RunValues level;
      std::copy_n(neighbours, pixels, level.data());
      line.FillVariance(level.data(), pixels, weight);
      for (std::size_t i = 0; i < pixels; ++i)
      {
        const double halfDof = 0.5 * static_cast<double>(dof[i]);
        precision[i] = halfDof / (weight[i] * weight[i] + halfDof * spread);
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
        own[Above] += run.isAbove[i];
        if (run.isOff[i] == 0.0)
        {
          own[Kept] += 1.0;
          own[Weight] += weight[i];
          own[WeightedRatio] += weight[i] * run.ratio[i];
          own[SquaredErrors] += error[i];
          own[WeightedLevel] += weight[i] * line.LevelOf(frame, first + i) / run.expected[i];
          own[WeightedOne] += weight[i] / run.expected[i];
          const double x = frame.mean[first + i] - line.line.pivotDn;
          const double z = frame.neighbourMean[first + i] - line.line.pivotDn;
          own[SlopeW] += precision[i];
          own[SlopeWX] += precision[i] * x;
          own[SlopeWZ] += precision[i] * z;
          own[SlopeWZX] += precision[i] * z * x;
          own[SlopeWZZ] += precision[i] * z * z;
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
  std::array<double, Classes> kept{};       // number of pixels without outliers
  std::array<double, Classes> outliers{};   // fraction of outliers above the model [1]
  std::array<double, Classes> excess{};     // mean of variance over model, relative to the flat classes, minus 1 [1]
  std::array<double, Classes> chance{};     // standard error of the excess by sampling [1]
  std::array<double, Classes> error{};      // standard error of the excess, by the error of the model, too [1]
  double                      usual{ 0.0 }; // usual fraction of outliers [1]
};

/** Computes the table and \a ratio, the mean of variance over model of each class. The errors include the \a covariance
 * of gain and intercept of the model: flat classes that are all dark do not determine the variance of bright classes.
 */
ClassTable
MakeTable(const SumsOfClasses & sums, const Eigen::Matrix2d & covariance, std::vector<double> & ratio)
{
  ClassTable                           table;
  std::array<Eigen::Vector2d, Classes> change;
  Eigen::Vector2d                      ofReference = Eigen::Vector2d::Zero();
  double                               reference = 0.0;
  double                               count = 0.0;
  for (std::size_t c = 0; c < Classes; ++c)
  {
    const double * own = sums.data() + ClassSums * c;
    ratio.push_back(own[WeightedRatio] / std::max(smallestDivisor, own[Weight]));
    table.kept[c] = own[Kept];
    table.outliers[c] = own[Above] / std::max(1.0, own[Pixels]);
    table.chance[c] = std::sqrt(own[SquaredErrors]) / std::max(1.0, own[Kept]);
    change[c] = Eigen::Vector2d(own[WeightedLevel], own[WeightedOne]) / std::max(smallestDivisor, own[Weight]);
    if (c < FlatClasses)
    {
      reference += own[Kept] * ratio[c];
      ofReference += own[Kept] * change[c];
      count += own[Kept];
    }
  }
  reference /= std::max(1.0, count);
  ofReference /= std::max(1.0, count);
  for (std::size_t c = 0; c < Classes; ++c)
  {
    const Eigen::Vector2d difference = change[c] - ofReference;
    table.error[c] = std::sqrt(table.chance[c] * table.chance[c] + difference.dot(covariance * difference));
  }
  table.usual = QuantileOf({ table.outliers.begin(), table.outliers.begin() + FlatClasses }, 0.5);
  std::transform(
    ratio.begin(), ratio.end(), table.excess.begin(), [reference](double own) { return own / reference - 1.0; });
  return table;
}

std::size_t
FirstBadClass(const ClassTable & table)
{
  const auto isBad = [&](std::size_t c) {
    return table.excess[c] > std::max(Significance.oneTest * table.error[c], InPixels.leastClassExcess) ||
           table.outliers[c] > table.usual + InPixels.leastClassOutliers;
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

/** Returns whether the roughest class is below the model. */
bool
IsRoughestBelow(const ClassTable & table)
{
  std::size_t roughest = Classes - 1;
  while (roughest > InPixels.firstTestedClass && !(table.kept[roughest] > 0.0))
  {
    --roughest;
  }
  return table.excess[roughest] < -std::max(Significance.oneTest * table.error[roughest], InPixels.leastDeviation);
}

/** Returns the variance of the slope of a line through the classes 0 ... \a end - 1, by instrumental variables as the
 * rejection model [DN^2/e-^2]; infinite if they do not determine it. */
double
SlopeVariance(const SumsOfClasses & sums, std::size_t end)
{
  std::array<double, ClassSums> all{};
  for (std::size_t c = 0; c < end; ++c)
  {
    for (std::size_t k = 0; k < ClassSums; ++k)
    {
      all[k] += sums[ClassSums * c + k];
    }
  }
  const double neighbours = all[SlopeWZZ] - all[SlopeWZ] * all[SlopeWZ] / all[SlopeW];
  const double common = all[SlopeWZX] - all[SlopeWZ] * all[SlopeWX] / all[SlopeW];
  return common > 0.0 ? neighbours / (common * common) : std::numeric_limits<double>::infinity();
}

/** Sets the first class to be rejected, given that \a firstBad and rougher classes fail. Rejecting classes avoids their
 * excess, but costs precision: where all bright areas are rough, nothing is left to determine the gain. The limit is
 * where the sum of the squared relative errors is the smallest. */
void
LimitRejection(const SumsOfClasses & sums, const ClassTable & table, const RejectionModel & line, ClassFit & fit)
{
  const double scale = line.varianceInflation / (line.line.gain * line.line.gain);
  double       deviation = 0.0;
  double       least = std::numeric_limits<double>::infinity();
  for (std::size_t end = fit.firstBad; end <= Classes; ++end)
  {
    const double error = deviation * deviation + scale * SlopeVariance(sums, end);
    if (error < least)
    {
      least = error;
      fit.firstBad = end;
      fit.keptDeviation = deviation;
    }
    if (end < Classes && table.kept[end] > 0.0)
    {
      deviation = std::max({ deviation, table.excess[end], table.outliers[end] - table.usual });
    }
  }
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
  const ClassTable table = MakeTable(sums, line.line.covariance, fit.ratio);
  fit.isBelowModel = IsRoughestBelow(table);
  fit.firstBad = FirstBadClass(table);
  if (fit.firstBad < Classes && line.line.gain > 0.0)
  {
    LimitRejection(sums, table, line, fit);
  }
  double chi2 = 0.0;
  double used = 0.0;
  for (std::size_t c = 0; c < fit.firstBad; ++c)
  {
    if (table.kept[c] > 0.0)
    {
      chi2 += std::pow(table.excess[c] / table.chance[c], 2);
      used += 1.0;
    }
  }
  fit.reducedChi2 = used > 1.0 ? chi2 / (used - 1.0) : 1.0;
  return fit;
}

} // namespace sensornoise
