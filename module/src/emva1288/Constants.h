// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_emva1288_Constants_h
#define sensornoise_emva1288_Constants_h

#include "base/Constants.h"

#include <cstddef>

namespace sensornoise
{

/** Numbers of EMVA Standard 1288, Release 4.0 Linear. */
struct EmvaConstants
{
  /** Highest signal of the fits of gain and responsivity, relative to the signal at saturation [1]. Section 6.6. */
  double gainRange{ 0.70 };
  /** Lowest and highest signal of the linearity, relative to the signal at saturation [1]. Section 6.7. */
  double linearityLow{ 0.05 };
  double linearityHigh{ 0.95 };
  /** Variance of a uniform distribution of the width of one quantization step [step^2]: exact. */
  double quantizationVariance{ 1.0 / 12.0 };
  /** Dark variance below which quantization hides the dark noise [step^2]. Below (53). */
  double leastDarkVariance{ 0.24 };
  /** Upper limit of the dark noise in this case [step]. (54). */
  double darkNoiseLimit{ 0.40 };
  /** Least fraction of saturated values at saturation [1]. Section 6.5. */
  double leastSaturatedFraction{ 0.001 };
  /** Fewest different exposures of dark frames of a dark current. The standard asks for 6 (section 7.1); a line has no
   * error with fewer than 3. */
  std::size_t fewestDarkExposures{ 3 };
  std::size_t darkExposuresOfStandard{ 6 };
  /** Fewest exposures in the range of a fit: a line through two has no error. */
  std::size_t fewestPoints{ 3 };
  /** Flat exposures of the standard. Section 6.5. */
  std::size_t exposuresOfStandard{ 50 };
  /** Frames of a series for the non-uniformity. Section 8. */
  std::size_t framesOfStandard{ 100 };
  /** Rounds of the weighted line, whose weights follow from its own values. Chosen empirically: the third changes the
   * slope by less than 1e-4 of its error. */
  int roundsOfWeights{ 4 };
};

SENSORNOISE_CONSTANT EmvaConstants InEmva;

} // namespace sensornoise

#endif
