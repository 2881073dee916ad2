// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_page_MapPicture_h
#define sensornoise_page_MapPicture_h

#include <cstddef>
#include <cstdint>
#include <string>

namespace sensornoise
{

/** The maps of a measurement, row by row; they belong to the caller. */
struct PageMaps
{
  std::size_t          width{ 0 };
  std::size_t          height{ 0 };
  const double *       mean{ nullptr };     ///< [DN]; null: none
  const std::uint8_t * pixelUse{ nullptr }; ///< as PixelUse; null: none

  bool
  IsEmpty() const
  {
    return width == 0 || height == 0 || (mean == nullptr && pixelUse == nullptr);
  }
};

/** The mean image as HTML, in grey from its quantile 0.002 to 0.998, each point of it the mean of the pixels that it
 * stands for. At most 256 points wide and high. */
std::string
MeanPicture(const PageMaps & maps);

/** The map of pixel use with its legend as HTML; a point has the use that most of its pixels have, unless it is
 * "used", and an eighth of them have another. */
std::string
PixelUsePicture(const PageMaps & maps);

} // namespace sensornoise

#endif
