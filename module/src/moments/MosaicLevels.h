// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_moments_MosaicLevels_h
#define sensornoise_moments_MosaicLevels_h

#include "SensorNoiseExport.h"
#include "sensornoise/FrameGeometry.h"
#include "sensornoise/Parallel.h"

#include <cstddef>
#include <optional>
#include <vector>

namespace sensornoise
{

/** The pattern of a frame, one exposure or the mean of many [DN], if its levels alternate as those behind a Bayer
 * mosaic do: on one diagonal of the 2 x 2 pixels alike, everywhere, and of three different levels in all. Null: they do
 * not, as those of a monochrome sensor or of a mosaic that sees no light.
 *
 * In blocks of 32 x 32 pixels every pixel is compared with its neighbours of another phase on both sides, so that edges
 * and slopes of the scene cancel. A fine checkerboard has two levels, stripes have no alike diagonal. A grid of dots
 * with a period of exactly two pixels all over the frame cannot be told from a mosaic.
 *
 * Which of the two colours that are not green is red the levels cannot tell: the brighter one is called so. */
SensorNoise_EXPORT std::optional<BayerPattern>
RecogniseMosaic(const std::vector<double> & frameDn,
                std::size_t                 width,
                std::size_t                 height,
                const ParallelFor &         parallelFor = SerialFor);

} // namespace sensornoise

#endif
