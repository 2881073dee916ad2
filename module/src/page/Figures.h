// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_page_Figures_h
#define sensornoise_page_Figures_h

#include "SensorNoiseExport.h"
#include "sensornoise/Report.h"
#include "page/SvgPanel.h"

#include <initializer_list>
#include <string>
#include <vector>

namespace sensornoise
{

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
   * the noise of the pixel means that decide on the bin. */
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
