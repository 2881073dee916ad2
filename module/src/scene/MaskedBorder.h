// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_scene_MaskedBorder_h
#define sensornoise_scene_MaskedBorder_h

#include "SensorNoiseExport.h"
#include "sensornoise/FrameGeometry.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace sensornoise
{

/** A strip along a border of the frame that is not part of the scene. */
struct MaskedStrip
{
  const char * words{ "" };     ///< description, such as "leftmost columns"
  std::size_t  lines{ 0 };      ///< number of columns or rows; 0: there is no strip
  double       levelDn{ 0.0 };  ///< median level of the strip [DN]
  double       besideDn{ 0.0 }; ///< median of the line of the scene next to it [DN]
};

/** The strips of the four borders, and the numbers of their columns or rows. Estimator.md, 3.2. */
struct SensorNoise_EXPORT MaskedBorder
{
  std::vector<MaskedStrip> strips; ///< strips that were found, in the order left, right, top, bottom
  std::size_t              left{ 0 };
  std::size_t              right{ 0 };
  std::size_t              top{ 0 };
  std::size_t              bottom{ 0 };

  bool
  Holds(std::size_t x, std::size_t y, const FrameGeometry & geometry) const
  {
    return x < left || y < top || x + right >= geometry.width || y + bottom >= geometry.height;
  }
  /** Returns the number of pixels of all strips. */
  std::size_t
  Pixels(const FrameGeometry & geometry) const
  {
    return geometry.Pixels() - (geometry.width - left - right) * (geometry.height - top - bottom);
  }
};

/** Finds the optical-black columns and rows, and other dark border regions, in the \a mean levels [DN] of the \a valid
 * pixels. They are strips of one level that end along a whole border within one pixel, unlike the image of a scene. */
SensorNoise_EXPORT MaskedBorder
FindMaskedBorder(const std::vector<double> &       mean,
                 const std::vector<std::uint8_t> & valid,
                 const FrameGeometry &             geometry);

} // namespace sensornoise

#endif
