// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_pixels_TestedRun_h
#define sensornoise_pixels_TestedRun_h

#include "base/PixelRuns.h"
#include "pixels/FarVariance.h"
#include "pixels/RejectionModel.h"
#include "pixels/ProjectedVariance.h"
#include "scene/ReferenceFrame.h"

#include <algorithm>
#include <array>
#include <cstddef>

namespace sensornoise
{

/** Test of a run of pixels, inside and outside the mask, against a rejection model, with SIMD instructions. */
struct TestedRun
{
  OfRun expected; ///< variance by the model at the pixel's level [DN^2]
  OfRun ratio;    ///< variance over the expected variance [1]
  OfRun isAbove;  ///< 1 where the ratio is beyond the upper limit of FarLimits, else 0
  OfRun isOff;    ///< 1 where the ratio is beyond either limit of FarLimits, else 0

  /** Tests \a pixels pixels, at most PixelsPerRun, from pixel \a first on. */
  void
  Judge(const ProjectedVariance & projected, const RejectionModel & judge, std::size_t first, std::size_t pixels)
  {
    const ReferenceFrame & frame = projected.GetFrame();
    const double * const   level = judge.LevelsOf(frame).data() + first;
    const double * const   variance = projected.GetVariance().data() + first;
    const float * const    dof = projected.GetDof().data() + first;
    const VarianceLine     line = judge.line;
    judge.FillVariance(level, pixels, expected);
    for (std::size_t i = 0; i < pixels; ++i)
    {
      ratio[i] = variance[i] / expected[i];
      const FarLimits far(line.EffectiveDof(dof[i], expected[i]));
      isAbove[i] = ratio[i] < far.high ? 0.0 : 1.0;
      isOff[i] = ratio[i] > far.low ? isAbove[i] : 1.0;
    }
  }
};

} // namespace sensornoise

#endif
