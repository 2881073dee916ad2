// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_page_Figures_h
#define sensornoise_page_Figures_h

#include "SensorNoiseExport.h"
#include "sensornoise/Report.h"

#include <string>
#include <vector>

namespace sensornoise
{

/** \struct FigureData
 * \brief The numbers of a report's figures: points, line, band, residuals and series. Whoever draws adds axes only.
 */
struct FigureData
{
  /** Points of the noise curve, one a bin of levels; what is not finite is left out. */
  std::vector<double> mean;          ///< [DN]
  std::vector<double> variance;      ///< over time, as it is [DN^2]; NaN where it is not known
  std::vector<double> corrected;     ///< without flicker and motion [DN^2]
  std::vector<double> meanResiduals; ///< levels of the residuals [DN]; empty: there is no line
  /** Corrected variance less the line [1], in units of the error that normal noise gives a bin of so many pixels, and
   * of what their means' own noise moves it by. */
  std::vector<double> residuals;
  /** How much further the residuals of bins scatter at most, because neighbours share their noise [1]: as far where all
   * neighbours are in the same bin. What frames share is in the errors. */
  double residualSpread{ 1.0 };

  /** Variance slope and total intercept as a line, from the darkest to the brightest level; where they have no values,
   * the line through all levels; empty: none was fitted. */
  std::vector<double> lineMean;     ///< [DN]
  std::vector<double> lineVariance; ///< [DN^2]
  /** Ends of the line's 95 % interval, level by level [DN^2]; empty: its errors are not known. */
  std::vector<double> bandLow;
  std::vector<double> bandHigh;
  bool                isIndicative{ false }; ///< the line stands, but no gain: to be drawn dashed

  std::vector<double> flicker; ///< gamma_t of every frame [1]; empty: not known
  std::vector<double> motionX; ///< alpha_t of every frame [pixel]; empty: not known
  std::vector<double> motionY; ///< beta_t

  std::vector<NoiseCorrelationRecord::Lag> lags; ///< those in space, then those in time

  bool
  HasCurve() const
  {
    return !mean.empty();
  }
};

/** The figures of \a report, in one place for the page, the SVG file and other languages. */
SensorNoise_EXPORT FigureData
MakeFigureData(const Report & report);

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
