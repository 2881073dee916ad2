// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_base_Significance_h
#define sensornoise_base_Significance_h

#include "base/Constant.h"

namespace sensornoise
{

/** Levels of significance, as standard errors of a normal number [1].
 *
 * There is one rule: an effect counts if its size exceeds a separate threshold, and if chance exceeds it in fewer than
 * one burst in a hundred. The number of standard errors for the latter depends on the number of tests per burst. Half
 * and twice: Estimator.md, 3.13. */
struct SignificanceLevels
{
  /** 5 % two-sided: nothing is reported, but a number gets a larger error or another one is preferred. */
  double hint{ 2.0 };
  /** 0.3 %: one test per burst. */
  double oneTest{ 3.0 };
  /** 6e-5: up to some hundred tests per burst, as of lags, series or bins. */
  double severalTests{ 4.0 };
  /** 6e-7: up to 10^4 tests per burst, as of levels, tiles or neighbourhoods. */
  double manyTests{ 5.0 };
  /** 2e-9: a test of every pixel; or of frames, whose noise has longer tails than the normal distribution. */
  double everyPixel{ 6.0 };
};

SENSORNOISE_CONSTANT SignificanceLevels Significance;

} // namespace sensornoise

#endif
