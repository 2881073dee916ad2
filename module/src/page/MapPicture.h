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
