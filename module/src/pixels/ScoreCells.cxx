// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "pixels/ScoreCells.h"

#include <vector>

namespace sensornoise
{

double
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

double
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
