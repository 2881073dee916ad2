// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "report/JointMotion.h"

#include "sensornoise/FrameGeometry.h"
#include "report/Quantities.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace sensornoise
{

namespace
{
using Motion = std::vector<std::array<double, 2>>;

/** Not where the frame is left out. */
bool
IsKnown(const std::array<double, 2> & shift)
{
  return std::isfinite(shift[0]);
}

/** The mean of two planes that together have every column and every row, less its mean over time. */
Motion
MeanOf(const Motion & first, const Motion & second)
{
  Motion                mean(first.size());
  std::array<double, 2> sum{};
  double                known = 0.0; // frames
  for (std::size_t t = 0; t < mean.size(); ++t)
  {
    for (std::size_t axis = 0; axis < 2; ++axis)
    {
      mean[t][axis] = 0.5 * (first[t][axis] + second[t][axis]);
      sum[axis] += IsKnown(mean[t]) ? mean[t][axis] : 0.0;
    }
    known += IsKnown(mean[t]) ? 1.0 : 0.0;
  }
  for (auto & shift : mean)
  {
    shift[0] -= sum[0] / known;
    shift[1] -= sum[1] / known;
  }
  return mean;
}

/** Sums of products over time, over the frames less one, of R and B's motion with G1 and G2's. */
struct JointProducts
{
  double dof{ 0.0 };            ///< frames that differ, less one
  double square[2]{ 0.0, 0.0 }; ///< along each axis: the noise is not in it [pixel^2]
  double noise[2]{ 0.0, 0.0 };  ///< the variance of what both differ by [pixel^2]
  double covariance{ 0.0 };     ///< of the axes [pixel^2]

  double
  ErrorOfSquare(std::size_t axis) const
  {
    return std::sqrt((std::max(0.0, square[axis]) * noise[axis] + 0.25 * noise[axis] * noise[axis]) / dof);
  }
  double
  ErrorOfCovariance() const
  {
    const double both = std::max(0.0, square[0]) * noise[1] + std::max(0.0, square[1]) * noise[0];
    return 0.5 * std::sqrt((both + 0.5 * noise[0] * noise[1]) / dof);
  }
};

JointProducts
ProductsOf(const Motion & a, const Motion & b, std::size_t framesDistinct)
{
  JointProducts products;
  products.dof = static_cast<double>(std::max<std::size_t>(framesDistinct, 2) - 1);
  const auto   known = static_cast<std::size_t>(std::count_if(a.begin(), a.end(), IsKnown));
  const double scale = 1.0 / static_cast<double>(std::max<std::size_t>(known, 2) - 1);
  for (std::size_t t = 0; t < a.size(); ++t)
  {
    if (!IsKnown(a[t]))
    {
      continue;
    }
    for (std::size_t axis = 0; axis < 2; ++axis)
    {
      const double difference = a[t][axis] - b[t][axis];
      products.square[axis] += scale * a[t][axis] * b[t][axis];
      products.noise[axis] += scale * difference * difference;
    }
    products.covariance += 0.5 * scale * (a[t][0] * b[t][1] + a[t][1] * b[t][0]);
  }
  return products;
}

/** The smallest standard error that a plane has of it; 0: none has one. */
double
SmallestError(const std::array<Report, 4> & channels, Quantity Report::* member)
{
  std::optional<double> smallest;
  for (const Report & channel : channels)
  {
    if (const auto & error = (channel.*member).standardError)
    {
      smallest = smallest ? std::min(*smallest, *error) : *error;
    }
  }
  return smallest.value_or(0.0);
}

/** Adds what \a quantity differs by from \a joint to its error; its interval does not go below \a lowest. */
void
Widen(Quantity & quantity, const Quantity & joint, double lowest)
{
  if (!quantity.value || !quantity.standardError || !joint.value)
  {
    return;
  }
  quantity = WithError(*quantity.value, std::hypot(*quantity.standardError, *quantity.value - *joint.value));
  quantity.interval95->low = std::max(lowest, *quantity.interval95->low);
}
} // namespace

std::optional<JointMotion>
JoinMotion(const std::array<Report, 4> & channels)
{
  const std::size_t frames = channels.front().motion.size();
  for (const Report & channel : channels)
  {
    if (channel.motion.empty() || channel.motion.size() != frames)
    {
      return std::nullopt;
    }
  }
  const auto motionOf = [&channels](BayerPlane plane) -> const Motion & {
    return channels.at(static_cast<std::size_t>(plane)).motion;
  };
  const Motion        redBlue = MeanOf(motionOf(BayerPlane::R), motionOf(BayerPlane::B));
  const Motion        greens = MeanOf(motionOf(BayerPlane::G1), motionOf(BayerPlane::G2));
  const JointProducts products = ProductsOf(redBlue, greens, channels.front().framesDistinct);
  const auto          sdAlong = [&](std::size_t axis, Quantity Report::* ofPlane) {
    const double sd = std::sqrt(std::max(0.0, products.square[axis]));
    return RootOf(products.square[axis],
                  std::hypot(products.ErrorOfSquare(axis), 2.0 * sd * SmallestError(channels, ofPlane)));
  };
  JointMotion joint;
  joint.sdX = sdAlong(0, &Report::vibrationSdX);
  joint.sdY = sdAlong(1, &Report::vibrationSdY);
  joint.covariance =
    WithError(products.covariance,
              std::hypot(products.ErrorOfCovariance(), SmallestError(channels, &Report::vibrationCovariance)));
  joint.series = MeanOf(redBlue, greens);
  return joint;
}

void
WidenVibration(std::array<Report, 4> & channels, const JointMotion & joint)
{
  for (Report & channel : channels)
  {
    Widen(channel.vibrationSdX, joint.sdX, 0.0);
    Widen(channel.vibrationSdY, joint.sdY, 0.0);
    Widen(channel.vibrationCovariance, joint.covariance, -std::numeric_limits<double>::infinity());
  }
}

} // namespace sensornoise
