// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/pixels/StaticPixels.h"

#include "sensornoise/base/BoxSum.h"
#include "sensornoise/base/FirstTouch.h"
#include "sensornoise/base/Parallel.h"
#include "sensornoise/base/Quantiles.h"
#include "sensornoise/pixels/Constants.h"
#include "sensornoise/pixels/FarVariance.h"
#include "sensornoise/pixels/ProjectedVariance.h"
#include "sensornoise/pixels/JudgingLine.h"
#include "sensornoise/scene/ReferenceFrame.h"
#include "sensornoise/series/TemporalBasis.h"

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

/** The sums over the pixels of a class. */
enum ClassSum : std::size_t
{
  Pixels,
  Kept,          // pixels that are no outliers
  Weight,        // of those that are kept
  WeightedRatio, // of the variance to the line's
  SquaredErrors, // of the weighted ratios, by sampling and by the pixels' own noise
  ClassSums
};
using SumsOfClasses = std::array<double, ClassSums * Classes>;

SumsOfClasses
SumClasses(const ProjectedVariance &         projected,
           const JudgingLine &               line,
           const std::vector<std::uint8_t> & mask,
           const ParallelFor &               parallelFor)
{
  const ReferenceFrame & frame = projected.GetFrame();
  return SumOverBlocks<ClassSums * Classes>(mask.size(), parallelFor, [&](std::size_t p, auto & s) {
    if (mask[p] != 0)
    {
      const double expected = line.At(line.LevelOf(frame, p));
      const double ratio = projected.GetVariance()[p] / expected;
      const double near = expected / line.At(frame.neighbourMean[p]);
      double *     own = s.data() + ClassSums * projected.ClassOf(p);
      own[Pixels] += 1.0;
      const double freedom = line.EffectiveFreedom(projected.GetFreedom()[p], expected);
      if (!IsFarOff(ratio, freedom))
      {
        own[Kept] += 1.0;
        own[Weight] += near * near;
        own[WeightedRatio] += near * near * ratio;
        own[SquaredErrors] += 2.0 * line.sharedSquares / static_cast<double>(frame.frames - 1) +
                              line.line.noiseSpreadDn4 / (expected * expected);
      }
    }
  });
}

/** What the classes are judged by. */
struct ClassTable
{
  std::array<double, Classes> kept{};     // pixels
  std::array<double, Classes> outliers{}; // their share
  std::array<double, Classes> excess{};   // mean of variance over line, relative to the flat classes', minus 1
  std::array<double, Classes> error{};    // its standard error
};

/** Fills in \a ratio, too. */
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
    return table.excess[c] > std::max(InPixels.classZ * table.error[c], InPixels.leastClassExcess) ||
           table.outliers[c] > usual + InPixels.leastClassOutliers;
  };
  for (std::size_t c = InPixels.firstJudgedClass; c < Classes; ++c)
  {
    if (isBad(c) && (c + 1 == Classes || isBad(c + 1)))
    {
      return c;
    }
  }
  return Classes;
}

/** How single pixels fit the line. */
struct PixelFits
{
  std::vector<float>        ratio;    // of the variance to the line's; 0 unless it fits
  std::vector<std::uint8_t> fits;     // 1: of the mask, and not far above the line
  std::vector<std::uint8_t> rejected; // 1: far above it
};

PixelFits
JudgePixels(const ProjectedVariance &         projected,
            const JudgingLine &               line,
            const std::vector<std::uint8_t> & mask,
            const ParallelFor &               parallelFor)
{
  const ReferenceFrame & frame = projected.GetFrame();
  PixelFits              pixels{ MakeMap<float>(mask.size(), parallelFor),
                    std::vector<std::uint8_t>(mask.size(), 0),
                    std::vector<std::uint8_t>(mask.size(), 0) };
  ForBlocks(mask.size(), parallelFor, [&](std::size_t begin, std::size_t end) {
    for (std::size_t p = begin; p < end; ++p)
    {
      if (mask[p] != 0)
      {
        const double expected = line.At(line.LevelOf(frame, p));
        const double value = projected.GetVariance()[p] / expected;
        const double own = line.EffectiveFreedom(projected.GetFreedom()[p], expected);
        pixels.fits[p] = IsFarAbove(value, own) ? 0 : 1;
        pixels.rejected[p] = 1 - pixels.fits[p];
        pixels.ratio[p] = pixels.fits[p] != 0 ? static_cast<float>(value) : 0.0F;
      }
    }
  });
  return pixels;
}
} // namespace

ClassFit
JudgeClasses(const ProjectedVariance &         projected,
             const JudgingLine &               line,
             const std::vector<std::uint8_t> & mask,
             const ParallelFor &               parallelFor)
{
  ClassFit         fit;
  const ClassTable table = MakeTable(SumClasses(projected, line, mask, parallelFor), fit.ratio);
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

std::vector<std::uint8_t>
FindLocalMisfit(const ProjectedVariance &         projected,
                const JudgingLine &               line,
                const std::vector<std::uint8_t> & mask,
                const ParallelFor &               parallelFor)
{
  const std::size_t         radius = InPixels.misfitRadius;
  const double              side = 2.0 * static_cast<double>(radius) + 1.0;
  const double              area = side * side;
  const ReferenceFrame &    frame = projected.GetFrame();
  const std::size_t         width = frame.geometry.width;
  const std::size_t         height = frame.geometry.height;
  const PixelFits           pixels = JudgePixels(projected, line, mask, parallelFor);
  const auto                freedom = static_cast<double>(frame.frames - 1 - projected.GetBasis().Size());
  std::vector<std::uint8_t> core(mask.size());
  ForBoxBands(height, parallelFor, [&](std::size_t first, std::size_t last) {
    BoxRows rejects(RowsOf(pixels.rejected, width), width, height, radius, first, last);
    BoxRows ratios(RowsOf(pixels.ratio, width), width, height, radius, first, last);
    BoxRows counts(RowsOf(pixels.fits, width), width, height, radius, first, last);
    for (std::size_t y = first; y < last; ++y)
    {
      const double * const crowd = rejects.Next();
      const double * const sum = ratios.Next();
      const double * const count = counts.Next();
      for (std::size_t x = 0; x < width; ++x)
      {
        const std::size_t p = y * width + x;
        const double      excess = sum[x] / std::max(1.0, count[x]) - 1.0;
        const double      own = line.EffectiveFreedom(freedom, line.At(frame.neighbourMean[p]));
        const double      sd = std::sqrt(2.0 * line.sharedSquares / (own * std::max(1.0, count[x])));
        const bool        isFar = excess > std::max(InPixels.misfitZ * sd, InPixels.leastMisfit) &&
                           count[x] > InPixels.leastCountedShare * area;
        core[p] = isFar || crowd[x] > InPixels.largestFarShare * area ? 1 : 0;
      }
    }
  });
  std::vector<std::uint8_t> misfit(mask.size());
  const auto                cores = [&] { return RowsOf(core, width); };
  ForBoxRows(cores, width, height, (2 * radius + 1) / 3, parallelFor, [&](std::size_t y, const double * near) {
    std::transform(near, near + width, misfit.data() + y * width, [](double count) {
      return static_cast<std::uint8_t>(count > 0.5);
    });
  });
  return misfit;
}

} // namespace sensornoise
