// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "published/RowFlicker.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace sensornoise
{

namespace
{
/** Returns the Gaussian weights of (3.28) at the distances 0, 1, ... up to 4 sigma [rows]. */
std::vector<double>
RowKernel(double sigmaRows)
{
  std::vector<double> kernel(static_cast<std::size_t>(4.0 * sigmaRows) + 1);
  for (std::size_t d = 0; d < kernel.size(); ++d)
  {
    const double distance = static_cast<double>(d) / sigmaRows;
    kernel[d] = std::exp(-0.5 * distance * distance);
  }
  return kernel;
}

/** Returns the smoothed ratio of \a row in frame \a t, with \a leaveOut without the row itself. NaN: the rows within
 * reach have no weight. */
double
SmoothedRatio(const FlickerSums &         sums,
              const std::vector<double> & kernel,
              std::size_t                 t,
              std::size_t                 row,
              bool                        leaveOut)
{
  const std::size_t reach = kernel.size() - 1;
  const std::size_t first = row > reach ? row - reach : 0;
  const std::size_t last = std::min(sums.GetNumberOfRows() - 1, row + reach);
  double            sum = 0.0;
  double            weights = 0.0;
  for (std::size_t other = first; other <= last; ++other)
  {
    if (!(leaveOut && other == row))
    {
      const double weight = kernel[other > row ? other - row : row - other];
      sum += weight * sums.GetRowSum(t, other);
      weights += weight * sums.GetRowWeight(other);
    }
  }
  return weights > 0.0 ? sum / weights : std::numeric_limits<double>::quiet_NaN();
}

/** Returns the squared error of the prediction of each row's ratio from the other rows, weighted by the rows' weights
 * and summed over every \a stride th frame. An infinite \a sigmaRows predicts by the whole frame. */
double
CrossValidationError(const FlickerSums & sums, double sigmaRows, std::size_t stride)
{
  const bool                wholeFrame = std::isinf(sigmaRows);
  const std::vector<double> kernel = wholeFrame ? std::vector<double>() : RowKernel(sigmaRows);
  double                    error = 0.0;
  for (std::size_t t = 0; t < sums.GetNumberOfFrames(); t += stride)
  {
    double ratio = 0.0;
    for (std::size_t row = 0; row < sums.GetNumberOfRows(); ++row)
    {
      ratio += sums.GetRowSum(t, row);
    }
    for (std::size_t row = 0; row < sums.GetNumberOfRows(); ++row)
    {
      const double weight = sums.GetRowWeight(row);
      if (weight > 0.0 && weight < 1.0)
      {
        const double own = sums.GetRowSum(t, row);
        double predicted = wholeFrame ? (ratio - own) / (1.0 - weight) : SmoothedRatio(sums, kernel, t, row, true);
        if (std::isnan(predicted))
        {
          predicted = (ratio - own) / (1.0 - weight);
        }
        const double deviation = own / weight - predicted;
        error += weight * deviation * deviation;
      }
    }
  }
  return error;
}
} // namespace

double
ChooseSigmaRows(const FlickerSums & sums)
{
  constexpr double  infinity = std::numeric_limits<double>::infinity();
  constexpr double  gain = 0.99;
  const std::size_t stride = std::max<std::size_t>(1, sums.GetNumberOfFrames() / 16);
  const double      wholeFrame16 = CrossValidationError(sums, infinity, stride);
  double            best16 = infinity;
  for (const double sigma : { 4.0, 16.0, 64.0 })
  {
    best16 = std::min(best16, CrossValidationError(sums, sigma, stride));
  }
  if (!(best16 < gain * wholeFrame16))
  {
    return 0.0;
  }
  double error = gain * CrossValidationError(sums, infinity, 1);
  double chosen = 0.0;
  for (const double sigma : { 1.0, 1.5, 2.0, 3.0, 4.0, 6.0, 8.0, 12.0, 16.0, 24.0, 32.0, 50.0, 75.0, 100.0, 150.0 })
  {
    const double candidate = CrossValidationError(sums, sigma, 1);
    if (candidate < error)
    {
      error = candidate;
      chosen = sigma;
    }
  }
  return chosen;
}

RowRatios
SmoothRowRatios(const FlickerSums & sums, double sigmaRows)
{
  const std::size_t         rows = sums.GetNumberOfRows();
  const std::vector<double> kernel = RowKernel(sigmaRows);
  RowRatios                 result;
  result.sigmaRows = sigmaRows;
  result.ratio.assign(sums.GetNumberOfFrames() * rows, 1.0);
  result.known.assign(rows, 0);
  const auto reach = static_cast<std::size_t>(sigmaRows);
  for (std::size_t row = 0; row < rows; ++row)
  {
    const std::size_t last = std::min(rows - 1, row + reach);
    for (std::size_t other = row > reach ? row - reach : 0; other <= last; ++other)
    {
      if (sums.GetRowWeight(other) > 0.0)
      {
        result.known[row] = 1;
      }
    }
    for (std::size_t t = 0; t < sums.GetNumberOfFrames() && result.known[row] != 0; ++t)
    {
      result.ratio[t * rows + row] = SmoothedRatio(sums, kernel, t, row, false);
    }
  }
  return result;
}

} // namespace sensornoise
