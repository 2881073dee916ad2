// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_exports_RelativeFit_h
#define sensornoise_exports_RelativeFit_h

#include <array>
#include <vector>

namespace sensornoise
{

/** One equation: first x + second y = wanted. */
struct TwoTerms
{
  double first{ 0.0 };
  double second{ 0.0 };
  double wanted{ 0.0 };
};

/** Solves equations for (x, y) by least squares of relative errors. Where \a isPositive, neither is below 0. */
std::array<double, 2>
SolveRelative(const std::vector<TwoTerms> & equations, bool isPositive);

} // namespace sensornoise

#endif
