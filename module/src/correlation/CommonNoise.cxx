// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "correlation/CommonNoise.h"

#include "correlation/Constants.h"

#include <cstddef>
#include <cstdlib>

namespace sensornoise
{

namespace
{
/** Returns the coefficient of the squared signal in the covariance of pixels that are far apart along both axes [1]. A
 * constant is fitted beside it. Where the signals differ too little to separate both, as in a flat field, the
 * covariance is attributed to the signal alone. */
double
LightOf(const DistantSums & far)
{
  const double squares = far.constant * far.signalSquare;
  const double determinant = squares - far.light * far.light;
  if (determinant > InCorrelation.leastSpread * squares)
  {
    return (far.constant * far.signalCovariance - far.light * far.covariance) / determinant;
  }
  return far.light > 0.0 ? far.covariance / far.light : 0.0;
}

double
ConstantOf(const DistantSums & line, double light)
{
  return line.constant > 0.0 ? (line.covariance - light * line.light) / line.constant : 0.0;
}
} // namespace

LagSums
CommonNoise::TakeOff(LagSums sums, const Lag & lag) const
{
  const auto   row = static_cast<std::size_t>(std::abs(lag.y));
  const auto   column = static_cast<std::size_t>(std::abs(lag.x));
  const double lines = (row < rows.size() ? rows[row] : 0.0) + (column < columns.size() ? columns[column] : 0.0);
  for (PairSums & bin : sums.bins)
  {
    bin.covariance -= lines * bin.constant + light * bin.square;
  }
  return sums;
}

CommonNoise
FindCommonNoise(const DistantCovariance & sums)
{
  CommonNoise common;
  common.light = LightOf(sums.far);
  for (std::size_t d = 0; d < DistantCovariance::Lines; ++d)
  {
    common.rows[d] = ConstantOf(sums.rows[d], common.light);
    common.columns[d] = ConstantOf(sums.columns[d], common.light);
  }
  return common;
}

} // namespace sensornoise
