// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_correlation_Jackknife_h
#define sensornoise_correlation_Jackknife_h

#include "base/Eigen.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace sensornoise
{

/** Figures and their covariance. */
struct JackknifeEstimate
{
  Eigen::VectorXd value;
  Eigen::MatrixXd covariance;

  double
  StandardError(Eigen::Index k) const
  {
    return std::sqrt(std::max(0.0, covariance(k, k)));
  }
};

/** Figures of sums over blocks, and their errors from leaving out one block at a time (Tukey 1958): right for sums over
 * pairs that share pixels, where a formula for independent noise is several times too small. \a figuresOf makes a
 * vector of the sums. */
template <typename TSums, typename TFunction>
JackknifeEstimate
Jackknife(const std::vector<TSums> & blocks, TFunction figuresOf)
{
  const auto sumWithout = [&blocks](std::size_t left) {
    TSums sum{};
    for (std::size_t i = 0; i < blocks.size(); ++i)
    {
      if (i != left)
      {
        sum += blocks[i];
      }
    }
    return sum;
  };
  const auto        count = static_cast<Eigen::Index>(blocks.size());
  JackknifeEstimate estimate;
  estimate.value = figuresOf(sumWithout(blocks.size()));
  Eigen::MatrixXd left(estimate.value.size(), count);
  for (Eigen::Index i = 0; i < count; ++i)
  {
    left.col(i) = figuresOf(sumWithout(static_cast<std::size_t>(i)));
  }
  left.colwise() -= Eigen::VectorXd(left.rowwise().mean());
  estimate.covariance = (left * left.transpose()) * (static_cast<double>(count - 1) / static_cast<double>(count));
  return estimate;
}

} // namespace sensornoise

#endif
