// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "emva1288/SpatialVariance.h"

#include <numeric>

namespace sensornoise
{

namespace
{
/** Returns the mean square of the values about \a centre. */
double
MeanSquareAbout(const std::vector<double> & values, double centre)
{
  const double squares = std::accumulate(values.begin(), values.end(), 0.0, [centre](double sum, double value) {
    return sum + (value - centre) * (value - centre);
  });
  return squares / static_cast<double>(values.size());
}
} // namespace

EmvaSpatialVariance
MeasureSpatialVariance(const std::vector<double> & mean,
                       std::size_t                 columns,
                       std::size_t                 rows,
                       double                      stackDn2,
                       std::size_t                 frames)
{
  std::vector<double> ofColumns(columns, 0.0);
  std::vector<double> ofRows(rows, 0.0);
  for (std::size_t y = 0; y < rows; ++y)
  {
    for (std::size_t x = 0; x < columns; ++x)
    {
      const double value = mean[y * columns + x];
      ofColumns[x] += value / static_cast<double>(rows);
      ofRows[y] += value / static_cast<double>(columns);
    }
  }
  const auto          width = static_cast<double>(columns);
  const auto          height = static_cast<double>(rows);
  const double        centre = std::accumulate(ofRows.begin(), ofRows.end(), 0.0) / height;
  const double        noise = stackDn2 / static_cast<double>(frames); // of a pixel of the mean image
  EmvaSpatialVariance result;
  result.columns = columns;
  result.rows = rows;
  result.stackDn2 = stackDn2;
  result.measuredDn2 = MeanSquareAbout(mean, centre);
  result.totalDn2 = result.measuredDn2 - noise;
  result.columnMeanDn2 = MeanSquareAbout(ofColumns, centre) - noise / height;
  result.rowMeanDn2 = MeanSquareAbout(ofRows, centre) - noise / width;
  result.pixelDn2 = (result.totalDn2 - result.columnMeanDn2 - result.rowMeanDn2) / (1.0 - 1.0 / height - 1.0 / width);
  result.columnDn2 = result.columnMeanDn2 - result.pixelDn2 / height;
  result.rowDn2 = result.rowMeanDn2 - result.pixelDn2 / width;
  return result;
}

} // namespace sensornoise
