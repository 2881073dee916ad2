// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_pixels_PixelLight_h
#define sensornoise_pixels_PixelLight_h

#include "SensorNoiseExport.h"
#include "sensornoise/Parallel.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace sensornoise
{

class PixelCoordinates;
struct ReferenceFrame;
struct VarianceLine;

/** The projected stack and what is known of it when the light is looked at, pixel by pixel. */
struct PixelLight
{
  const ReferenceFrame &            frame;
  const PixelCoordinates &          coordinates;
  std::size_t                       factors; ///< of light: the first coordinates
  const VarianceLine &              line;
  const std::vector<std::uint8_t> & mask;
  double                            centreDn;  ///< the level that is subtracted from the means [DN]
  double                            darkestDn; ///< quantile of the means [DN]
  double                            rangeDn;   ///< from the darkest to the brightest quantile [DN]
};

/** A way to cut the frame into tiles, within which local light has one pattern. */
struct Tiles
{
  std::size_t height; ///< of a tile [pixels]
  std::size_t width;  ///< of a tile [pixels]
  std::size_t across; ///< tiles side by side

  /** The tile of pixel \a p of frames of \a frameWidth columns. */
  std::size_t
  Of(std::size_t p, std::size_t frameWidth) const
  {
    return p / frameWidth / height * across + p % frameWidth / width;
  }
};

/** Removes what motion leaked by chance into the responses: kappa_k times the derivatives, kappa common to the frame.
 * It is estimated against lines in the mean that are free in every 8 x 8 tile (Frisch & Waugh 1933), so that light
 * that differs over the frame does not bias it. Even derivatives resemble the mean locally and would shift the offset.
 * Returns a map for each series of light; 0 outside the mask. */
SensorNoise_EXPORT std::vector<std::vector<double>>
ResponsesWithoutMotion(const PixelLight & data, const ParallelFor & parallelFor);

} // namespace sensornoise

#endif
