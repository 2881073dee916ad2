// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/correlation/TimeCorrelation.h"

#include "sensornoise/base/Eigen.h"
#include "sensornoise/correlation/SharedShapes.h"
#include "sensornoise/correlation/TemporalMixing.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace sensornoise
{

namespace
{
/** Coefficient that is worth a word [1]. Set by hand: slow drifts of a few pixels make 0.003 of it. */
constexpr double LeastTimeCoefficient = 0.01;
/** Standard errors by which a coefficient must exceed it [1]. */
constexpr double TimeZ = 4.0;
/** Difference of chi-squares by which a drift must fit better than a filter [1]. */
constexpr double EvidenceOfDrift = 2.0;
/** Coefficient of the last two lags at which the sum ends [1], and the lags that it may have at most [frames]: three
 * quarters of the last frame are forgotten after 20. */
constexpr double SmallCoefficient = 0.005;
constexpr int    MostLags = 24;
/** Error of the sum over frames per square of the part of the frames' freedom that is projected out [1]. Set by hand:
 * filters of 0.2 to 0.6 of the last frame, 50 frames, 10 to 18 series; half covers 80 %, twice 99 %. */
constexpr double ErrorOfMixing = 0.25;
} // namespace

bool
SharesInTime(const CorrelationSums & sums, const std::vector<LagCoefficient> & coefficients)
{
  const bool isLarge = std::any_of(coefficients.begin(), coefficients.end(), [](const LagCoefficient & lag) {
    return lag.coefficient.Exceeds(LeastTimeCoefficient, TimeZ);
  });
  if (!isLarge)
  {
    return false;
  }
  const TileSums              all = sums.Total();
  const CorrelationSums::Lags next{ sums.TimeLags().front() };
  const auto                  fits =
    FitShapes(PredictShapes(all.lags[0], sums.GetCodesDn2()), sums.SharedInBins(all, next), sums.ErrorsInBins(next));
  return fits[static_cast<std::size_t>(ShapeOfShared::Constant)].chi2 + EvidenceOfDrift >
         fits[static_cast<std::size_t>(ShapeOfShared::Variance)].chi2;
}

void
SumOverTime(CorrelationSums & sums, NoiseCorrelation & found)
{
  found.kind = NoiseKind::Temporal;
  const Eigen::MatrixXd & basis = sums.GetResiduals().GetBasis();
  double                  last = 1.0;
  for (std::size_t known = 0; last > SmallCoefficient && sums.TimeLags().size() > known;)
  {
    known = sums.TimeLags().size();
    const Eigen::MatrixXd   mixing = TemporalMixing(basis, known);
    const JackknifeEstimate estimate = Jackknife(sums.GetTiles(), [&](const TileSums & tiles) {
      const Eigen::VectorXd covariance = sums.Autocovariance(tiles, mixing);
      return Eigen::VectorXd(Eigen::Vector2d(2.0 * covariance.sum() - covariance(0),
                                             covariance.tail(2).cwiseAbs().maxCoeff() / covariance(0)));
    });
    found.timeFactor = { estimate.value(0), estimate.StandardError(0) };
    last = estimate.value(1);
    if (last > SmallCoefficient)
    {
      sums.AddTimeLags(std::min(static_cast<int>(known) + 2, MostLags));
    }
  }
  // What is beyond: a tail that falls off as before. What all pixels have in common: the series that are projected out
  // have noise of their own, which knows that of the frames.
  const double projected = static_cast<double>(basis.cols()) / static_cast<double>(basis.rows());
  const double ofMixing = ErrorOfMixing * projected * projected * std::abs(found.timeFactor.value - 1.0);
  found.timeFactor.standardError = std::hypot(found.timeFactor.standardError, 2.0 * last, ofMixing);
}

} // namespace sensornoise
