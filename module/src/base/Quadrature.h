// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_base_Quadrature_h
#define sensornoise_base_Quadrature_h

#include <cmath>

namespace sensornoise
{

/** Returns sqrt(a^2 + b^2 + c^2); infinite if one of them is. std::hypot() of three arguments is NaN then in libstdc++,
 * and an unknown error would pass for none. */
inline double
AddInQuadrature(double a, double b, double c)
{
  return std::hypot(std::hypot(a, b), c);
}

} // namespace sensornoise

#endif
