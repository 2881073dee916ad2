// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef SvgAsPng_h
#define SvgAsPng_h

#include <string>

namespace sensornoise::tools
{

/** Throws std::runtime_error if this program was built without librsvg. The message names the library, and \a file,
 * the PNG to be written. */
void
RequirePng(const std::string & file);

/** Draws an SVG figure in its colours for light paper. Returns the bytes of a PNG with two pixels per unit of the
 * figure. Throws std::runtime_error. */
std::string
SvgAsPng(const std::string & svg);

} // namespace sensornoise::tools

#endif
