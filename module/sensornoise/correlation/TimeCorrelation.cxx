// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/correlation/TimeCorrelation.h"

#include "sensornoise/base/Eigen.h"
#include "sensornoise/correlation/Constants.h"
#include "sensornoise/correlation/SharedShapes.h"
#include "sensornoise/correlation/TemporalMixing.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace sensornoise
{

bool
SharesInTime(const CorrelationSums & sums, const std::vector<LagCoefficient> & coefficients)
{
  const bool isLarge = std::any_of(coefficients.begin(), coefficients.end(), [](const LagCoefficient & lag) {
    return lag.coefficient.Exceeds(InCorrelation.leastTimeCoefficient, InCorrelation.timeZ);
  });
  if (!isLarge)
  {
    return false;
  }
  const TileSums              all = sums.Total();
  const CorrelationSums::Lags next{ sums.TimeLags().front() };
  const auto                  fits =
    FitShapes(sums.ShapesOf(all, sums.GetCodesDn2()).InBins(), sums.SharedInBins(all, next), sums.ErrorsInBins(next));
  return fits[static_cast<std::size_t>(ShapeOfShared::Constant)].chi2 + InCorrelation.evidenceOfDrift >
         fits[static_cast<std::size_t>(ShapeOfShared::Variance)].chi2;
}

void
SumOverTime(CorrelationSums & sums, NoiseCorrelation & found)
{
  found.kind = NoiseKind::Temporal;
  const Eigen::MatrixXd & basis = sums.GetResiduals().GetBasis();
  double                  last = 1.0;
  for (std::size_t known = 0; last > InCorrelation.smallTimeCoefficient && sums.TimeLags().size() > known;)
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
    if (last > InCorrelation.smallTimeCoefficient)
    {
      sums.AddTimeLags(std::min(static_cast<int>(known) + 2, InCorrelation.mostTimeLags));
    }
  }
  // What is beyond: a tail that falls off as before. What all pixels have in common: the series that are projected out
  // have noise of their own, which knows that of the frames.
  const double projected = static_cast<double>(basis.cols()) / static_cast<double>(basis.rows());
  const double ofMixing = InCorrelation.errorOfMixing * projected * projected * std::abs(found.timeFactor.value - 1.0);
  found.timeFactor.standardError = std::hypot(found.timeFactor.standardError, 2.0 * last, ofMixing);
}

} // namespace sensornoise
