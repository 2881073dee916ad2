// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_refined_UnlikeNoise_h
#define sensornoise_refined_UnlikeNoise_h

#include "SensorNoiseExport.h"
#include "base/Eigen.h"
#include "correlation/FrameEnergies.h"
#include "pixels/VarianceLine.h"
#include "refined/FramePhotonTransfer.h"

#include <cstddef>
#include <string>
#include <vector>

namespace sensornoise
{

/** The noise variance of every frame over that which its level makes of that of the others [1]: 1 but for chance.
 * Medians over the tiles, so that what moves in some of them does not count. NaN where the projection leaves next to
 * nothing of a frame; empty where there are too few tiles. \a slopeError is the standard error of the \a line's slope,
 * within which the value that comes nearest to 1 is taken, of slopes that a sensor may have [DN/e-]; it may be
 * infinite. \a known is what was found before; the projection leaves some of the noise of a frame in the others, which
 * is taken off by it. Without it all have 1. */
SensorNoise_EXPORT Eigen::VectorXd
NoiseOfFrames(const FrameEnergies &   energies,
              const TileLevels &      levels,
              const VarianceLine &    line,
              double                  slopeError,
              const Eigen::VectorXd & known = {});

/** Frames that have one noise at their level. */
struct FrameGroup
{
  std::vector<std::size_t> frames;
  double                   noise{ 1.0 }; ///< median of NoiseOfFrames() [1]
};

/** Frames whose noise is not that of the others at their level: of another gain, another processing. */
struct FrameNoise
{
  /** By the size of the difference and its significance among the frames, from 0: all but the largest group. */
  std::vector<std::size_t> unlike;
  /** The largest group, which has at least half of the frames, then the others by their noise; one if none is unlike.
   */
  std::vector<FrameGroup> groups;
  /** Whether the frames have about one level: then no model of their illumination makes the groups. */
  bool areFramesEqual{ false };
  /** The median difference, if it counts: the noise of the frames varies, in no groups [1]. */
  double scatter{ 0.0 };

  /** Whether the frames are of several kinds, or vary. */
  bool
  HasSeveralKinds() const
  {
    return scatter > 0.0 || groups.size() > 1;
  }
  /** The noise of each of so many frames, by its group [1]. */
  Eigen::VectorXd
  OfFrames(Eigen::Index frames) const;
  /** The groups in words: which frames, how much noise, and about which gain where the common one is \a gain [DN/e-].
   */
  std::string
  Text(double gain) const;
};

/** Sorts the frames into groups. The largest is found by the shortest interval that holds half of the frames, and holds
 * all that differ from its median by less than counts, or than chance; so do the others among themselves. Estimator.md,
 * 3.14. \a ofFrames is NoiseOfFrames(), \a chance the standard deviation that the number of pixels leaves it, \a least
 * the difference that counts, as InRefined.leastUnlikeNoise [1]. */
SensorNoise_EXPORT FrameNoise
JudgeFrameNoise(const Eigen::VectorXd & ofFrames, double chance, double least);

} // namespace sensornoise

#endif
