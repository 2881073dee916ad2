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

/** \class TileLevels
 * \brief Level of every tile in every frame. */
class SensorNoise_EXPORT TileLevels
{
public:
  /** \a gamma + 1 is the illumination factor of each frame of the stack about the dark offset \a offsetDn [DN]; the
   * sample contains the first of these frames. \a zeroDn is the level from which FrameEnergies measures the signal
   * [DN]. */
  TileLevels(const std::vector<double> & gamma, double offsetDn, double zeroDn);

  /** Returns the levels in every frame of a tile whose signal in the mean frame is \a lightDn [DN]. */
  Eigen::VectorXd
  Of(double lightDn) const;

  /** Returns the dark offset about which the illumination factors are given [DN]. */
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

/** Returns the variance by \a line at the level of a \a tile in every frame [DN^2]. It is at least
 * InRefined.leastWeighedVariance of the tile's mean square. */
SensorNoise_EXPORT Eigen::VectorXd
VariancesOfFrames(const FrameEnergies & energies,
                  const TileLevels &    levels,
                  const VarianceLine &  line,
                  Eigen::Index          tile);

/** Fits the photon transfer line of the frames: the noise variance over the level, from the differences between bright
 * and dark frames at each place. A flat field determines it as well as a scene with contrast, and differences between
 * pixels do not influence it. Estimator.md, 3.14.
 *
 * Each tile gives a slope, and the scatter of the slopes between tiles is the error. Slope and value at the pivot are
 * uncorrelated. \a start gives the initial weights. Returns the line, and the deviations of the frames from it in one
 * bin for each frame.
 *
 * The line is not determined if there are too few tiles or frames, or if all frames have one level. It is not
 * determined either if the frames have two levels, and one of them only in a fifth of the frames or fewer. */
SensorNoise_EXPORT VarianceCurve
FitFramePhotonTransfer(const FrameEnergies & energies, const TileLevels & levels, const VarianceLine & start);

} // namespace sensornoise

#endif
