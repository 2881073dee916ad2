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

/** Returns the Bayer pattern of a frame, one exposure or the mean of many [DN], if its levels alternate as behind a
 * Bayer mosaic. There must be three different levels, one of them on both pixels of a diagonal of the 2 x 2 pixels,
 * everywhere. Null: the levels do not alternate in this way, as with a monochrome sensor or a dark mosaic.
 *
 * In blocks of 32 x 32 pixels every pixel is compared with its neighbours of another phase on both sides, so that
 * edges and slopes of the scene cancel. A fine checkerboard has two levels, stripes have no diagonal of equal levels.
 * A grid of dots with a period of exactly two pixels in the whole frame cannot be distinguished from a mosaic.
 *
 * The levels do not determine which of the two colours that are not green is red: the brighter one is called red. */
template <typename TPixel>
SensorNoise_EXPORT std::optional<BayerPattern>
RecogniseMosaic(const TPixel *      frameDn,
                std::size_t         width,
                std::size_t         height,
                const ParallelFor & parallelFor = SerialFor);

inline std::optional<BayerPattern>
RecogniseMosaic(const std::vector<double> & frameDn,
                std::size_t                 width,
                std::size_t                 height,
                const ParallelFor &         parallelFor = SerialFor)
{
  return RecogniseMosaic(frameDn.data(), width, height, parallelFor);
}

} // namespace sensornoise

#endif
