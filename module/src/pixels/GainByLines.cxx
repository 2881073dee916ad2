// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "pixels/GainByLines.h"

#include "base/Constants.h"
#include "base/RegressionSums.h"
#include "pixels/Constants.h"
#include "sensornoise/StepResults.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

namespace sensornoise
{

namespace
{
/** Sums over the pixels of one half of a line: regression of the excess of the variance on the fraction of shot noise.
 */
using HalfSums = std::array<RegressionSums, 2>;

/** Sums of all columns and of some rows. */
struct SumsOfLines
{
  std::vector<HalfSums> columns;
  std::vector<HalfSums> rows;
};

/** Adds the pixels of the rows from \a top to \a end - 1. */
SumsOfLines
SumRows(const VarianceData &  data,
        const FrameGeometry & geometry,
        const PartReference & reference,
        std::size_t           top,
        std::size_t           end)
{
  const VarianceLine & line = reference.line;
  SumsOfLines          sums{ std::vector<HalfSums>(geometry.width), std::vector<HalfSums>(end - top) };
  for (std::size_t y = top; y < end; ++y)
  {
    const std::size_t vertical = 2 * y < geometry.height ? 0 : 1;
    for (std::size_t x = 0; x < geometry.width; ++x)
    {
      const std::size_t p = y * geometry.width + x;
      const double      expected = line.At(data.mean[p]);
      const double      variance = data.mask[p] != 0 ? data.variance[p] : 0.0;
      if (data.mask[p] != 0 && expected > 0.0 && variance < InParts.largestRatio * expected)
      {
        const double shot = std::clamp(line.gain * (data.mean[p] - reference.blackDn) / expected, 0.0, 1.0);
        const double weight = expected * expected / line.SamplingVariance(data.dof[p], expected);
        const auto   own = RegressionSums::Of(weight / reference.varianceInflation, shot, variance / expected - 1.0);
        sums.columns[x][vertical] += own;
        sums.rows[y - top][2 * x < geometry.width ? 0 : 1] += own;
      }
    }
  }
  return sums;
}

/** Excess of the gain of one half of a line, and its precision: 0 where there are no pixels. */
struct HalfExcess
{
  double value{ 0.0 };     ///< [1]
  double precision{ 0.0 }; ///< reciprocal of the variance [1]
};

/** Solves excess = s d + (1 - s) h for d, with the priors of the coefficients. */
HalfExcess
ExcessOfGain(const RegressionSums & sums)
{
  const double prior = 1.0 / (InParts.priorOfParts * InParts.priorOfParts);
  const double dd = sums.xx + prior;
  const double dh = sums.x - sums.xx;
  const double hh = sums.w - 2.0 * sums.x + sums.xx + prior;
  const double determinant = dd * hh - dh * dh;
  return { (hh * sums.xy - dh * (sums.y - sums.xy)) / determinant, std::max(0.0, determinant / hh - prior) };
}

/** Returns the excess of each line over the mean of the lines around it, over the side of a tile. */
std::vector<HalfExcess>
OverSurroundings(const std::vector<HalfSums> & sums, std::size_t half)
{
  std::vector<HalfExcess> all;
  std::transform(sums.begin(), sums.end(), std::back_inserter(all), [half](const HalfSums & own) {
    return ExcessOfGain(own[half]);
  });
  const std::size_t       reach = InPixels.tileSide / 2;
  std::vector<HalfExcess> found;
  for (std::size_t k = 0; k < all.size(); ++k)
  {
    double weight = 0.0;
    double sum = 0.0;
    for (std::size_t j = k - std::min(k, reach); j < std::min(all.size(), k + reach + 1); ++j)
    {
      weight += all[j].precision;
      sum += all[j].precision * all[j].value;
    }
    found.push_back({ weight > 0.0 ? all[k].value - sum / weight : 0.0, all[k].precision });
  }
  return found;
}

/** Covariance of the first halves of lines with the second halves of the lines that follow by \a lag, and its variance
 * by chance. */
MeasuredNumber
CovarianceOfHalves(const std::array<std::vector<HalfExcess>, 2> & halves, std::size_t lag)
{
  double weight = 0.0;
  double sum = 0.0;
  for (std::size_t k = 0; k + lag < halves[0].size(); ++k)
  {
    for (const std::size_t first : { 0, 1 })
    {
      const HalfExcess & a = halves[first][k];
      const HalfExcess & b = halves[1 - first][k + lag];
      weight += a.precision * b.precision;
      sum += a.precision * b.precision * a.value * b.value;
    }
  }
  // At lag 0 every product counts twice.
  return { weight > 0.0 ? sum / weight : 0.0, weight > 0.0 ? std::sqrt((lag == 0 ? 2.0 : 1.0) / weight) : 0.0 };
}

/** Returns the period of the lines, the least lag at which their covariance is nearly the variance \a square and larger
 * than beside it; 0: there is none. */
std::size_t
PeriodOf(const std::array<std::vector<HalfExcess>, 2> & halves, double square)
{
  const std::size_t   longest = InPixels.tileSide;
  std::vector<double> covariances;
  for (std::size_t lag = 0; lag <= longest + 1; ++lag)
  {
    covariances.push_back(CovarianceOfHalves(halves, lag).value);
  }
  for (std::size_t lag = 2; lag <= longest; ++lag)
  {
    if (covariances[lag] > (1.0 - InParts.largestSpread) * square && covariances[lag] > covariances[lag - 1] &&
        covariances[lag] >= covariances[lag + 1])
    {
      return lag;
    }
  }
  return 0;
}

GainByLines
Compare(const std::vector<HalfSums> & sums)
{
  const std::array<std::vector<HalfExcess>, 2> halves{ OverSurroundings(sums, 0), OverSurroundings(sums, 1) };
  const MeasuredNumber                         square = CovarianceOfHalves(halves, 0);
  GainByLines                                  found;
  if (!(square.value > 0.0 && square.standardError > 0.0))
  {
    return found;
  }
  found.size = std::sqrt(square.value);
  found.z = square.value / square.standardError;
  if (!found.Differ())
  {
    return found;
  }
  const std::size_t period = PeriodOf(halves, square.value);
  for (std::size_t phase = 0; phase < period; ++phase)
  {
    double weight = 0.0;
    double sum = 0.0;
    for (const std::vector<HalfExcess> & half : halves)
    {
      for (std::size_t k = phase; k < half.size(); k += period)
      {
        weight += half[k].precision;
        sum += half[k].precision * half[k].value;
      }
    }
    found.excess.push_back(weight > 0.0 ? sum / weight : 0.0);
    found.error = std::max(found.error, weight > 0.0 ? 1.0 / std::sqrt(weight) : 0.0);
  }
  return found;
}
} // namespace

bool
GainByLines::Differ() const
{
  return DoGainsDiffer(size, z);
}

LinesOfSensor
CompareLines(const VarianceData &  data,
             const FrameGeometry & geometry,
             const PartReference & reference,
             const ParallelFor &   parallelFor)
{
  // The number of strips, and so the order of the sums, does not depend on the number of threads.
  const std::size_t        strips = std::min(geometry.height, InParts.mostTiles);
  std::vector<SumsOfLines> sums(strips);
  const auto               topOf = [&](std::size_t strip) { return strip * geometry.height / strips; };
  parallelFor(strips, [&](std::size_t strip) {
    sums[strip] = SumRows(data, geometry, reference, topOf(strip), topOf(strip + 1));
  });
  SumsOfLines all{ std::vector<HalfSums>(geometry.width), {} };
  for (const SumsOfLines & own : sums)
  {
    for (std::size_t x = 0; x < geometry.width; ++x)
    {
      all.columns[x][0] += own.columns[x][0];
      all.columns[x][1] += own.columns[x][1];
    }
    all.rows.insert(all.rows.end(), own.rows.begin(), own.rows.end());
  }
  return { Compare(all.columns), Compare(all.rows) };
}

} // namespace sensornoise
