// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "files/UsableGeometry.h"

#include <cmath>
#include <cstddef>

namespace sensornoise
{
namespace
{
double
DeterminantOf(const std::array<std::array<double, 3>, 3> & m)
{
  return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) - m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
         m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
}
} // namespace

StackGeometry
UsableGeometry(const StackGeometry & given)
{
  StackGeometry geometry;
  StackGeometry turned = given;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const double spacing = given.spacing[axis];
    if (std::isfinite(spacing) && spacing != 0.0)
    {
      geometry.spacing[axis] = std::abs(spacing);
    }
    if (std::isfinite(given.origin[axis]))
    {
      geometry.origin[axis] = given.origin[axis];
    }
    for (std::size_t row = 0; row < 3; ++row)
    {
      turned.direction[row][axis] = (spacing < 0.0 ? -1.0 : 1.0) * given.direction[row][axis];
    }
  }
  const double determinant = DeterminantOf(turned.direction);
  if (std::isfinite(determinant) && determinant != 0.0)
  {
    geometry.direction = turned.direction;
  }
  return geometry;
}

} // namespace sensornoise
