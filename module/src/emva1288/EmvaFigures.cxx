// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "emva1288/EmvaText.h"

#include "emva1288/EvaluationSteps.h"
#include "page/Figures.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace sensornoise
{

namespace
{
constexpr double PanelTop = 68.0;     ///< below a legend of two lines [unit of the figure]
constexpr double PanelHeight = 260.0; ///< height of the upper panel [unit of the figure]
constexpr double AxisBelow = 48.0;    ///< ticks and name of an axis [unit of the figure]

using Numbers = std::vector<double>;

/** Returns number(point) of all points. */
template <typename TFunction>
Numbers
OfPoints(const EmvaReport & report, TFunction number)
{
  Numbers numbers;
  numbers.reserve(report.points.size());
  for (const EmvaPoint & point : report.points)
  {
    numbers.push_back(number(point));
  }
  return numbers;
}

double
OrNaN(const std::optional<double> & value)
{
  return value.value_or(std::numeric_limits<double>::quiet_NaN());
}

/** Returns a decimal logarithm; NaN of numbers that have none. */
double
Log10(const std::optional<double> & value)
{
  return value && *value > 0.0 ? std::log10(*value) : std::numeric_limits<double>::quiet_NaN();
}

PlotAxis
AxisFrom0(const Numbers & numbers, int mostTicks)
{
  FiniteRange range;
  range.Add(0.0);
  range.Add(numbers);
  return range.Axis(mostTicks);
}

/** Returns photons or exposures of the points, and the name of this axis. */
std::pair<Numbers, std::string>
Abscissa(const EmvaReport & report)
{
  if (HasPhotons(report))
  {
    return { OfPoints(report, [](const EmvaPoint & point) { return OrNaN(point.photons); }), "photons" };
  }
  const std::string & unit = report.settings.exposureUnit;
  return { OfPoints(report, [](const EmvaPoint & point) { return point.exposure; }),
           unit.empty() ? "exposure" : "exposure [" + unit + "]" };
}

/** Returns the intercept of the line of the gain [DN^2]: it goes through the mean of the points of the fit. */
double
InterceptOf(const EmvaReport & report)
{
  double sum = 0.0;
  double count = 0.0;
  for (const EmvaPoint & point : report.points)
  {
    sum += point.isInGainFit ? point.excessDn2 - *report.gain.value * point.signalDn : 0.0;
    count += point.isInGainFit ? 1.0 : 0.0;
  }
  return sum / std::max(count, 1.0);
}
} // namespace

std::string
TransferFigure(const EmvaReport & report)
{
  const auto variance = [&report](bool isInFit) {
    return OfPoints(report, [isInFit](const EmvaPoint & point) {
      return point.isInGainFit == isInFit ? point.excessDn2 : std::numeric_limits<double>::quiet_NaN();
    });
  };
  const Numbers    signal = OfPoints(report, [](const EmvaPoint & point) { return point.signalDn; });
  const PlotAxis   x = AxisFrom0(signal, 6);
  const PlotAxis   y = AxisFrom0(OfPoints(report, [](const EmvaPoint & point) { return point.excessDn2; }), 8);
  const PanelPlace place(x, { y });
  std::string      svg = OpenSvg(PanelTop + PanelHeight + AxisBelow, "photon transfer: variance against signal");
  LegendEntry(svg, 4.0, 12.0, PointSign("before point"), "not in the fit");
  const double next = LegendEntry(svg, 4.0, 32.0, PointSign("after point full"), "in the fit");
  const double saturation = report.points[report.saturationPoint].signalDn;
  if (report.gain.value)
  {
    LegendEntry(svg, next, 32.0, LineSign("third"), "line of the gain K, up to 70 % of saturation");
  }
  SvgPanel panel(svg,
                 { place.left, PanelTop, place.width, PanelHeight },
                 x,
                 y,
                 "signal \u03BC_y \u2212 \u03BC_y.dark [DN]",
                 "variance \u03C3\u00B2_y \u2212 \u03C3\u00B2_y.dark [DN\u00B2]");
  panel.Line({ saturation, saturation }, { y.low, y.high }, "before dashed");
  panel.Points(signal, variance(false), "before", PlotMarker::Ring);
  panel.Points(signal, variance(true), "after", PlotMarker::Disc);
  if (report.gain.value)
  {
    const double end = InEmva.gainRange * saturation;
    const double intercept = InterceptOf(report);
    panel.Line({ 0.0, end }, { intercept, intercept + *report.gain.value * end }, "third");
  }
  return svg;
}

std::string
SnrFigure(const EmvaReport & report)
{
  const bool hasPhotons = HasPhotons(report);
  const auto gain = report.gain.value;
  const auto logarithm = [](auto member) { return [member](const EmvaPoint & point) { return Log10(point.*member); }; };
  const auto abscissa = OfPoints(report, [&](const EmvaPoint & point) {
    return hasPhotons ? Log10(point.photons) : Log10(gain ? point.signalDn / *gain : point.signalDn);
  });
  const auto measured = OfPoints(report, [](const EmvaPoint & point) { return Log10(point.snr); });
  const auto model = OfPoints(report, logarithm(&EmvaPoint::modelSnr));
  const auto total = OfPoints(report, logarithm(&EmvaPoint::totalSnr));
  FiniteRange across;
  across.Add(abscissa);
  FiniteRange up;
  up.Add(measured);
  up.Add(model);
  up.Add(total);
  const PlotAxis   x = across.LogarithmicAxis();
  const PlotAxis   y = up.LogarithmicAxis();
  const PanelPlace place(x, { y });
  std::string      svg = OpenSvg(PanelTop + PanelHeight + AxisBelow, "signal-to-noise ratio");
  LegendEntry(svg, 4.0, 12.0, PointSign("after point full"), "measured, temporal noise");
  const double next = LegendEntry(svg, 4.0, 32.0, LineSign("third"), "linear model");
  LegendEntry(svg, next, 32.0, LineSign("before dashed"), "model with DSNU and PRNU");
  SvgPanel panel(svg,
                 { place.left, PanelTop, place.width, PanelHeight },
                 x,
                 y,
                 hasPhotons ? "photons"
                 : gain     ? "signal [e\u207B]"
                            : "signal [DN]",
                 "SNR [1]");
  panel.Line(abscissa, model, "third");
  panel.Line(abscissa, total, "before dashed");
  panel.Points(abscissa, measured, "after", PlotMarker::Disc);
  return svg;
}

std::string
LinearityFigure(const EmvaReport & report)
{
  constexpr double lowerHeight = 90.0; // [unit of the figure]
  constexpr double lowerTop = 26.0 + PanelHeight + 36.0;
  const auto       values = Abscissa(report);
  const Numbers    signal = OfPoints(report, [](const EmvaPoint & point) { return point.signalDn; });
  const Numbers    deviation = OfPoints(report, [](const EmvaPoint & point) { return OrNaN(point.deviationPercent); });
  const PlotAxis   x = AxisFrom0(values.first, 6);
  const PlotAxis   y = AxisFrom0(signal, 8);
  const PlotAxis   below = AxisFrom0(deviation, 5);
  const PanelPlace place(x, { y, below });
  std::string      svg = OpenSvg(lowerTop + lowerHeight + AxisBelow, "linearity: signal against " + values.second);
  {
    SvgPanel panel(
      svg, { place.left, 26.0, place.width, PanelHeight }, x, y, "", "signal \u03BC_y \u2212 \u03BC_y.dark [DN]");
    if (report.linearitySlope.value && report.linearityOffset.value)
    {
      const auto line = [&](double at) { return *report.linearityOffset.value + *report.linearitySlope.value * at; };
      panel.Line({ 0.0, x.high }, { line(0.0), line(x.high) }, "third");
    }
    panel.Points(values.first, signal, "after", PlotMarker::Disc);
  }
  {
    SvgPanel panel(svg, { place.left, lowerTop, place.width, lowerHeight }, x, below, values.second, "deviation [%]");
    panel.Level(0.0, "zero");
    panel.Line(values.first, deviation, "after");
    panel.Points(values.first, deviation, "after", PlotMarker::Disc);
  }
  return svg;
}

} // namespace sensornoise
