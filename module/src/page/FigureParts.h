// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_page_FigureParts_h
#define sensornoise_page_FigureParts_h

#include "page/SvgPanel.h"

#include <initializer_list>
#include <string>

namespace sensornoise
{

/** Place of the panels of a figure, with space for the labels of all their axes [units of the figure]. */
struct PanelPlace
{
  double left{ 0.0 };
  double width{ 0.0 };

  PanelPlace(const PlotAxis & across, std::initializer_list<PlotAxis> up);
};

/** Adds a sign and its words to the legend at (x, y). Returns the x at which the next entry may begin. */
double
LegendEntry(std::string & svg, double x, double y, const std::string & sign, const std::string & words);

/** Returns the sign of a line for a legend. \a style: a class of FigureStyle. */
std::string
LineSign(const char * style);

/** Returns the sign of points for a legend, a circle. \a style: classes of FigureStyle. */
std::string
PointSign(const char * style);

} // namespace sensornoise

#endif
