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
#ifndef sensornoise_pixels_StaticVariance_h
#define sensornoise_pixels_StaticVariance_h

#include "sensornoise/base/Parallel.h"
#include "sensornoise/base/PixelUse.h"
#include "sensornoise/pixels/ProjectedVariance.h"
#include "sensornoise/pixels/StaticPixels.h"
#include "sensornoise/pixels/VarianceFit.h"
#include "sensornoise/pixels/VarianceLine.h"
#include "sensornoise/refined/RefinedFindings.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <vector>

namespace sensornoise
{

namespace detail
{
/** The line through the smoother half of the pixels, where motion could do least. */
inline VarianceLine
FitFlatHalf(const ProjectedVariance &         projected,
            const std::vector<std::uint8_t> & mask,
            const VarianceLine &              line,
            const ParallelFor &               parallelFor)
{
  std::array<std::size_t, ProjectedVariance::Classes> counts{};
  std::size_t                                         total = 0;
  for (std::size_t p = 0; p < mask.size(); ++p)
  {
    counts[projected.ClassOf(p)] += mask[p];
    total += mask[p];
  }
  std::size_t last = 0;
  for (std::size_t sum = counts[0]; last + 1 < counts.size() && 2 * sum < total; sum += counts[++last])
  {
  }
  std::vector<std::uint8_t> flat = mask;
  for (std::size_t p = 0; p < mask.size(); ++p)
  {
    flat[p] = projected.ClassOf(p) <= last ? mask[p] : 0;
  }
  return FitVarianceLine(projected.GetData(flat), parallelFor, line, 3);
}

/** The mean has noise of its own, and it is correlated with the variance as the noise is skewed. Both together bias
 * the slope's equation by -g sigma^2 / T a unit of weight. Estimator.md, 3.6. */
inline void
CorrectForNoisyMeans(VarianceLine & line, const RefinedFindings & found, std::size_t frames)
{
  const double darkest = found.offsetInUse + found.centreDn;
  const double readVariance = std::max(0.0, line.intercept + line.gain * darkest);
  const double bias = -line.gain * readVariance / static_cast<double>(frames) * line.weightSum / line.spreadDn2;
  line.gain -= bias;
  line.intercept += bias * line.centreDn;
}
} // namespace detail

/** Finds the pixels that fit a static scene and the line of their variance, from the flat classes outwards. Files both
 * in \a found, and the pixels' use in \a pixelUse; returns the mask of the pixels used. Neighbourhoods are judged
 * before classes: a thing that moves across the frame lies in all of them. Throws std::runtime_error if too few are
 * left. */
inline std::vector<std::uint8_t>
FitStaticVariance(ProjectedVariance &               projected,
                  const std::vector<std::uint8_t> & all,
                  RefinedFindings &                 found,
                  std::vector<std::uint8_t> &       pixelUse,
                  const ParallelFor &               parallelFor)
{
  std::vector<std::uint8_t> mask(all.size());
  const auto                require = [](const VarianceLine & line) {
    if (!line.isDetermined)
    {
      throw std::runtime_error("too few pixels, or pixels of one intensity only, are left to fit the variance");
    }
    return line;
  };
  const auto follow = [&](const std::optional<VarianceLine> & start, int iterations) {
    VarianceFit fit(projected.GetData(mask), parallelFor, start);
    fit.Iterate(iterations);
    return require(fit.GetLine());
  };
  // The line of the flat classes tells which neighbourhoods fit, and among these, which classes do.
  projected.Compute(found.model.slopeDn);
  for (std::size_t p = 0; p < mask.size(); ++p)
  {
    mask[p] = all[p] != 0 && projected.ClassOf(p) <= 0.6 * ProjectedVariance::Classes ? 1 : 0;
  }
  VarianceLine line = follow(std::nullopt, 3);
  projected.Compute(line.gain);
  for (int round = 0; round < 2; ++round)
  {
    const std::vector<std::uint8_t> misfit = FindLocalMisfit(projected, line, all, parallelFor);
    for (std::size_t p = 0; p < mask.size(); ++p)
    {
      mask[p] = all[p] != 0 && misfit[p] == 0 ? 1 : 0;
    }
    found.classes = JudgeClasses(projected, line, mask, parallelFor);
    for (std::size_t p = 0; p < mask.size(); ++p)
    {
      if (all[p] != 0)
      {
        const bool isRough = projected.ClassOf(p) >= found.classes.firstBad;
        pixelUse[p] = static_cast<std::uint8_t>(misfit[p] != 0 ? PixelUse::NotStatic
                                                : isRough      ? PixelUse::Vibration
                                                               : PixelUse::Used);
        mask[p] = isRough ? 0 : mask[p];
      }
    }
    line = follow(line, 3);
    const auto count = static_cast<double>(std::count(misfit.begin(), misfit.end(), std::uint8_t{ 1 }));
    if (count < 1e-3 * static_cast<double>(misfit.size()))
    {
      break; // too few to have drawn the line
    }
  }
  projected.Compute(line.gain);
  VarianceFit fit(projected.GetData(mask), parallelFor, line);
  fit.Iterate(8);
  fit.FillErrors();
  line = require(fit.GetLine());
  found.tailDisagreement = fit.TailDisagreement();
  found.fromFlat = detail::FitFlatHalf(projected, mask, line, parallelFor);
  detail::CorrectForNoisyMeans(line, found, projected.GetFrame().frames);
  found.variance = line;
  found.intensityChi2 = IntensityChi2(projected.GetData(mask), line, parallelFor);
  found.notStatic = static_cast<std::size_t>(
    std::count(pixelUse.begin(), pixelUse.end(), static_cast<std::uint8_t>(PixelUse::NotStatic)));
  return mask;
}

} // namespace sensornoise

#endif
