// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_page_Figures_h
#define sensornoise_page_Figures_h

#include "SensorNoiseExport.h"
#include "page/FigureData.h"

#include <string>

namespace sensornoise
{

/** Each figure is an SVG element for a page that has FigureStyle; what there is nothing of is a sentence, a paragraph
 * of HTML, in its place. */

/** Variance against mean, as it is and corrected, with the line and its band; below it the residuals. */
std::string
CurveFigure(const FigureData & data);

/** Flicker and, where it is known, motion over the frames. */
std::string
SeriesFigure(const FigureData & data);

/** What neighbours and frames share of their noise: a bar a lag. */
std::string
CorrelationFigure(const FigureData & data);

/** The curve as an SVG file of its own, light or dark as its viewer is. \a title: what was measured, in words. */
SensorNoise_EXPORT std::string
CurveAsSvgFile(const FigureData & data, const std::string & title);

} // namespace sensornoise

#endif
