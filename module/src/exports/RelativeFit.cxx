// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "exports/RelativeFit.h"

#include <algorithm>
#include <cmath>

namespace sensornoise
{

namespace
{
/** The least value that errors are relative to [variance of levels from 0 to 1, or DN of 16 bits]: far below one
 * electron of any sensor, and above 0. */
constexpr double leastWanted = 1e-30;
} // namespace

std::array<double, 2>
SolveRelative(const std::vector<TwoTerms> & equations, bool isPositive)
{
  double xx = 0.0;
  double xy = 0.0;
  double yy = 0.0;
  double xw = 0.0;
  double yw = 0.0;
  for (const TwoTerms & each : equations)
  {
    const double weight = std::pow(std::max(each.wanted, leastWanted), -2.0);
    xx += weight * each.first * each.first;
    xy += weight * each.first * each.second;
    yy += weight * each.second * each.second;
    xw += weight * each.first * each.wanted;
    yw += weight * each.second * each.wanted;
  }
  const double          determinant = xx * yy - xy * xy;
  std::array<double, 2> solved{ (xw * yy - yw * xy) / determinant, (yw * xx - xw * xy) / determinant };
  if (isPositive && solved[0] < 0.0)
  {
    solved = { 0.0, yw / yy };
  }
  else if (isPositive && solved[1] < 0.0)
  {
    solved = { xw / xx, 0.0 };
  }
  return solved;
}

} // namespace sensornoise
