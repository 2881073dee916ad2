// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_pixels_JudgedRun_h
#define sensornoise_pixels_JudgedRun_h

#include "sensornoise/base/Parallel.h"
#include "sensornoise/pixels/FarVariance.h"
#include "sensornoise/pixels/JudgingLine.h"
#include "sensornoise/pixels/ProjectedVariance.h"
#include "sensornoise/scene/ReferenceFrame.h"

#include <algorithm>
#include <array>
#include <cstddef>

namespace sensornoise
{

/** What a judging line says of pixels that lie one after the other, of the mask or not: in vectors. */
struct JudgedRun
{
  static constexpr std::size_t MostPixels = 512;
  using OfRun = std::array<double, MostPixels>;

  OfRun expected; ///< by the line, at the pixel's level [DN^2]
  OfRun ratio;    ///< of the variance to it [1]
  OfRun isAbove;  ///< 1 where the ratio is far above 1, else 0
  OfRun isOff;    ///< the same on either side

  /** What \a judge expects at so many levels. */
  static void
  Expect(const JudgingLine & judge, const double * level, std::size_t pixels, OfRun & variance)
  {
    const VarianceLine line = judge.line; // which no pointer can point into
    for (std::size_t i = 0; i < pixels; ++i)
    {
      variance[i] = line.At(level[i]);
    }
    if (judge.levels.empty())
    {
      return;
    }
    // The ratios, as a sum of what they rise by from each level to the next.
    OfRun ratio;
    std::fill_n(ratio.begin(), pixels, judge.ratios[0]);
    for (std::size_t k = 0; k + 1 < judge.levels.size(); ++k)
    {
      const double low = judge.levels[k];
      const double high = judge.levels[k + 1];
      const double slope = (judge.ratios[k + 1] - judge.ratios[k]) / (high - low);
      for (std::size_t i = 0; i < pixels; ++i)
      {
        ratio[i] += slope * (std::max(low, std::min(high, level[i])) - low);
      }
    }
    for (std::size_t i = 0; i < pixels; ++i)
    {
      variance[i] *= ratio[i];
    }
  }

  void
  Judge(const ProjectedVariance & projected, const JudgingLine & judge, std::size_t first, std::size_t pixels)
  {
    const ReferenceFrame & frame = projected.GetFrame();
    const double * const   level = (judge.byNeighbours ? frame.neighbourMean : frame.mean).data() + first;
    const double * const   variance = projected.GetVariance().data() + first;
    const float * const    freedom = projected.GetFreedom().data() + first;
    const VarianceLine     line = judge.line;
    Expect(judge, level, pixels, expected);
    for (std::size_t i = 0; i < pixels; ++i)
    {
      ratio[i] = variance[i] / expected[i];
      const FarLimits far(line.EffectiveFreedom(freedom[i], expected[i]));
      isAbove[i] = ratio[i] < far.high ? 0.0 : 1.0;
      isOff[i] = ratio[i] > far.low ? isAbove[i] : 1.0;
    }
  }
};

/** Calls function(first, pixels) for the runs of the pixels [begin, end). */
template <typename TFunction>
void
ForJudgedRuns(std::size_t begin, std::size_t end, TFunction function)
{
  for (std::size_t first = begin; first < end; first += JudgedRun::MostPixels)
  {
    function(first, std::min(JudgedRun::MostPixels, end - first));
  }
}

} // namespace sensornoise

#endif
