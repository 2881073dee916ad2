// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_pixels_FixedPatternEstimate_h
#define sensornoise_pixels_FixedPatternEstimate_h

#include "SensorNoiseExport.h"
#include "base/Constants.h"
#include "pixels/Constants.h"
#include "pixels/VarianceCurve.h"
#include "pixels/VarianceFit.h"
#include "pixels/VarianceLine.h"
#include "sensornoise/FrameGeometry.h"
#include "sensornoise/Parallel.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace sensornoise
{

struct ReferenceFrame;

/** Largest fraction of the variance of the levels that fixed-pattern noise can explain: gains (PRNU) and offsets (DSNU)
 * of the pixels.
 *
 * Levels that differ because of the illumination raise the variance by the gain. Levels that differ because of PRNU
 * raise it by twice the gain, and levels that differ because of DSNU do not raise it. A fraction s of the levels'
 * variance that is pattern therefore changes the slope by -s to +s of the gain. Patterns are measured where the scene
 * is flattest: elsewhere the differences from pixel to pixel are signal. Between parts of the sensor only steps are
 * identifiable. A pattern that repeats over long distances is not. */
struct FixedPatternEstimate
{
  double levelVarianceDn2{ 0.0 }; ///< weighted variance of the levels without the noise of their means [DN^2]
  /** Largest fraction of levelVarianceDn2 by a pattern of gain or efficiency, its error included [1]. */
  double gainFraction{ 0.0 };
  double offsetFraction{ 0.0 }; ///< largest fraction of levelVarianceDn2 by a pattern of offset, its error included [1]
  /** Covariance of the levels with the steps between parts of the sensor, over levelVarianceDn2, at most 1 [1]. It
   * changes the slope as the other fractions do, but neighbours have it in common. */
  double stepFraction{ 0.0 };

  /** Returns the largest variance of the pixels' offsets [DN^2]. */
  double
  OffsetVarianceDn2() const
  {
    return levelVarianceDn2 > 0.0 ? offsetFraction * levelVarianceDn2 : 0.0;
  }
  /** Returns the largest relative bias of the slope [1]. */
  double
  LargestFraction() const
  {
    return gainFraction > offsetFraction ? gainFraction : offsetFraction;
  }
};

/** Distance of the farthest pixels that DiagonalMean() uses [pixel]. */
inline constexpr std::size_t DiagonalReach = 2;

/** Returns the mean of the eight pixels that are one and two steps away on the diagonals [DN]. This estimate of the
 * signal is free of the pattern of the pixel, its row and its column. \a p is at least two pixels from the border. */
inline double
DiagonalMean(const double * mean, std::size_t width, std::size_t p)
{
  const double * at = mean + p;
  const auto     w = static_cast<std::ptrdiff_t>(width);
  return 0.125 * (at[-w - 1] + at[-w + 1] + at[w - 1] + at[w + 1] + at[-2 * w - 2] + at[-2 * w + 2] + at[2 * w - 2] +
                  at[2 * w + 2]);
}

/** Returns whether all pixels of DiagonalMean() are valid: the neighbours of a usable pixel are valid, so the pixels
 * one step away are tested. */
inline bool
HasDiagonals(const std::uint8_t * usable, std::size_t width, std::size_t p)
{
  const std::uint8_t * at = usable + p;
  const auto           w = static_cast<std::ptrdiff_t>(width);
  // Without branches, for SIMD instructions.
  return std::min(std::min(at[-w - 1], at[-w + 1]), std::min(at[w - 1], at[w + 1])) != 0;
}

/** Measures the pattern of the pixels of \a data, whose variance follows \a line. The gain pattern is relative to the
 * level above \a blackDn, the dark offset or a level that it is not below [DN]. The fractions are infinite if no tile
 * can be used or all levels are equal. */
SensorNoise_EXPORT FixedPatternEstimate
EstimateFixedPattern(const ReferenceFrame & frame,
                     const VarianceData &   data,
                     const VarianceLine &   line,
                     double                 blackDn,
                     const ParallelFor &    parallelFor);

/** Returns stepFraction of FixedPatternEstimate, at most 1, for the pixels of \a data, whose variance follows \a line
 * and whose levels vary by \a levelVarianceDn2. \a blackDn is as in EstimateFixedPattern().
 *
 * Amplifiers of unlike gain or offset make a step between two columns or rows, along the whole frame. No image of a
 * scene does: optics blur its edges over more than one pixel. A step counts if it is significant, twice as large as at
 * any other boundary, and has one sign along the boundary. Estimator.md, 3.7. */
SensorNoise_EXPORT double
FractionOfSensorSteps(const VarianceData &  data,
                      const FrameGeometry & geometry,
                      const VarianceLine &  line,
                      double                blackDn,
                      double                levelVarianceDn2,
                      const ParallelFor &   parallelFor);

/** Variance line by instrumental variables. */
struct InstrumentalFit
{
  VarianceLine line;                 ///< not determined if the instrument is weak
  double       instrumentDn{ 0.0 };  ///< <z> [DN]
  double       squaredScores{ 0.0 }; ///< sum of the squared scores of the slope
};

/** Fits the variance line by instrumental variables. The instrument of a pixel's mean x is z, the mean of its diagonal
 * neighbours:
 *
 *     gain = sum w (z - <z>) V / sum w (z - <z>) x.
 *
 * Only the signal is common to x and z. Gains, efficiencies and offsets that differ from pixel to pixel, row to row or
 * column to column do not bias this gain (see FixedPatternEstimate), and neither does the noise of the means. Detail as
 * fine as a pixel does not contribute, which costs precision. Weights and trimmed pixels are taken from \a fit. The
 * pivot is the weighted mean of x. The covariance is the sandwich estimate for independent pixels, see
 * WideningOfInstrumental(). The line is not determined if the instrument is weak, as where the signal of pixels differs
 * no more than the noise of their means. */
SensorNoise_EXPORT InstrumentalFit
FitInstrumental(const VarianceFit & fit, const VarianceData & data, const ReferenceFrame & frame);

/** Returns the factor by which the covariance of FitInstrumental() is larger where the deviations of pixels are alike
 * [1]. A pattern of columns or rows correlates the scores of their pixels: then whole columns or rows are independent.
 * So are the cells of the frame where objects twinkle. */
SensorNoise_EXPORT double
WideningOfInstrumental(const InstrumentalFit & instrumental,
                       const VarianceFit &     fit,
                       const VarianceData &    data,
                       const ReferenceFrame &  frame);

/** Returns the excess of the variance over \a line as a function of the intensity, of the pixels that \a fit keeps,
 * sorted by the instrument of FitInstrumental(). Patterns of pixels, rows and columns do not bend it: the mean of the
 * neighbours of a pixel, by which VarianceFit::CurveAbout() sorts, shares the offset of its column. */
SensorNoise_EXPORT VarianceCurve
CurveByInstrument(const VarianceLine &   line,
                  const VarianceFit &    fit,
                  const VarianceData &   data,
                  const ReferenceFrame & frame);

/** Returns whether the slope of \a line, of the pixels' own levels, contradicts the slope of FitInstrumental(). Then
 * levels of single pixels depend on more than the scene: a pixel with telegraph noise is both brighter and noisier.
 * \a dispersion is the factor of the variance of the errors [1]. Estimator.md, 3.7. */
inline bool
DoContradict(const VarianceLine & line, const VarianceLine & instrumental, double dispersion)
{
  const double error = std::sqrt(dispersion * std::max(0.0, instrumental.covariance(0, 0)));
  return std::abs(line.gain - instrumental.gain) > Significance.oneTest * error;
}

/** Returns the instrumental line, with settle(line) of its fit. It is determined where it may replace \a line: the
 * fixed pattern is not negligible, or the slopes contradict each other. */
SensorNoise_EXPORT VarianceLine
FindInstrumentalLine(const VarianceLine &                                      line,
                     const FixedPatternEstimate &                              pattern,
                     const VarianceFit &                                       fit,
                     const VarianceData &                                      data,
                     const ReferenceFrame &                                    frame,
                     const std::function<VarianceLine(const VarianceLine &)> & settle);

/** \class ScoreCells
 * \brief Cells of a frame, at most 24 x 24. The deviations from the variance line may be alike within a cell: an object
 * that twinkles, or moves by itself, has the same excess in all its pixels. */
class ScoreCells
{
public:
  explicit ScoreCells(const FrameGeometry & geometry)
    : m_Width(geometry.width)
    , m_Columns(std::clamp<std::size_t>(geometry.width / InCommon.leastCellWidth, 1, InCommon.mostCells))
    , m_Rows(std::clamp<std::size_t>(geometry.height / InCommon.leastCellWidth, 1, InCommon.mostCells))
    , m_PixelsAcross((geometry.width + m_Columns - 1) / m_Columns)
    , m_PixelsDown((geometry.height + m_Rows - 1) / m_Rows)
  {}

  std::size_t
  Count() const
  {
    return m_Columns * m_Rows;
  }
  /** Returns the cell of pixel \a p. */
  std::size_t
  Of(std::size_t p) const
  {
    return p / m_Width / m_PixelsDown * m_Columns + p % m_Width / m_PixelsAcross;
  }

private:
  std::size_t m_Width;
  std::size_t m_Columns;
  std::size_t m_Rows;
  std::size_t m_PixelsAcross;
  std::size_t m_PixelsDown;
};

/** Returns the factor by which the variance of the slope of \a fit is larger than for independent pixels [1]: the sum
 * over the cells of their squared sums of scores, over the sum of the squared scores (cluster-robust covariance, Liang
 * & Zeger 1986, DOI 10.1093/biomet/73.1.13). 1 up to InPattern.leastLikeness, which chance may reach. */
inline double
WideningByCells(const VarianceFit & fit, const VarianceData & data, const FrameGeometry & geometry)
{
  const ScoreCells     cells(geometry);
  const VarianceLine & line = fit.GetLine();
  // The sums of the scores of each cell, and last the sum of the squared scores of all pixels.
  const std::vector<double> sums =
    fit.SumWeighed(cells.Count() + 1, [&](std::size_t p, const VarianceFit::Weighed & weighed, double * own) {
      const double residual = weighed.value - line.intercept - line.gain * data.mean[p];
      const double score = weighed.weight * residual * (data.mean[p] - line.pivotDn);
      own[cells.Of(p)] += score;
      own[cells.Count()] += score * score;
    });
  double ofCells = 0.0;
  for (std::size_t c = 0; c < cells.Count(); ++c)
  {
    ofCells += sums[c] * sums[c];
  }
  return ofCells > InPattern.leastLikeness * sums.back() ? ofCells / sums.back() : 1.0;
}

/** Returns the factor by which the variance of a slope is larger if the deviations of the cells are an excess [1]. A
 * moving object adds variance and never reduces it. The mean of its variance over the cells is about as large as its
 * scatter, and not smaller by the root of the number of cells that contribute. \a scores are the sums of the scores of
 * the cells, \a squares is the sum of the squared scores of the pixels. 1 up to InPattern.leastLikeness. */
inline double
WideningOfExcess(const std::vector<double> & scores, double squares)
{
  double ofCells = 0.0;
  double fourth = 0.0;
  for (const double score : scores)
  {
    ofCells += score * score;
    fourth += score * score * score * score;
  }
  if (!(ofCells > InPattern.leastLikeness * squares))
  {
    return 1.0;
  }
  const double cells = ofCells * ofCells / fourth; // number of cells that matter
  return 1.0 + (ofCells / squares - 1.0) * cells;
}

} // namespace sensornoise

#endif
