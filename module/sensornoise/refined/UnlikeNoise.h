// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_refined_UnlikeNoise_h
#define sensornoise_refined_UnlikeNoise_h

#include "SensorNoiseExport.h"
#include "sensornoise/base/Eigen.h"
#include "sensornoise/correlation/FrameEnergies.h"
#include "sensornoise/pixels/VarianceLine.h"
#include "sensornoise/refined/FramePhotonTransfer.h"

#include <cstddef>
#include <vector>

namespace sensornoise
{

/** The noise variance of every frame over that which its level makes of that of the others [1]: 1 but for chance.
 * Medians over the tiles, so that what moves in some of them does not count. NaN where the projection leaves next to
 * nothing of a frame; empty where there are too few tiles. \a slopeError is the standard error of the \a line's slope,
 * within which the value that comes nearest to 1 is taken [DN/e-]. */
SensorNoise_EXPORT Eigen::VectorXd
NoiseOfFrames(const FrameEnergies & energies, const TileLevels & levels, const VarianceLine & line, double slopeError);

/** Frames whose noise is not that of the others at their level: of another gain, another processing. */
struct FrameNoise
{
  /** By the size of the difference and its significance among the frames, from 0. */
  std::vector<std::size_t> unlike;
  /** The median difference, if it counts: the frames are of several kinds [1]. */
  double scatter{ 0.0 };
};

/** \a ofFrames is NoiseOfFrames(), \a chance the standard deviation that the number of pixels leaves it, \a least the
 * difference that counts, as InRefined.leastUnlikeNoise [1]. */
SensorNoise_EXPORT FrameNoise
JudgeFrameNoise(const Eigen::VectorXd & ofFrames, double chance, double least);

} // namespace sensornoise

#endif
