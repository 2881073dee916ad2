// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_page_Figures_h
#define sensornoise_page_Figures_h

#include "SensorNoiseExport.h"
#include "sensornoise/Report.h"

#include <initializer_list>
#include <string>
#include <vector>

namespace sensornoise
{

/** Axis of a plot: its range and the ticks inside it. */
struct PlotAxis
{
  double              low{ 0.0 };
  double              high{ 1.0 };
  std::vector<double> ticks;
  int                 decimals{ 0 }; ///< decimal places of the labels of the ticks
  bool isLogarithmic{ false };       ///< range and ticks are decimal logarithms of the numbers, which are the labels

  /** Returns the label of a tick. It has three significant digits if the axis has more than 5 decimals, or numbers from
   * 1e7 on. */
  std::string
  LabelOf(double tick) const;

  /** Returns the width of the widest label in a font with wide digits [units of the figure]. */
  double
  LabelWidth() const;
};

/** Returns the axis over [\a low, \a high] with a margin of 4 % on each side. The ticks are multiples of 1, 2 or 5
 * times a power of ten, at most \a mostTicks + 1 and at most 20. If an end is not finite or is beyond 1e300, the ends
 * are 0 and 1. Ends that are almost equal are each moved by half their magnitude. */
PlotAxis
MakeAxis(double low, double high, int mostTicks);

/** Returns the logarithmic axis over [\a low, \a high], which are decimal logarithms, with a margin of 4 % on each
 * side. The ticks are 1, 1.5, 2, 3, 4, 5 and 7 times a power of ten; where these are more than 8, they are 1, 2 and 5
 * times, then 1 and 3 times, then powers alone, at most 20. Where fewer than two are in the range, the ticks are the
 * ticks of MakeAxis(), by which the ends are treated, too. */
PlotAxis
MakeLogarithmicAxis(double low, double high);

/** Range of the finite numbers that were added. */
class FiniteRange
{
public:
  void
  Add(const std::vector<double> & values);
  void
  Add(double value);
  /** Returns the axis over the range, by MakeAxis(). Without numbers it is a narrow range about 0. */
  PlotAxis
  Axis(int mostTicks) const;
  /** Returns the axis over the range by MakeLogarithmicAxis(). The numbers are decimal logarithms. */
  PlotAxis
  LogarithmicAxis() const;

private:
  double m_Low{ 0.0 };
  double m_High{ 0.0 };
  bool   m_IsEmpty{ true };
};

/** Returns a number for an attribute of SVG, with one decimal place and a decimal point in any locale. */
std::string
SvgNumber(double number);

/** Style of the figures, with light and dark colours after Okabe and Ito, which people without colour vision can
 * distinguish. Shapes and dashes distinguish the series as well. The colours are literals, because some viewers of SVG
 * files do not support variables. */
inline constexpr const char * FigureStyle = R"(
svg text{fill:#1b1f24;font:14px system-ui,sans-serif}
svg .paper{fill:#fff}
svg .frame{fill:none;stroke:#57606a}
svg .grid{fill:none;stroke:#d8dee4}
svg .line{fill:none;stroke-width:1.8}
svg .point{fill:none;stroke-width:1.2}
svg .before{stroke:#b85c00}
svg .after{stroke:#0072b2}
svg .third{stroke:#00795a}
svg .zero{stroke:#57606a;stroke-width:1}
svg .after.full,svg .after.band,svg .bar{fill:#0072b2}
svg .third.band{fill:#00795a}
svg .band{stroke:none;opacity:.22}
svg .error{fill:none;stroke:#1b1f24;stroke-width:1.4}
svg .dashed{stroke-dasharray:7 5}
@media(prefers-color-scheme:dark){
svg text{fill:#e6edf3}
svg .paper{fill:#0d1117}
svg .frame,svg .zero{stroke:#a3adb8}
svg .grid{stroke:#2a313a}
svg .before{stroke:#e69f00}
svg .after{stroke:#56b4e9}
svg .third{stroke:#2fc79a}
svg .band{stroke:none}
svg .after.full,svg .after.band,svg .bar{fill:#56b4e9}
svg .third.band{fill:#2fc79a}
svg .error{stroke:#e6edf3}
}
)";

/** Width of every figure [units of its viewBox]. Text stays legible on a telephone that shows the figure 350 pixels
 * wide. */
inline constexpr double FigureWidth = 480.0;

/** Returns the opening tag of a figure. \a height: in units of the figure. \a label: description for readers who do not
 * see it. */
std::string
OpenSvg(double height, const std::string & label);

/** Returns a \a figure of a page as an SVG file, in light or dark colours as its viewer prefers. \a title: result in
 * words. */
std::string
AsSvgFile(std::string figure, const std::string & title);

enum class PlotMarker
{
  Disc,
  Ring,
  Square
};

/** \class SvgPanel
 * \brief Draws into one rectangle of an SVG figure, in the coordinates of its axes. Points that are not finite are left
 * out of points and lines, and content outside of the rectangle is clipped. A \a style is a class of FigureStyle. */
class SvgPanel
{
public:
  struct Box
  {
    double left;
    double top;
    double width;
    double height;
  };

  /** Appends the axes to \a svg, with their ticks and names, and opens the rectangle. With an empty \a xName the ticks
   * of x have no labels. \a svg must outlive the panel. */
  SvgPanel(std::string &       svg,
           const Box &         box,
           PlotAxis            x,
           PlotAxis            y,
           const std::string & xName,
           const std::string & yName);
  SvgPanel(const SvgPanel &) = delete;
  SvgPanel &
  operator=(const SvgPanel &) = delete;
  /** Closes the rectangle. */
  ~SvgPanel();

  /** Draws a marker at each point. */
  void
  Points(const std::vector<double> & x, const std::vector<double> & y, const char * style, PlotMarker marker);
  /** Draws a line through the points, with a gap at each point that is not finite. */
  void
  Line(const std::vector<double> & x, const std::vector<double> & y, const char * style);
  /** Fills the area between two lines. The numbers must be finite. */
  void
  Band(const std::vector<double> & x,
       const std::vector<double> & low,
       const std::vector<double> & high,
       const char *                style);
  /** Draws a horizontal line across the rectangle at \a y. */
  void
  Level(double y, const char * style);

  /** Returns the distance of \a x from the left edge of the rectangle [units of the figure]. */
  double
  X(double x) const;
  /** Returns the distance of \a y from the upper edge, within 10 heights above and below the rectangle [units of the
   * figure]. */
  double
  Y(double y) const;

private:
  void
  DrawAxes(const std::string & xName, const std::string & yName);

  std::string & m_Svg;
  Box           m_Box;
  PlotAxis      m_X;
  PlotAxis      m_Y;
};

/** \struct FigureData
 * \brief Numbers of the figures of a report: points, line, band, residuals and series. A plot adds only the axes. */
struct FigureData
{
  /** Points of the noise curve, one for each intensity bin. Bins whose mean or corrected variance is not finite are
   * left out. */
  std::vector<double> mean;          ///< temporal mean [DN]
  std::vector<double> variance;      ///< temporal variance as measured [DN^2]; NaN: not known
  std::vector<double> corrected;     ///< temporal variance without flicker and motion [DN^2]
  std::vector<double> meanResiduals; ///< means of the points with a residual [DN]; empty: no line, or no errors
  /** Residuals [1]: corrected variance minus line, over the standard error of the point. The standard error is computed
   * for the mean variance of the pixels of the bin, with excess kurtosis and temporal noise correlation. It includes
   * the noise of the pixel means that decide on the bin. For level sets it is the error of the variance of their detail
   * coefficients. */
  std::vector<double> residuals;
  /** Largest factor by which the spatial noise correlation widens the standard deviation of the residuals [1]. It holds
   * if all neighbours of a pixel are in the same bin. The standard errors include the temporal correlation only. */
  double residualSpread{ 1.0 };

  /** Line through variance slope and total intercept, from the darkest to the brightest point. If these have no values,
   * it is the line of the fit. Empty: no line was fitted. */
  std::vector<double> lineMean;     ///< mean [DN]
  std::vector<double> lineVariance; ///< variance [DN^2]
  /** Lower bounds of the 95 % interval of the line, one for each point of the line [DN^2]. Empty: the line is
   * indicative, or its errors are not known. */
  std::vector<double> bandLow;
  /** Upper bounds, as bandLow [DN^2]. */
  std::vector<double> bandHigh;
  bool                isIndicative{ false }; ///< whether there is a line but no gain; a plot dashes the line
  /** Whether the points are level sets of single frames. Their variance has no flicker and motion: corrected equals
   * variance. */
  bool isOfLevelSets{ false };

  std::vector<double> flicker; ///< gamma_t of each frame, the illumination factor minus 1 [1]; empty: not known
  std::vector<double> motionX; ///< motion alpha_t of each frame along x [pixel]; empty: not known
  std::vector<double> motionY; ///< motion beta_t of each frame along y [pixel]; empty: not known

  std::vector<NoiseCorrelationRecord::Lag> lags; ///< noise correlation by lag: spatial lags, then temporal lags

  bool
  HasCurve() const
  {
    return !mean.empty();
  }
};

/** Returns the numbers of the figures of \a report. The page, the SVG file and other languages draw them. */
SensorNoise_EXPORT FigureData
MakeFigureData(const Report & report);

/** Returns the noise curve as an SVG element for a page with FigureStyle: variance against mean, as measured and
 * corrected, with the line and its band. The residuals are below it. Without data, the figures are a sentence in an
 * HTML paragraph. */
std::string
CurveFigure(const FigureData & data);

/** Returns flicker and motion against the frame, in the form of CurveFigure(). A series that is not known is left out.
 */
std::string
SeriesFigure(const FigureData & data);

/** Returns the noise correlation by lag, in the form of CurveFigure(): at most 16 bars with ± 2 standard errors. */
std::string
CorrelationFigure(const FigureData & data);

/** Returns the noise curve as an SVG file, in light or dark colours as its viewer prefers. \a title: result in words.
 */
SensorNoise_EXPORT std::string
CurveAsSvgFile(const FigureData & data, const std::string & title);

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
