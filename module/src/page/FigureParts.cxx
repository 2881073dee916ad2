// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "page/FigureParts.h"

#include "page/HtmlText.h"

#include <algorithm>
#include <string>

namespace sensornoise
{

PanelPlace::PanelPlace(const PlotAxis & across, std::initializer_list<PlotAxis> up)
{
  for (const PlotAxis & axis : up)
  {
    left = std::max(left, axis.LabelWidth() + 10.0);
  }
  width = FigureWidth - left - std::max(12.0, 0.5 * across.LabelWidth() + 2.0);
}

double
LegendEntry(std::string & svg, double x, double y, const std::string & sign, const std::string & words)
{
  svg += "<g transform=\"translate(" + SvgNumber(x) + " " + SvgNumber(y) + ")\">" + sign + "<text x=\"26\" y=\"5\">" +
         Escaped(words) + "</text></g>\n";
  return x + 44.0 + 7.2 * static_cast<double>(words.size());
}

std::string
LineSign(const char * style)
{
  return "<path class=\"" + std::string(style) + " line\" d=\"M0 0H20\"/>";
}

std::string
PointSign(const char * style)
{
  return "<path class=\"" + std::string(style) + "\" d=\"M7 0a2.5 2.5 0 1 0 5 0a2.5 2.5 0 1 0-5 0\"/>";
}

} // namespace sensornoise
