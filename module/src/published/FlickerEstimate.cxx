// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "published/Flicker.h"


#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

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

double
Mean(const std::vector<double> & values)
{
  double sum = 0.0;
  for (const double value : values)
  {
    sum += value;
  }
  return sum / static_cast<double>(values.size());
}

double
SampleVariance(const std::vector<double> & values)
{
  const double mean = Mean(values);
  double       sum = 0.0;
  for (const double value : values)
  {
    sum += (value - mean) * (value - mean);
  }
  return sum / static_cast<double>(values.size() - 1);
}

namespace
{
/** Regression of v_* on v^*, which gives offsetDn = mu (3.16). */
struct OffsetLine
{
  double meanBright{ 0.0 }; ///< mean of v^* [1]
  double meanDark{ 0.0 };   ///< mean of v_* [DN]
  double sxx{ 0.0 };        ///< sum of squares of v^* about its mean [1]
  double slopeDn{ 0.0 };    ///< K, slope [DN]
  double offsetDn{ 0.0 };   ///< mu [DN]; 0 if isWild
  bool   isWild{ false };   ///< no significant flicker: v^* - 1 itself serves as gamma_t
};

OffsetLine
FitOffsetLine(const std::vector<double> & brightRatio,
              const std::vector<double> & darkResidualDn,
              double                      brightDn,
              double                      darkDn)
{
  OffsetLine line;
  line.meanBright = Mean(brightRatio);
  line.meanDark = Mean(darkResidualDn);
  double sxy = 0.0;
  for (std::size_t t = 0; t < brightRatio.size(); ++t)
  {
    const double dx = brightRatio[t] - line.meanBright;
    line.sxx += dx * dx;
    sxy += dx * (darkResidualDn[t] - line.meanDark);
  }
  line.slopeDn = line.sxx > 0.0 ? sxy / line.sxx : 0.0;
  const double contrast = brightDn - darkDn;
  line.offsetDn = line.slopeDn * brightDn / (line.slopeDn - contrast); // (3.16)
  line.isWild = !std::isfinite(line.offsetDn) || line.offsetDn >= brightDn;
  if (line.isWild)
  {
    line.offsetDn = 0.0;
  }
  return line;
}

/** Tests whether the flicker exceeds the noise, and whether v_* and v^* lie on one line. Sets flickerZ and
 * offsetLinePhi. */
void
TestFlicker(FlickerEstimate & estimate, const OffsetLine & line, const FlickerSums & sums, double darkDn)
{
  const std::size_t frames = estimate.brightRatio.size();
  const double      dof = static_cast<double>(frames - 1);
  const double      ratioVariance = line.sxx / dof;
  const double      noise = sums.GetBrightRatioNoise();
  estimate.flickerZ = !line.isWild && noise > 0.0           ? (ratioVariance / noise - 1.0) / std::sqrt(2.0 / dof)
                      : !line.isWild && ratioVariance > 0.0 ? std::numeric_limits<double>::infinity() // no noise
                                                            : 0.0;
  double residual = 0.0;
  for (std::size_t t = 0; t < frames; ++t)
  {
    const double deviation =
      estimate.darkResidualDn[t] - line.meanDark - line.slopeDn * (estimate.brightRatio[t] - line.meanBright);
    residual += deviation * deviation;
  }
  const double lever = darkDn + line.slopeDn; // the noise of v^* enters v_* and the abscissa
  const double expected = sums.GetDarkResidualNoiseDn2() + lever * lever * noise;
  estimate.offsetLinePhi = expected > 0.0 ? residual / (dof - 1.0) / expected : 1.0;
}

/** Sets gamma_t(y) with the width estimate.sigmaRows, and the root mean square of the flicker over the known rows. */
void
EstimateRows(FlickerEstimate & estimate, const FlickerSums & sums, double gammaPerRatio)
{
  RowRatios ratios = SmoothRowRatios(sums, estimate.sigmaRows);
  estimate.rows = sums.GetNumberOfRows();
  estimate.rowKnown = std::move(ratios.known);
  estimate.gammaRows = std::move(ratios.ratio);
  for (double & value : estimate.gammaRows)
  {
    value = (value - 1.0) * gammaPerRatio;
  }
  double      total = 0.0;
  std::size_t known = 0;
  for (std::size_t row = 0; row < estimate.rows; ++row)
  {
    if (estimate.IsKnown(row))
    {
      std::vector<double> series;
      for (std::size_t t = 0; t < sums.GetNumberOfFrames(); ++t)
      {
        series.push_back(estimate.Gamma(t, row));
      }
      total += SampleVariance(series);
      ++known;
    }
  }
  estimate.flickerSd = std::sqrt(total / static_cast<double>(known));
}
} // namespace

FlickerEstimate
EstimateFlicker(const FlickerSums &     sums,
                const IsoIntensitySet & bright,
                const IsoIntensitySet & dark,
                RollingShutter          mode,
                double                  sigmaRows)
{
  const std::size_t frames = sums.GetNumberOfFrames();
  FlickerEstimate   estimate;
  for (std::size_t t = 0; t < frames; ++t)
  {
    estimate.brightRatio.push_back(sums.GetBrightRatio(t));
    estimate.darkResidualDn.push_back(sums.GetDarkResidualDn(t));
  }
  const OffsetLine line = FitOffsetLine(estimate.brightRatio, estimate.darkResidualDn, bright.levelDn, dark.levelDn);
  estimate.slopeDn = line.slopeDn;
  estimate.offsetDn = line.offsetDn;

  const double gammaPerRatio = 1.0 + estimate.offsetDn / (bright.levelDn - estimate.offsetDn); // (3.17)
  for (std::size_t t = 0; t < frames; ++t)
  {
    estimate.gamma.push_back((estimate.brightRatio[t] - 1.0) * gammaPerRatio);
  }
  estimate.flickerSd = std::sqrt(SampleVariance(estimate.gamma));
  TestFlicker(estimate, line, sums, dark.levelDn);

  if (mode != RollingShutter::Off && sums.GetNumberOfRows() > 1)
  {
    estimate.sigmaRows = mode == RollingShutter::Fixed ? sigmaRows : ChooseSigmaRows(sums);
  }
  if (estimate.sigmaRows > 0.0)
  {
    EstimateRows(estimate, sums, gammaPerRatio);
  }
  return estimate;
}

} // namespace sensornoise
