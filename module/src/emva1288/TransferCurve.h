// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_emva1288_TransferCurve_h
#define sensornoise_emva1288_TransferCurve_h

#include "sensornoise/Emva1288.h"

#include <cstddef>
#include <vector>

namespace sensornoise
{

class DarkLevels;

/** Photon transfer curve: the flat series in the order of their exposures, and saturation. */
struct TransferCurve
{
  std::vector<EmvaSeries> series;               ///< series of each point
  std::vector<EmvaPoint>  points;               ///< points with their gain fit range
  std::size_t             saturation{ 0 };      ///< number of the point with the largest variance
  bool                    hasPhotons{ false };  ///< whether all points have photons
  bool                    isSaturated{ false }; ///< false: no frames reach the end of the range of digital numbers

  double
  SaturationSignalDn() const
  {
    return points[saturation].signalDn;
  }
  /** Returns photons, or the exposure where photons are not known: the abscissa of the response. */
  double
  AbscissaOf(const EmvaPoint & point) const
  {
    return hasPhotons ? *point.photons : point.exposure;
  }
};

/** Makes the curve. Of an exposure with a pair of frames and a longer series, the pair counts. Throws
 * std::invalid_argument if fewer than three exposures differ, if the frames have no temporal noise, or if the flat
 * fields are darker than the dark frames. */
TransferCurve
MakeTransferCurve(const std::vector<EmvaSeries> & series, const DarkLevels & dark, const EmvaSettings & settings);

} // namespace sensornoise

#endif
