// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_pixels_GainByParts_h
#define sensornoise_pixels_GainByParts_h

#include "SensorNoiseExport.h"
#include "pixels/PartGains.h"
#include "pixels/PartTiles.h"

#include <optional>
#include <vector>

namespace sensornoise
{

/** Compares the parts of every partition by place and by phase, and chooses between partitions by the Schwarz
 * criterion. */
SensorNoise_EXPORT GainByParts
CompareParts(const PartTiles & tiles);

/** Returns the partitions by place that may have unlike variances without signal, where CompareParts() finds no places.
 * The covariance of each has its differences as an error: their square beyond chance, times the probability of the
 * partition. Estimator.md, 3.15. */
SensorNoise_EXPORT std::vector<PartGains>
FindPossibleParts(const std::vector<TileExcess> & tiles);

/** Compares groups of frames in the same way; \a tiles has an entry for each group at each place. Null if the gains do
 * not differ. */
SensorNoise_EXPORT std::optional<PartGains>
CompareFrameParts(const std::vector<TileExcess> & tiles);

} // namespace sensornoise

#endif
