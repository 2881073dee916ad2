// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef SvgAsPng_h
#define SvgAsPng_h

#include <string>

namespace sensornoise::tools
{

/** Throws std::runtime_error, which names what to build with, where this program has no librsvg. \a file: the PNG that
 * is wanted. */
void
RequirePng(const std::string & file);

/** The bytes of a PNG of an SVG figure, with two pixels for each of its units, in its colours for light paper. Throws
 * std::runtime_error. */
std::string
SvgAsPng(const std::string & svg);

} // namespace sensornoise::tools

#endif
