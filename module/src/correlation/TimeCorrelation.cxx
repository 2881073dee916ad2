// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "correlation/TimeCorrelation.h"

#include "base/Eigen.h"
#include "base/Significance.h"
#include "correlation/Constants.h"
#include "correlation/TemporalMixing.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace sensornoise
{

bool
IsCorrelatedInTime(const std::vector<LagCoefficient> & coefficients)
{
  return std::any_of(coefficients.begin(), coefficients.end(), [](const LagCoefficient & lag) {
    return lag.coefficient.Exceeds(InCorrelation.leastTimeCoefficient, Significance.severalTests);
  });
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
  // The error includes the lags beyond, for a tail that continues to decrease as before.
  found.timeFactor.standardError = std::hypot(found.timeFactor.standardError, 2.0 * last);
}

} // namespace sensornoise
