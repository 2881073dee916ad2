// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_page_MapPicture_h
#define sensornoise_page_MapPicture_h

#include "sensornoise/ReportPage.h"
#include <cstddef>
#include <cstdint>
#include <string>

namespace sensornoise
{

/** Returns the mean image as an HTML figure of at most 256 x 256 points. A point is the mean of its finite pixels. Grey
 * is from the 0.002 to the 0.998 quantile of the points. "" if there is no mean image. Throws as PixelUsePicture(). */
std::string
MeanPicture(const PageMaps & maps);

/** Returns the map of pixel use with its legend as an HTML figure of at most 256 x 256 points. A point is "used" if
 * more than seven eighths of its pixels are used. Otherwise it has the most frequent other use. "" if there is no map.
 * Throws std::runtime_error if zlib cannot compress the picture. */
std::string
PixelUsePicture(const PageMaps & maps);

} // namespace sensornoise

#endif
