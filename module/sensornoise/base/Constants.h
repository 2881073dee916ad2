// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_base_Constants_h
#define sensornoise_base_Constants_h

#include "sensornoise/base/Constant.h"

namespace sensornoise
{

/** Numbers that several rooms use. Those of one room are in its own Constants.h. */
struct CommonConstants
{
  /** Quantiles of the mean that stand for the darkest and the brightest level [1]. Set by hand: 130 of 65536 pixels lie
   * beyond either, so that no single defect is a level. */
  double darkestQuantile{ 0.002 };
  double brightestQuantile{ 0.998 };

  /** Variance of the noise, relative to the square of the code step, below which the codes hide it [1]: that of half a
   * step. */
  double hiddenVariance{ 0.25 };
};

SENSORNOISE_CONSTANT CommonConstants InCommon;

} // namespace sensornoise

#endif
