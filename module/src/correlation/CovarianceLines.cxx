// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "correlation/CovarianceLines.h"

#include "base/Eigen.h"

#include <cmath>
#include <cstddef>

namespace sensornoise
{

namespace
{
/** Returns the slope of the covariance along the signal, and its value at zero signal. Both are divided by the variance
 * in the sums, so that the bins have equal weight. */
Eigen::Vector2d
FitLineOf(const LagSums & sums)
{
  constexpr auto  bins = static_cast<Eigen::Index>(NoiseResiduals::IntensityBins);
  Eigen::MatrixXd design = Eigen::MatrixXd::Zero(bins, 2);
  Eigen::VectorXd values = Eigen::VectorXd::Zero(bins);
  for (Eigen::Index b = 0; b < bins; ++b)
  {
    const PairSums & bin = sums.bins[static_cast<std::size_t>(b)];
    if (bin.pairs > 0.0)
    {
      const double scale = 1.0 / std::sqrt(bin.pairs);
      design.row(b) << scale * bin.light, scale * bin.constant;
      values(b) = scale * bin.covariance;
    }
  }
  return design.completeOrthogonalDecomposition().solve(values);
}
} // namespace

std::vector<CovarianceLine>
FitCovarianceLines(const CorrelationSums & sums, const CorrelationSums::Lags & lags)
{
  CorrelationSums::Lags all{ 0 };
  all.insert(all.end(), lags.begin(), lags.end());
  const double                blackDn = sums.GetResiduals().GetBlackDn();
  const JackknifeEstimate     lines = Jackknife(sums.GetTiles(), [&](const TileSums & tiles) {
    const CommonNoise common = FindCommonNoise(tiles.shared);
    Eigen::VectorXd   numbers(2 * static_cast<Eigen::Index>(all.size()));
    Eigen::Index      k = 0;
    for (const std::size_t lag : all)
    {
      const Eigen::Vector2d line =
        FitLineOf(lag == 0 ? tiles.lags[0] : common.TakeOff(tiles.lags[lag], sums.GetLag(lag)));
      numbers.segment<2>(k) << line(0), line(1) - line(0) * blackDn;
      k += 2;
    }
    return numbers;
  });
  std::vector<CovarianceLine> found;
  for (Eigen::Index k = 0; k < lines.value.size(); k += 2)
  {
    found.push_back({ sums.GetLag(all[static_cast<std::size_t>(k / 2)]),
                      { lines.value(k), lines.StandardError(k) },
                      { lines.value(k + 1), lines.StandardError(k + 1) } });
  }
  return found;
}

} // namespace sensornoise
