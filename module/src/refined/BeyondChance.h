// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_refined_BeyondChance_h
#define sensornoise_refined_BeyondChance_h

#include "base/Constants.h"

#include <algorithm>
#include <cmath>

namespace sensornoise
{

/** Returns the factor by which a reduced chi-square widens a covariance [1]: the chi-square itself where it exceeds 1
 * by more than Significance.hint of its standard deviations, else 1. \a dof are its degrees of freedom. */
inline double
BeyondChance(double reducedChi2, double dof)
{
  return reducedChi2 > 1.0 + Significance.hint * std::sqrt(2.0 / std::max(1.0, dof)) ? reducedChi2 : 1.0;
}

} // namespace sensornoise

#endif
