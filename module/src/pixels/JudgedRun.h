// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_pixels_JudgedRun_h
#define sensornoise_pixels_JudgedRun_h

#include "base/PixelRuns.h"
#include "pixels/FarVariance.h"
#include "pixels/JudgingLine.h"
#include "pixels/ProjectedVariance.h"
#include "scene/ReferenceFrame.h"

#include <algorithm>
#include <array>
#include <cstddef>

namespace sensornoise
{

/** What a judging line says of pixels that lie one after the other, of the mask or not: in vectors. */
struct JudgedRun
{
  OfRun expected; ///< by the line, at the pixel's level [DN^2]
  OfRun ratio;    ///< of the variance to it [1]
  OfRun isAbove;  ///< 1 where the ratio is far above 1, else 0
  OfRun isOff;    ///< the same on either side

  void
  Judge(const ProjectedVariance & projected, const JudgingLine & judge, std::size_t first, std::size_t pixels)
  {
    const ReferenceFrame & frame = projected.GetFrame();
    const double * const   level = judge.LevelsOf(frame).data() + first;
    const double * const   variance = projected.GetVariance().data() + first;
    const float * const    freedom = projected.GetFreedom().data() + first;
    const VarianceLine     line = judge.line;
    judge.FillVariance(level, pixels, expected);
    for (std::size_t i = 0; i < pixels; ++i)
    {
      ratio[i] = variance[i] / expected[i];
      const FarLimits far(line.EffectiveFreedom(freedom[i], expected[i]));
      isAbove[i] = ratio[i] < far.high ? 0.0 : 1.0;
      isOff[i] = ratio[i] > far.low ? isAbove[i] : 1.0;
    }
  }
};

} // namespace sensornoise

#endif
