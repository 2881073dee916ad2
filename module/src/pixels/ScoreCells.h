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
    , m_Columns(std::clamp<std::size_t>(geometry.width / InPixels.leastScoreCell, 1, InPixels.mostScoreCells))
    , m_Rows(std::clamp<std::size_t>(geometry.height / InPixels.leastScoreCell, 1, InPixels.mostScoreCells))
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
SensorNoise_EXPORT double
WideningByCells(const VarianceFit & fit, const VarianceData & data, const FrameGeometry & geometry);

/** Returns the factor by which the variance of a slope is larger if the deviations of the cells are an excess [1]. What
 * moves adds variance, and never takes any: its mean over the cells is about as large as its scatter, and not smaller
 * by the root of the number of cells that matter. \a scores are the sums of the scores of the cells, \a squares is the
 * sum of the squared scores of the pixels. 1 up to InPattern.leastLikeness. */
SensorNoise_EXPORT double
WideningOfExcess(const std::vector<double> & scores, double squares);

} // namespace sensornoise

#endif
