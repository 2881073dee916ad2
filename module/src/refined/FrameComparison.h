// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_refined_FrameComparison_h
#define sensornoise_refined_FrameComparison_h

#include "correlation/NoiseResiduals.h"
#include "pixels/ProjectedVariance.h"
#include "pixels/StaticVariance.h"
#include "refined/FramePhotonTransfer.h"
#include "scene/StaticScene.h"
#include "sensornoise/Parallel.h"

namespace sensornoise
{

/** Data by which the noise of the frames of the sample is compared. */
struct FrameComparison
{
  const NoiseResiduals &   residuals;
  const ProjectedSquares & squares;
  const StaticScene &      scene;
  TileLevels               levels;
  bool                     isIlluminationLocal{ false }; ///< the illumination changes differently between tiles

  /** Returns whether the noise variance differs between frames by as much as counts. */
  bool
  AreUnequal() const
  {
    return scene.changesStrongly || squares.HasUnequalNoise();
  }
};

/** Returns the photon transfer of the frames. It is not determined if the frames are about equal, or if the
 * illumination changes differently between tiles. */
VarianceCurve
LineOfFrames(const StaticVariance & variance, const FrameComparison & by, const ParallelFor & parallelFor);

/** Returns the line of frames or pixels with the more precise slope. */
const VarianceLine &
BetterLine(const StaticVariance & variance);

/** Returns whether the scene moves so little that no motion remains in the residuals. */
bool
MovesLittle(const FrameComparison & by);

/** Finds the frames whose noise differs from the noise of the others. If frames of two gains have two levels, the line
 * of the frames fits them all; the line of the pixels then contradicts it. */
FrameNoise
CompareFrames(const StaticVariance &  variance,
              const FrameComparison & by,
              double                  varianceInflation,
              const ParallelFor &     parallelFor);

} // namespace sensornoise

#endif
