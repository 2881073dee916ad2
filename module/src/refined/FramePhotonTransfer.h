// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_refined_FramePhotonTransfer_h
#define sensornoise_refined_FramePhotonTransfer_h

#include "SensorNoiseExport.h"
#include "base/Eigen.h"
#include "correlation/FrameEnergies.h"
#include "pixels/VarianceCurve.h"
#include "pixels/VarianceLine.h"

#include <vector>

namespace sensornoise
{

/** The level of every tile in every frame. */
class SensorNoise_EXPORT TileLevels
{
public:
  /** Takes all frames; the sample has the first of them. \a gamma + 1 is the illumination factor of each frame about
   * the dark offset \a offsetDn, and \a zeroDn the level from which FrameEnergies measures light [DN]. */
  TileLevels(const std::vector<double> & gamma, double offsetDn, double zeroDn);

  /** In every frame, of a tile of the light \a lightDn in the mean frame [DN]. */
  Eigen::VectorXd
  Of(double lightDn) const;

  double
  OffsetDn() const
  {
    return m_OffsetDn;
  }

private:
  Eigen::VectorXd m_Illumination;
  double          m_OffsetDn;
  double          m_ZeroDn;
};

/** The variance that \a line makes of the level of a \a tile in every frame; where the line is near 0 or below, a small
 * part of the tile's mean square [DN^2]. */
SensorNoise_EXPORT Eigen::VectorXd
VariancesOfFrames(const FrameEnergies & energies,
                  const TileLevels &    levels,
                  const VarianceLine &  line,
                  Eigen::Index          tile);

/** The photon transfer of the frames: the line of the noise variance over the level, by what a place has of both in
 * bright and in dark frames. A flat field determines it as well as a scene with contrast, and differences between
 * pixels do not count. Estimator.md, 3.14.
 *
 * Slopes are of every tile by itself, and their scatter from tile to tile is the error. Slope and value at the pivot
 * are uncorrelated. \a start weighs the squares at first. Returns the line, and the deviations of the frames from it in
 * one bin for each frame. The line is not determined if there are too few tiles or frames, frames of one level, or two
 * levels of which one is that of a fifth of the frames or fewer. */
SensorNoise_EXPORT VarianceCurve
FitFramePhotonTransfer(const FrameEnergies & energies, const TileLevels & levels, const VarianceLine & start);

} // namespace sensornoise

#endif
