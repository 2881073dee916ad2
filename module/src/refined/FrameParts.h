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

/** Returns the excess noise of each group of frames in each tile, relative to the line of \a reference at the level.
 * The groups are the even and the odd frames of each quarter of the burst. Estimator.md, 3.15. */
SensorNoise_EXPORT std::vector<TileExcess>
MakeFrameParts(const FrameEnergies & energies, const TileLevels & levels, const PartReference & reference);

} // namespace sensornoise

#endif
