// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_emva1288_EmvaFigures_h
#define sensornoise_emva1288_EmvaFigures_h

#include "sensornoise/Emva1288.h"

#include <string>

namespace sensornoise
{

/** Returns the photon transfer curve as an SVG element for a page with FigureStyle: temporal variance less dark
 * variance, against signal, with the line of the system gain. */
std::string
TransferFigure(const EmvaReport & report);

/** Returns the signal-to-noise ratio with its models, in the form of TransferFigure(). Both axes are logarithmic. The
 * abscissa is photons; where these are not known, electrons; where there is no gain either, the signal. */
std::string
SnrFigure(const EmvaReport & report);

/** Returns signal and deviation from the line of the linearity against photons or exposure, in the form of
 * TransferFigure(). */
std::string
LinearityFigure(const EmvaReport & report);

} // namespace sensornoise

#endif
