// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_emva1288_EmvaText_h
#define sensornoise_emva1288_EmvaText_h

#include "sensornoise/Emva1288.h"

#include <string>

/** \file
 * Words and figures of a report, for its table, its records and its page. */

namespace sensornoise
{

/** Returns the unit of a quantity, with the unit of the exposure in place of "unit": photons for the line of the
 * linearity where they are known, else the unit of the exposure times. */
std::string
UnitOf(const EmvaQuantityEntry & entry, const EmvaReport & report);

/** Returns the title of a section of EmvaQuantityList(), as plain text. */
std::string
EmvaSectionTitle(const std::string & section);

/** Returns number and size of the frames and the number of series, as plain text. */
std::string
EmvaSeriesWords(const EmvaReport & report);

/** Returns whether all points have photons, which are then the abscissa of the linearity. */
bool
HasPhotons(const EmvaReport & report);

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
