// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_exports_LineExports_h
#define sensornoise_exports_LineExports_h

#include "sensornoise/NoiseExport.h"

#include <string>
#include <utility>
#include <vector>

namespace sensornoise
{

/** The tag NoiseProfile as text: the numbers of all pairs, scale and offset, as exiftool takes them. */
NoiseExport
ExportDng(const CameraNoise & noise);

/** The gains and noise offsets of all channels for ndsafir: gain x + offset. */
NoiseExport
ExportNdsafir(const CameraNoise & noise);

/** The arguments of the package anscombe-transform: the variance is conversion_gain (x - zero_level), and the zero
 * level is a whole number. */
NoiseExport
ExportAnscombeTransform(const CameraNoise & noise);

/** The arguments of deepinv's PoissonGaussianNoise for levels between 0 and 1: the variance is gain x + sigma^2. */
NoiseExport
ExportDeepinv(const CameraNoise & noise);

/** Returns the pairs (scale, offset) of the tag NoiseProfile in the first directory of a DNG file. Throws ExportError
 * unless \a file is a classic TIFF whose first directory is whole and has the tag, of pairs of doubles. */
std::vector<std::pair<double, double>>
NoiseProfileIn(const std::string & file);

} // namespace sensornoise

#endif
