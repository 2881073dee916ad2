// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_refined_FrameParts_h
#define sensornoise_refined_FrameParts_h

#include "SensorNoiseExport.h"
#include "correlation/FrameEnergies.h"
#include "pixels/PartTiles.h"
#include "refined/FramePhotonTransfer.h"

#include <vector>

namespace sensornoise
{

/** The excess of the noise of each group of frames, tile by tile, over what the line of \a reference makes of the
 * levels: the quarters of the burst, and the even and the odd frames of each. Estimator.md, 3.15. */
SensorNoise_EXPORT std::vector<TileExcess>
MakeFrameParts(const FrameEnergies & energies, const TileLevels & levels, const PartReference & reference);

} // namespace sensornoise

#endif
