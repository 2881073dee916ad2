// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "page/Figures.h"

#include "base/Text.h"
#include "page/PageSections.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace sensornoise
{
namespace
{
/** Returns the least of 1, 2 or 5 times a power of ten that is at least \a least, which is above 0. */
double
RoundStep(double least)
{
  const double power = std::pow(10.0, std::floor(std::log10(least)));
  for (const double factor : { 1.0, 2.0, 5.0 })
  {
    if (factor * power >= least * (1.0 - 1e-9))
    {
      return factor * power;
    }
  }
  return 10.0 * power;
}

std::string
TextAt(double x, double y, const char * attributes, const std::string & text)
{
  return "<text x=\"" + SvgNumber(x) + "\" y=\"" + SvgNumber(y) + "\" " + attributes + ">" + text + "</text>\n";
}
} // namespace

std::string
SvgNumber(double number)
{
  return FixedText(number, 1);
}

std::string
OpenSvg(double height, const std::string & label)
{
  return "<svg viewBox=\"0 0 " + SvgNumber(FigureWidth) + " " + SvgNumber(height) + "\" role=\"img\" aria-label=\"" +
         Escaped(label) + "\">\n";
}

std::string
AsSvgFile(std::string figure, const std::string & title)
{
  const std::string style =
    "<style>" + std::string(FigureStyle) + "</style>\n<rect class=\"paper\" width=\"100%\" height=\"100%\"/>\n";
  figure.insert(figure.find('>') + 1, "<title>" + Escaped(title) + "</title>" + style);
  figure.insert(figure.find('>'), " xmlns=\"http://www.w3.org/2000/svg\" width=\"720\"");
  return figure;
}

std::string
PlotAxis::LabelOf(double tick) const
{
  if (isLogarithmic)
  {
    return Text(std::pow(10.0, tick));
  }
  const double largest = std::max(std::abs(low), std::abs(high));
  std::string  text = FixedText(std::abs(tick), decimals);
  if (decimals > 5 || largest >= 1e7)
  {
    text = GeneralText(std::abs(tick), 3);
  }
  return tick < 0.0 ? "\u2212" + text : text;
}

double
PlotAxis::LabelWidth() const
{
  constexpr double digit = 9.0; // at a font size of 14; a minus sign, three bytes of UTF-8, counts as 1.5 digits
  double           width = 0.0;
  for (const double tick : ticks)
  {
    const std::string label = this->LabelOf(tick);
    width = std::max(width, digit * static_cast<double>(label.size()) - (tick < 0.0 ? 1.5 * digit : 0.0));
  }
  return width;
}

PlotAxis
MakeAxis(double low, double high, int mostTicks)
{
  constexpr double largest = 1e300;
  if (!std::isfinite(low) || !std::isfinite(high) || std::abs(low) > largest || std::abs(high) > largest)
  {
    low = 0.0;
    high = 1.0;
  }
  if (!(high - low > 1e-9 * std::max(std::abs(low), std::abs(high))))
  {
    const double half = std::max(0.5 * std::abs(low), 1e-12);
    low -= half;
    high += half;
  }
  const double margin = 0.04 * (high - low);
  PlotAxis     axis;
  axis.low = low - margin;
  axis.high = high + margin;
  const double step = RoundStep((axis.high - axis.low) / mostTicks);
  axis.decimals = std::max(0, -static_cast<int>(std::floor(std::log10(step) + 1e-9)));
  const double first = std::ceil(axis.low / step);
  const double last = std::floor(axis.high / step);
  for (double i = first; i <= last && axis.ticks.size() < 20; i += 1.0)
  {
    axis.ticks.push_back(i == 0.0 ? 0.0 : i * step); // no -0
  }
  return axis;
}

PlotAxis
MakeLogarithmicAxis(double low, double high)
{
  constexpr std::size_t fewTicks = 8; // largest number of ticks whose labels do not touch
  constexpr std::size_t mostTicks = 20;
  PlotAxis              axis = MakeAxis(low, high, 4);
  const PlotAxis        even = axis;
  for (const std::vector<double> & factors : { std::vector<double>{ 1.0, 1.5, 2.0, 3.0, 4.0, 5.0, 7.0 },
                                               std::vector<double>{ 1.0, 2.0, 5.0 },
                                               std::vector<double>{ 1.0, 3.0 },
                                               std::vector<double>{ 1.0 } })
  {
    axis.ticks.clear();
    for (double power = std::floor(axis.low); power <= axis.high && axis.ticks.size() < mostTicks; power += 1.0)
    {
      for (const double factor : factors)
      {
        const double tick = power + std::log10(factor);
        if (tick >= axis.low && tick <= axis.high)
        {
          axis.ticks.push_back(tick);
        }
      }
    }
    if (axis.ticks.size() <= fewTicks)
    {
      break;
    }
  }
  axis.ticks = axis.ticks.size() < 2 ? even.ticks : axis.ticks;
  axis.isLogarithmic = true;
  return axis;
}

void
FiniteRange::Add(double value)
{
  if (std::isfinite(value))
  {
    m_Low = m_IsEmpty ? value : std::min(m_Low, value);
    m_High = m_IsEmpty ? value : std::max(m_High, value);
    m_IsEmpty = false;
  }
}

void
FiniteRange::Add(const std::vector<double> & values)
{
  for (const double value : values)
  {
    this->Add(value);
  }
}

PlotAxis
FiniteRange::Axis(int mostTicks) const
{
  return MakeAxis(m_Low, m_High, mostTicks);
}

PlotAxis
FiniteRange::LogarithmicAxis() const
{
  return MakeLogarithmicAxis(m_Low, m_High);
}

SvgPanel::SvgPanel(std::string &       svg,
                   const Box &         box,
                   PlotAxis            x,
                   PlotAxis            y,
                   const std::string & xName,
                   const std::string & yName)
  : m_Svg(svg)
  , m_Box(box)
  , m_X(std::move(x))
  , m_Y(std::move(y))
{
  this->DrawAxes(xName, yName);
  // A nested svg element clips its content. A clipPath would need an id that no other figure of the page has.
  m_Svg += "<svg x=\"" + SvgNumber(box.left) + "\" y=\"" + SvgNumber(box.top) + "\" width=\"" + SvgNumber(box.width) +
           "\" height=\"" + SvgNumber(box.height) + "\">\n";
}

SvgPanel::~SvgPanel()
{
  m_Svg += "</svg>\n";
}

void
SvgPanel::DrawAxes(const std::string & xName, const std::string & yName)
{
  const double bottom = m_Box.top + m_Box.height;
  std::string  grid;
  for (const double tick : m_X.ticks)
  {
    const double x = m_Box.left + this->X(tick);
    grid += "M" + SvgNumber(x) + " " + SvgNumber(m_Box.top) + "V" + SvgNumber(bottom);
    m_Svg += xName.empty() ? "" : TextAt(x, bottom + 17.0, "text-anchor=\"middle\"", m_X.LabelOf(tick));
  }
  for (const double tick : m_Y.ticks)
  {
    const double y = m_Box.top + this->Y(tick);
    grid += "M" + SvgNumber(m_Box.left) + " " + SvgNumber(y) + "H" + SvgNumber(m_Box.left + m_Box.width);
    m_Svg += TextAt(m_Box.left - 6.0, y + 5.0, "text-anchor=\"end\"", m_Y.LabelOf(tick));
  }
  m_Svg += "<path class=\"grid\" d=\"" + grid + "\"/>\n";
  m_Svg += "<rect class=\"frame\" x=\"" + SvgNumber(m_Box.left) + "\" y=\"" + SvgNumber(m_Box.top) + "\" width=\"" +
           SvgNumber(m_Box.width) + "\" height=\"" + SvgNumber(m_Box.height) + "\"/>\n";
  if (!xName.empty())
  {
    m_Svg += TextAt(m_Box.left + m_Box.width / 2.0, bottom + 36.0, "text-anchor=\"middle\"", xName);
  }
  m_Svg += TextAt(4.0, m_Box.top - 8.0, "", yName);
}

double
SvgPanel::X(double x) const
{
  return m_Box.width * (x - m_X.low) / (m_X.high - m_X.low);
}

double
SvgPanel::Y(double y) const
{
  // a number of many digits would only make the file longer
  const double place = m_Box.height * (m_Y.high - y) / (m_Y.high - m_Y.low);
  return std::clamp(place, -10.0 * m_Box.height, 11.0 * m_Box.height);
}

void
SvgPanel::Points(const std::vector<double> & x, const std::vector<double> & y, const char * style, PlotMarker marker)
{
  std::string path;
  for (std::size_t i = 0; i < x.size() && i < y.size(); ++i)
  {
    if (!std::isfinite(x[i]) || !std::isfinite(y[i]))
    {
      continue;
    }
    const double left = this->X(x[i]) - 2.5;
    const double middle = this->Y(y[i]);
    path += "M" + SvgNumber(left) + " " + SvgNumber(marker == PlotMarker::Square ? middle - 2.5 : middle);
    path += marker == PlotMarker::Square ? "h5v5h-5z" : "a2.5 2.5 0 1 0 5 0a2.5 2.5 0 1 0-5 0";
  }
  if (!path.empty())
  {
    const char * const kind = marker == PlotMarker::Disc ? " full" : "";
    m_Svg += "<path class=\"" + std::string(style) + " point" + kind + "\" d=\"" + path + "\"/>\n";
  }
}

void
SvgPanel::Line(const std::vector<double> & x, const std::vector<double> & y, const char * style)
{
  std::string path;
  bool        isDown = false;
  for (std::size_t i = 0; i < x.size() && i < y.size(); ++i)
  {
    const bool isKnown = std::isfinite(x[i]) && std::isfinite(y[i]);
    if (isKnown)
    {
      path += (isDown ? "L" : "M") + SvgNumber(this->X(x[i])) + " " + SvgNumber(this->Y(y[i]));
    }
    isDown = isKnown;
  }
  if (!path.empty())
  {
    m_Svg += "<path class=\"" + std::string(style) + " line\" d=\"" + path + "\"/>\n";
  }
}

void
SvgPanel::Band(const std::vector<double> & x,
               const std::vector<double> & low,
               const std::vector<double> & high,
               const char *                style)
{
  const std::size_t count = std::min({ x.size(), low.size(), high.size() });
  std::string       path;
  for (std::size_t i = 0; i < 2 * count; ++i)
  {
    const std::size_t place = i < count ? i : 2 * count - 1 - i; // forward along low, back along high
    const double      y = i < count ? low[place] : high[place];
    path += (i == 0 ? "M" : "L") + SvgNumber(this->X(x[place])) + " " + SvgNumber(this->Y(y));
  }
  if (count > 0)
  {
    m_Svg += "<path class=\"" + std::string(style) + " band\" d=\"" + path + "z\"/>\n";
  }
}

void
SvgPanel::Level(double y, const char * style)
{
  m_Svg += "<path class=\"" + std::string(style) + " line\" d=\"M0 " + SvgNumber(this->Y(y)) + "H" +
           SvgNumber(m_Box.width) + "\"/>\n";
}

} // namespace sensornoise
