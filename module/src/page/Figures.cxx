// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "page/Figures.h"

#include "base/Text.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <iterator>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace sensornoise
{
namespace
{
constexpr std::size_t MostPieces = 400; ///< pieces to which a long series is reduced
/** Largest number of lags in the figure of the correlation. */
constexpr std::size_t MostBars = 16;

/** Largest variance on the axis, relative to the largest corrected variance [1]. Larger variances as measured are
 * outside of the figure. */
constexpr double HighestFactor = 4.0;

/** Returns the axis of the variance. It has all corrected variances and the line, and variances as measured up to
 * HighestFactor. \a above: number of larger ones. */
PlotAxis
VarianceAxis(const FigureData & data, std::size_t & above)
{
  FiniteRange range;
  range.Add(0.0);
  range.Add(data.corrected);
  range.Add(data.lineVariance);
  double highest = 0.0;
  for (const double variance : data.corrected)
  {
    highest = std::max(highest, variance);
  }
  above = 0;
  for (const double variance : data.variance)
  {
    const bool isAbove = highest > 0.0 && variance > HighestFactor * highest;
    above += isAbove ? 1 : 0;
    range.Add(isAbove ? std::numeric_limits<double>::quiet_NaN() : variance);
  }
  if (above > 0)
  {
    range.Add(HighestFactor * highest);
  }
  return range.Axis(8);
}

PlotAxis
MeanAxis(const FigureData & data)
{
  FiniteRange range;
  range.Add(data.mean);
  return range.Axis(6);
}

PlotAxis
ResidualAxis(const FigureData & data)
{
  FiniteRange range;
  range.Add(data.residuals);
  range.Add(-3.0);
  range.Add(3.0);
  return range.Axis(6);
}

void
DrawResiduals(std::string & svg, const FigureData & data, const PanelPlace & place, double top)
{
  const PlotAxis across = MeanAxis(data);
  SvgPanel       panel(svg,
                       { place.left, top, place.width, 90.0 },
                 across,
                 ResidualAxis(data),
                 "mean [DN]",
                 "residual [standard errors of the point]");
  panel.Band({ across.low, across.high }, { -2.0, -2.0 }, { 2.0, 2.0 }, "third");
  panel.Level(0.0, "zero");
  panel.Points(data.meanResiduals, data.residuals, "after", PlotMarker::Disc);
}

std::string
DrawCurve(const FigureData & data)
{
  const bool       hasResiduals = !data.residuals.empty();
  std::size_t      above = 0;
  const auto       axis = VarianceAxis(data, above);
  const PanelPlace place(MeanAxis(data), { axis, ResidualAxis(data) });
  std::string      svg = OpenSvg(hasResiduals ? 546.0 : 424.0,
                            data.isOfLevelSets ? "variance against level" : "temporal variance against mean");
  const char * const line = data.isIndicative ? "third dashed" : "third";
  const std::string  higher =
    above > 0 ? " (" + std::to_string(above) + (above == 1 ? " point is higher)" : " points are higher)") : "";
  if (!data.isOfLevelSets)
  {
    LegendEntry(svg, 4.0, 12.0, PointSign("before point"), "as measured" + higher);
  }
  const double next = LegendEntry(
    svg, 4.0, 32.0, PointSign("after point full"), data.isOfLevelSets ? "level sets" : "without flicker and motion");
  if (!data.lineMean.empty())
  {
    const std::string band = data.bandLow.empty() ? "" : ", 95 % band";
    LegendEntry(svg, next, 32.0, LineSign(line), (data.isIndicative ? "line, indicative: no gain" : "line") + band);
  }
  {
    SvgPanel panel(svg,
                   { place.left, 68.0, place.width, 308.0 },
                   MeanAxis(data),
                   axis,
                   hasResiduals ? "" : "mean [DN]",
                   "variance [DN\u00B2]");
    if (!data.isOfLevelSets)
    {
      panel.Points(data.mean, data.variance, "before", PlotMarker::Ring);
    }
    panel.Band(data.lineMean, data.bandLow, data.bandHigh, "third");
    panel.Points(data.mean, data.corrected, "after", PlotMarker::Disc);
    panel.Line(data.lineMean, data.lineVariance, line);
  }
  if (hasResiduals)
  {
    DrawResiduals(svg, data, place, 412.0);
  }
  return svg + "</svg>\n";
}

/** Returns the numbers of a series against their index. A long series is reduced to the least and the largest number of
 * each of MostPieces pieces. */
std::pair<std::vector<double>, std::vector<double>>
ThinnedOut(const std::vector<double> & series)
{
  std::vector<double> x;
  std::vector<double> y;
  const auto          add = [&](std::size_t i) {
    x.push_back(static_cast<double>(i));
    y.push_back(series[i]);
  };
  if (series.size() <= 2 * MostPieces)
  {
    for (std::size_t i = 0; i < series.size(); ++i)
    {
      add(i);
    }
    return { x, y };
  }
  for (std::size_t piece = 0; piece < MostPieces; ++piece)
  {
    const std::size_t begin = piece * series.size() / MostPieces;
    const std::size_t end = (piece + 1) * series.size() / MostPieces;
    std::size_t       least = begin;
    std::size_t       largest = begin;
    for (std::size_t i = begin; i < end; ++i)
    {
      if (!std::isfinite(series[i]))
      {
        continue; // a frame that was left out
      }
      least = series[least] <= series[i] ? least : i; // also replaces NaN, as comparisons with it are false
      largest = series[largest] >= series[i] ? largest : i;
    }
    add(std::min(least, largest));
    add(std::max(least, largest));
  }
  return { x, y };
}

void
DrawSeries(SvgPanel & panel, const std::vector<double> & series, const char * style)
{
  const auto [x, y] = ThinnedOut(series);
  panel.Line(x, y, style);
}

PlotAxis
AxisOfFrames(const FigureData & data)
{
  const std::size_t frames = std::max({ data.flicker.size(), data.motionX.size(), std::size_t{ 2 } });
  return MakeAxis(0.0, static_cast<double>(frames - 1), 6);
}

std::string
NameOfLag(const NoiseCorrelationRecord::Lag & lag)
{
  return lag.frames > 0 ? CountText(static_cast<std::size_t>(lag.frames), "frame")
                        : "x " + std::string(lag.x < 0 ? "\u2212" : "") + std::to_string(std::abs(lag.x)) + ", y " +
                            std::to_string(lag.y);
}

/** Returns the finite lags in their order, at most MostBars: those with the largest ratio of coefficient to standard
 * error. */
std::vector<NoiseCorrelationRecord::Lag>
ClearestLags(const FigureData & data)
{
  std::vector<NoiseCorrelationRecord::Lag> lags;
  std::copy_if(data.lags.begin(), data.lags.end(), std::back_inserter(lags), [](const auto & lag) {
    return std::isfinite(lag.value) && std::isfinite(lag.standardError);
  });
  const auto clearness = [](const auto & lag) { return std::abs(lag.value) / std::max(lag.standardError, 1e-300); };
  while (lags.size() > MostBars)
  {
    lags.erase(std::min_element(
      lags.begin(), lags.end(), [&](const auto & a, const auto & b) { return clearness(a) < clearness(b); }));
  }
  return lags;
}
} // namespace

std::string
CurveFigure(const FigureData & data)
{
  return data.HasCurve() ? DrawCurve(data) : "<p>No point of the noise curve was measured.</p>\n";
}

std::string
SeriesFigure(const FigureData & data)
{
  const auto isKnown = [](const std::vector<double> & series) {
    return std::any_of(series.begin(), series.end(), [](double number) { return std::isfinite(number); });
  };
  const bool hasMotion = isKnown(data.motionX) || isKnown(data.motionY);
  const bool hasFlicker = isKnown(data.flicker);
  if (!hasFlicker && !hasMotion)
  {
    return "<p>Neither flicker nor motion was measured.</p>\n";
  }
  std::string svg = OpenSvg(hasMotion && hasFlicker ? 410.0 : 210.0, "flicker and motion over the frames");
  FiniteRange flicker;
  flicker.Add(0.0);
  flicker.Add(data.flicker);
  FiniteRange motion;
  motion.Add(0.0);
  motion.Add(data.motionX);
  motion.Add(data.motionY);
  const PanelPlace place(AxisOfFrames(data), { flicker.Axis(5), motion.Axis(5) });
  double           top = 26.0;
  if (hasFlicker)
  {
    SvgPanel panel(svg,
                   { place.left, top, place.width, 140.0 },
                   AxisOfFrames(data),
                   flicker.Axis(5),
                   hasMotion ? "" : "frame",
                   "flicker \u03B3 [1], relative to the mean");
    panel.Level(0.0, "zero");
    DrawSeries(panel, data.flicker, "after");
    top += 200.0;
  }
  if (hasMotion)
  {
    const double next = LegendEntry(svg, 150.0, top - 13.0, LineSign("third"), "along x");
    LegendEntry(svg, next, top - 13.0, LineSign("before dashed"), "along y");
    SvgPanel panel(
      svg, { place.left, top, place.width, 140.0 }, AxisOfFrames(data), motion.Axis(5), "frame", "motion [pixel]");
    panel.Level(0.0, "zero");
    DrawSeries(panel, data.motionX, "third");
    DrawSeries(panel, data.motionY, "before dashed");
  }
  return svg + "</svg>\n";
}

std::string
CorrelationFigure(const FigureData & data)
{
  const auto lags = ClearestLags(data);
  if (lags.empty())
  {
    return "<p>The correlation of the noise was not measured.</p>\n";
  }
  constexpr double rowHeight = 20.0;
  FiniteRange      range;
  range.Add(0.0);
  for (const auto & lag : lags)
  {
    range.Add(lag.value - 2.0 * lag.standardError);
    range.Add(lag.value + 2.0 * lag.standardError);
  }
  const double height = rowHeight * static_cast<double>(lags.size());
  std::string  svg = OpenSvg(height + 72.0, "correlation of the noise by lag");
  const double left = 96.0;
  const double right = 0.5 * range.Axis(5).LabelWidth() + 2.0;
  PlotAxis     rows;
  rows.low = 0.0;
  rows.high = height;
  for (std::size_t i = 0; i < lags.size(); ++i)
  {
    svg += "<text x=\"" + SvgNumber(left - 8.0) + "\" y=\"" +
           SvgNumber(26.0 + rowHeight * (static_cast<double>(i) + 0.75)) + "\" text-anchor=\"end\">" +
           NameOfLag(lags[i]) + "</text>\n";
  }
  {
    SvgPanel panel(svg,
                   { left, 26.0, FigureWidth - left - right, height },
                   range.Axis(5),
                   rows,
                   "correlation coefficient [1], \u00B1 2 standard errors",
                   "lag");
    for (std::size_t i = 0; i < lags.size(); ++i)
    {
      const double zero = panel.X(0.0);
      const double end = panel.X(lags[i].value);
      const double middle = rowHeight * (static_cast<double>(i) + 0.5);
      svg += "<path class=\"bar\" d=\"M" + SvgNumber(zero) + " " + SvgNumber(middle - 6.0) + "H" + SvgNumber(end) +
             "v12H" + SvgNumber(zero) + "z\"/>";
      svg += "<path class=\"error\" d=\"M" + SvgNumber(panel.X(lags[i].value - 2.0 * lags[i].standardError)) + " " +
             SvgNumber(middle) + "H" + SvgNumber(panel.X(lags[i].value + 2.0 * lags[i].standardError)) + "\"/>\n";
    }
    svg += "<path class=\"zero line\" d=\"M" + SvgNumber(panel.X(0.0)) + " 0V" + SvgNumber(height) + "\"/>\n";
  }
  return svg + "</svg>\n";
}

std::string
CurveAsSvgFile(const FigureData & data, const std::string & title)
{
  return AsSvgFile(data.HasCurve()
                     ? DrawCurve(data)
                     : OpenSvg(60.0, "nothing was measured") +
                         "<text x=\"12\" y=\"34\">No point of the noise curve was measured.</text></svg>\n",
                   title);
}

} // namespace sensornoise
