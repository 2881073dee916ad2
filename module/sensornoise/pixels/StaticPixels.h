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
#ifndef sensornoise_pixels_StaticPixels_h
#define sensornoise_pixels_StaticPixels_h

#include "sensornoise/base/BoxSum.h"
#include "sensornoise/base/Parallel.h"
#include "sensornoise/base/Quantiles.h"
#include "sensornoise/pixels/ProjectedVariance.h"
#include "sensornoise/pixels/VarianceLine.h"
#include "sensornoise/scene/ReferenceFrame.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace sensornoise
{

/** Which texture classes the model explains. */
struct ClassFit
{
  std::size_t         firstBad{ ProjectedVariance::Classes }; ///< this class and all rougher ones are left out
  std::vector<double> ratio;                                  ///< mean of variance over line
  double              reducedChi2{ 1.0 };                     ///< of the ratios of the classes that are kept
};

namespace detail
{
/** Whether a chi-square variable over its \a freedom is 4.5 standard deviations off or more: its cube root is about
 * normal (Wilson & Hilferty 1931). */
inline bool
IsFarAbove(double ratio, double freedom)
{
  const double s = 2.0 / (9.0 * freedom);
  const double limit = 1.0 - s + 4.5 * std::sqrt(s);
  return !(ratio < limit * limit * limit);
}
inline bool
IsFarOff(double ratio, double freedom)
{
  const double s = 2.0 / (9.0 * freedom);
  const double limit = 1.0 - s - 4.5 * std::sqrt(s);
  return IsFarAbove(ratio, freedom) || !(ratio > limit * limit * limit);
}
} // namespace detail

/** Compares the classes' mean variance with the flat classes'. A class is bad if it deviates upwards by more than 2.5
 * standard errors and 0.15 %, or holds 1 % more outliers; the first class of two bad ones in a row, and all rougher
 * ones, are left out. Estimator.md, 3.5. */
inline ClassFit
JudgeClasses(const ProjectedVariance &         projected,
             const VarianceLine &              line,
             const std::vector<std::uint8_t> & mask,
             const ParallelFor &               parallelFor)
{
  constexpr std::size_t  classes = ProjectedVariance::Classes;
  constexpr std::size_t  flat = classes / 2;
  const ReferenceFrame & frame = projected.GetFrame();
  const auto             sums = SumOverBlocks<4 * classes>(mask.size(), parallelFor, [&](std::size_t p, auto & s) {
    if (mask[p] != 0)
    {
      const double expected = line.At(frame.mean[p]);
      const double ratio = projected.GetVariance()[p] / expected;
      const double near = expected / line.At(frame.neighbourMean[p]);
      double *     own = s.data() + 4 * projected.ClassOf(p);
      own[0] += 1.0;
      const double freedom = line.EffectiveFreedom(projected.GetFreedom()[p], expected);
      if (!detail::IsFarOff(ratio, freedom))
      {
        own[1] += 1.0;
        own[2] += near * near;
        own[3] += near * near * ratio;
      }
    }
  });
  ClassFit               fit;
  std::vector<double>    outliers;
  std::vector<double>    error(classes);
  double                 reference = 0.0;
  double                 count = 0.0;
  for (std::size_t c = 0; c < classes; ++c)
  {
    const double * own = sums.data() + 4 * c;
    fit.ratio.push_back(own[3] / std::max(1e-30, own[2]));
    outliers.push_back(1.0 - own[1] / std::max(1.0, own[0]));
    error[c] = std::sqrt(2.0 / static_cast<double>(frame.frames - 1) / std::max(1.0, own[1]));
    if (c < flat)
    {
      reference += own[1] * fit.ratio[c];
      count += own[1];
    }
  }
  reference /= std::max(1.0, count);
  const double usual = QuantileOf({ outliers.begin(), outliers.begin() + flat }, 0.5);
  const auto   isBad = [&](std::size_t c) {
    return fit.ratio[c] / reference - 1.0 > std::max(2.5 * error[c], 0.0015) || outliers[c] > usual + 0.01;
  };
  for (std::size_t c = 4; c < classes; ++c)
  {
    if (isBad(c) && (c + 1 == classes || isBad(c + 1)))
    {
      fit.firstBad = c;
      break;
    }
  }
  double chi2 = 0.0;
  double used = 0.0;
  for (std::size_t c = 0; c < fit.firstBad; ++c)
  {
    if (sums[4 * c + 1] > 0.0)
    {
      chi2 += std::pow((fit.ratio[c] / reference - 1.0) / error[c], 2);
      used += 1.0;
    }
  }
  fit.reducedChi2 = used > 1.0 ? chi2 / (used - 1.0) : 1.0;
  return fit;
}

/** Marks pixels whose neighbourhood does not fit: about a core of 15 x 15 pixels whose mean variance exceeds the line
 * by 5 standard deviations and 4 %, or that hold 15 % outliers. Single noisy pixels are not its business: they are
 * trimmed. Estimator.md, 3.5. */
inline std::vector<std::uint8_t>
FindLocalMisfit(const ProjectedVariance &         projected,
                const VarianceLine &              line,
                const std::vector<std::uint8_t> & mask,
                const ParallelFor &               parallelFor)
{
  const ReferenceFrame &    frame = projected.GetFrame();
  const std::size_t         width = frame.geometry.width;
  const std::size_t         height = frame.geometry.height;
  std::vector<float>        ratio(mask.size(), 0.0F);
  std::vector<std::uint8_t> fits(mask.size(), 0);
  std::vector<std::uint8_t> rejected(mask.size(), 0);
  ForBlocks(mask.size(), parallelFor, [&](std::size_t begin, std::size_t end) {
    for (std::size_t p = begin; p < end; ++p)
    {
      if (mask[p] != 0)
      {
        const double expected = line.At(frame.mean[p]);
        const double value = projected.GetVariance()[p] / expected;
        const double own = line.EffectiveFreedom(projected.GetFreedom()[p], expected);
        fits[p] = detail::IsFarAbove(value, own) ? 0 : 1;
        rejected[p] = 1 - fits[p];
        ratio[p] = fits[p] != 0 ? static_cast<float>(value) : 0.0F;
      }
    }
  });
  constexpr std::size_t     radius = 7;
  constexpr double          area = (2.0 * radius + 1.0) * (2.0 * radius + 1.0);
  const auto                freedom = static_cast<double>(frame.frames - 1 - projected.GetBasis().Size());
  std::vector<double>       sum = BoxSum(rejected, width, height, radius, parallelFor);
  std::vector<std::uint8_t> core(mask.size());
  std::transform(sum.begin(), sum.end(), core.begin(), [area](double crowd) {
    return static_cast<std::uint8_t>(crowd > 0.15 * area);
  });
  BoxSum(ratio, width, height, radius, parallelFor, sum);
  std::vector<double> count = BoxSum(fits, width, height, radius, parallelFor);
  ForBlocks(mask.size(), parallelFor, [&](std::size_t begin, std::size_t end) {
    for (std::size_t p = begin; p < end; ++p)
    {
      const double excess = sum[p] / std::max(1.0, count[p]) - 1.0;
      const double own = line.EffectiveFreedom(freedom, line.At(frame.neighbourMean[p]));
      const double sd = std::sqrt(2.0 / (own * std::max(1.0, count[p])));
      core[p] = core[p] != 0 || (excess > std::max(5.0 * sd, 0.04) && count[p] > 0.3 * area) ? 1 : 0;
    }
  });
  BoxSum(core, width, height, (2 * radius + 1) / 3, parallelFor, count);
  std::vector<std::uint8_t> misfit(mask.size());
  std::transform(
    count.begin(), count.end(), misfit.begin(), [](double cores) { return static_cast<std::uint8_t>(cores > 0.5); });
  return misfit;
}

/** Reduced chi-square of the mean residuals of 64 bins of the intensity: 1 if the variance is a line but for its
 * sampling noise. */
inline double
IntensityChi2(const VarianceData & data, const VarianceLine & line, const ParallelFor & parallelFor)
{
  constexpr std::size_t bins = 64;
  std::vector<double>   level;
  for (const std::size_t p : SamplePixels({ data.mask, data.mask + data.pixels }))
  {
    level.push_back(data.neighbourMean[p]);
  }
  const std::vector<double> edges = EdgesOfEqualCount(level, bins);
  const auto                sums = SumOverBlocks<2 * bins>(data.pixels, parallelFor, [&](std::size_t p, auto & s) {
    const double expected = data.mask[p] != 0 ? line.At(data.mean[p]) : 1.0;
    const double ratio = data.variance[p] / expected;
    if (data.mask[p] != 0 && !detail::IsFarOff(ratio, data.freedom[p]))
    {
      double * own = s.data() + 2 * BinOf(edges, data.neighbourMean[p]);
      own[0] += 0.5 * data.freedom[p];
      own[1] += 0.5 * data.freedom[p] * (ratio - 1.0);
    }
  });
  double                    chi2 = 0.0;
  double                    used = 0.0;
  for (std::size_t b = 0; b < bins; ++b)
  {
    if (sums[2 * b] > 0.0)
    {
      chi2 += sums[2 * b + 1] * sums[2 * b + 1] / sums[2 * b];
      used += 1.0;
    }
  }
  return used > 2.0 ? chi2 / (used - 2.0) : 1.0;
}

} // namespace sensornoise

#endif
