// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_pixels_IlluminationResponses_h
#define sensornoise_pixels_IlluminationResponses_h

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

/** The projected stack and the quantities needed to analyse the illumination pixel by pixel. */
struct IlluminationResponses
{
  const ReferenceFrame &            frame;
  const PixelCoordinates &          coordinates;
  std::size_t                       factors; ///< number of illumination components, which are the first coordinates
  const VarianceLine &              line;
  const std::vector<std::uint8_t> & mask;
  double                            centreDn;  ///< level that is subtracted from the means [DN]
  double                            darkestDn; ///< darkest quantile of the means [DN]
  double                            rangeDn;   ///< brightest minus darkest quantile of the means [DN]
};

/** Division of the frame into tiles within which local illumination has one pattern. */
struct Tiles
{
  std::size_t height; ///< height of a tile [pixel]
  std::size_t width;  ///< width of a tile [pixel]
  std::size_t across; ///< number of tiles in a row of tiles

  /** Returns the tile of pixel \a p of frames of \a frameWidth columns. */
  std::size_t
  Of(std::size_t p, std::size_t frameWidth) const
  {
    return p / frameWidth / height * across + p % frameWidth / width;
  }
};

/** Returns a map of the responses to each illumination component, without the part that motion leaked into them by
 * chance [DN]. They are 0 outside the mask. The leakage is kappa_k times the derivatives, with kappa common to the
 * frame. It is estimated against lines in the mean that are free in every 8 x 8 tile (Frisch & Waugh 1933), so that
 * local illumination does not bias it. Even derivatives resemble the mean locally, so their leakage would shift the
 * offset. */
SensorNoise_EXPORT std::vector<std::vector<double>>
RemoveMotionLeakage(const IlluminationResponses & data, const ParallelFor & parallelFor);

} // namespace sensornoise

#endif
