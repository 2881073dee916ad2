// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "pixels/StaticVariance.h"

#include "base/Simd.h"
#include "base/BoxSum.h"
#include "base/ChiSquare.h"
#include "base/Constants.h"
#include "base/ParallelWork.h"
#include "base/Quantiles.h"
#include "sensornoise/Parallel.h"
#include "pixels/Constants.h"
#include "pixels/ProjectedVariance.h"
#include "scene/ReferenceFrame.h"
#include "series/SceneSeries.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace sensornoise
{

namespace
{
/** Fit of single pixels to the rejection model. */
struct PixelFits
{
  std::vector<float>         ratio; // variance over the model [1]; 0 outside the mask and at outliers
  std::vector<std::uint16_t> count; // 1: in the mask and no outlier; Rejected: outlier; 0: outside the mask

  /** More than the pixels of a neighbourhood, so that one sum counts both the pixels that fit and the outliers. */
  static constexpr std::uint16_t Rejected = 1024;
};

PixelFits
TestPixels(const ProjectedVariance &         projected,
           const RejectionModel &            line,
           const std::vector<std::uint8_t> & mask,
           const ParallelFor &               parallelFor)
{
  PixelFits fits{ MakeMap<float>(mask.size(), parallelFor), MakeMap<std::uint16_t>(mask.size(), parallelFor) };
  ForBlocks(mask.size(), parallelFor, [&](std::size_t begin, std::size_t end) {
    TestedRun run{};
    ForRuns(begin, end, [&](std::size_t first, std::size_t pixels) {
      CallWithAvx2([&, used = mask.data() + first, ratio = fits.ratio.data() + first] {
        run.Test(projected, line, first, pixels);
        for (std::size_t i = 0; i < pixels; ++i)
        {
          const auto own = static_cast<float>(run.ratio[i]);
          ratio[i] = used[i] != 0 && run.isAbove[i] == 0.0 ? own : 0.0F;
        }
      });
      for (std::size_t i = 0; i < pixels; ++i)
      {
        const int count = run.isAbove[i] == 0.0 ? 1 : PixelFits::Rejected;
        fits.count[first + i] = static_cast<std::uint16_t>(mask[first + i] != 0 ? count : 0);
      }
    });
  });
  return fits;
}

/** Returns a map that is 1 at pixels whose neighbourhood of the half width \a radius does not fit. */
std::vector<std::uint8_t>
FindRejectedCores(const ProjectedVariance & projected,
                  const RejectionModel &    line,
                  const PixelFits &         pixels,
                  std::size_t               radius,
                  const ParallelFor &       parallelFor)
{
  const double              side = 2.0 * static_cast<double>(radius) + 1.0;
  const double              area = side * side;
  const ReferenceFrame &    frame = projected.GetFrame();
  const std::size_t         width = frame.geometry.width;
  const std::size_t         height = frame.geometry.height;
  const auto                dof = static_cast<double>(frame.frames - 1 - projected.GetSquares().GetBasis().Size());
  std::vector<std::uint8_t> core(frame.mean.size());
  ForBoxBands(height, parallelFor, [&](std::size_t first, std::size_t last) {
    BoxRows ratios(RowsOf(pixels.ratio, width), width, height, radius, first, last);
    BoxRows counts(RowsOf(pixels.count, width), width, height, radius, first, last);
    for (std::size_t y = first; y < last; ++y)
    {
      const double * const sums = ratios.Next();
      const double * const counted = counts.Next();
      for (std::size_t x = 0; x < width; ++x)
      {
        const auto   both = static_cast<int>(counted[x]);
        const double crowd = both / PixelFits::Rejected;
        const double count = both % PixelFits::Rejected;
        const double excess = sums[x] / std::max(1.0, count) - 1.0;
        bool         isCore = crowd > InCommon.largestOutlierFraction * area;
        if (excess > InPixels.leastNeighbourhoodExcess && count > InPixels.leastCountedFraction * area)
        {
          const double level = frame.neighbourMean[y * width + x];
          const double own = line.EffectiveDof(dof * projected.DofFractionAtPixel(level), line.At(level));
          isCore = isCore || excess > Significance.manyTests * std::sqrt(2.0 * line.varianceInflation / (own * count));
        }
        core[y * width + x] = isCore ? 1 : 0;
      }
    }
  });
  return core;
}
} // namespace

std::vector<std::uint8_t>
RejectNeighbourhoods(const ProjectedVariance &         projected,
                     const RejectionModel &            line,
                     const std::vector<std::uint8_t> & mask,
                     const ParallelFor &               parallelFor)
{
  const std::size_t         radius = InPixels.neighbourhoodRadius;
  const std::size_t         width = projected.GetFrame().geometry.width;
  const std::size_t         height = projected.GetFrame().geometry.height;
  const PixelFits           pixels = TestPixels(projected, line, mask, parallelFor);
  std::vector<std::uint8_t> core = FindRejectedCores(projected, line, pixels, radius, parallelFor);
  if (std::find(core.begin(), core.end(), std::uint8_t{ 1 }) == core.end())
  {
    return core;
  }
  std::vector<std::uint8_t> rejected(mask.size());
  const auto                cores = [&] { return RowsOf(core, width); };
  ForBoxRows(cores, width, height, (2 * radius + 1) / 3, parallelFor, [&](std::size_t y, const double * near) {
    std::transform(near, near + width, rejected.data() + y * width, [](double count) {
      return static_cast<std::uint8_t>(count > 0.5);
    });
  });
  return rejected;
}

std::vector<std::uint8_t>
FindQuietPixels(const ProjectedVariance &         projected,
                const VarianceLine &              line,
                const std::vector<std::uint8_t> & mask,
                const ParallelFor &               parallelFor)
{
  const VarianceData  data = projected.GetData(mask);
  std::vector<double> levels = data.SampleLevels();
  if (levels.empty())
  {
    return {};
  }
  // No pixel has more signal than its level above the darkest one.
  const double darkestDn = QuantileOf(std::move(levels), InCommon.darkestQuantile);
  const auto   isQuiet = [&](std::size_t p) {
    const double level = std::min(data.mean[p], data.neighbourMean[p]); // beside an edge, neighbours may be brighter
    const double shotDn2 = line.gain * (level - darkestDn);
    const double variance = data.variance[p];
    if (data.mask[p] == 0 || !(variance < InPixels.largestQuietVariance * shotDn2))
    {
      return false;
    }
    const double dof = line.EffectiveDof(data.dof[p], line.At(level));
    return dof > 0.0 && NormalQuantile(ChiSquareCdf(dof * variance / shotDn2, dof)) < -Significance.severalTests;
  };
  std::vector<std::uint8_t> quiet(data.pixels);
  ForPixels(data.pixels, parallelFor, [&](std::size_t p) { quiet[p] = isQuiet(p) ? 1 : 0; });
  const auto number = std::count(quiet.begin(), quiet.end(), std::uint8_t{ 1 });
  const auto used = std::count_if(mask.begin(), mask.end(), [](std::uint8_t own) { return own != 0; });
  const bool areFew = static_cast<double>(number) < InPixels.leastQuietFraction * static_cast<double>(used);
  return areFew ? std::vector<std::uint8_t>() : quiet;
}

} // namespace sensornoise
