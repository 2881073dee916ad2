// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_base_Jackknife_h
#define sensornoise_base_Jackknife_h

#include "base/Eigen.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace sensornoise
{

/** Estimated values and their covariance. */
struct JackknifeEstimate
{
  Eigen::VectorXd value;
  Eigen::MatrixXd covariance;

  double
  StandardError(Eigen::Index k) const
  {
    return std::sqrt(std::max(0.0, covariance(k, k)));
  }
  Eigen::VectorXd
  StandardErrors() const
  {
    return covariance.diagonal().cwiseMax(0.0).cwiseSqrt();
  }
};

/** Returns the values that \a figuresOf computes from the sums over all blocks, and their covariance. The covariance is
 * found by leaving out one block at a time (Tukey 1958). It is right for sums over pairs that have pixels in common,
 * where a formula for independent noise gives errors several times too small. Fewer than two blocks determine
 * no covariance: it is infinite. \a figuresOf maps sums to an Eigen::VectorXd. */
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
  if (count < 2)
  {
    const double infinity = std::numeric_limits<double>::infinity();
    estimate.covariance = Eigen::MatrixXd::Constant(estimate.value.size(), estimate.value.size(), infinity);
    return estimate;
  }
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
