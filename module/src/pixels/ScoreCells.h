// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_pixels_ScoreCells_h
#define sensornoise_pixels_ScoreCells_h

#include "sensornoise/FrameGeometry.h"
#include "pixels/Constants.h"
#include "pixels/VarianceFit.h"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace sensornoise
{

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
