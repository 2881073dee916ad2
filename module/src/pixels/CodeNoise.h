// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_pixels_CodeNoise_h
#define sensornoise_pixels_CodeNoise_h

#include "SensorNoiseExport.h"
#include "base/Eigen.h"
#include "sensornoise/StepResults.h"
#include "scene/ProvisionalModel.h"
#include "scene/ReferenceFrame.h"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace sensornoise
{

struct StaticVariance;

/** \class CodeNoise
 * \brief What rounding to companded codes adds to the variance beyond what it adds in the dark, by level.
 *
 * It is parted in two: a line, which for a square root is all of it, and a rest. The rest is taken off the variance of
 * every pixel, so that what is fitted is a line; the line is taken off the fit. Until then the variance is that which
 * the pixels have, and their scatter about it what chance makes of it. Even codes: zero. */
struct SensorNoise_EXPORT CodeNoise
{
  /** The noise of rounding in the dark, which is left in the intercept [DN^2]. */
  double inTheDarkDn2{ 0.0 };
  double slopeDn{ 0.0 };      ///< of the line [DN]
  double interceptDn2{ 0.0 }; ///< of the line [DN^2]

  double              lowestDn{ 0.0 };  ///< level of the first rest [DN]
  double              spacingDn{ 1.0 }; ///< of the levels of the rests [DN]
  std::vector<double> restsDn2;         ///< beyond the line; empty: none

  double darkErrorDn2{ 0.0 }; ///< of the noise in the dark

  /** Covariance of gain and intercept by what is not known of this noise: some per cent of it, and the error in the
   * dark. 0 for even codes. */
  Eigen::Matrix2d
  ErrorOfLine(double pivotDn) const;

  /** Beyond the line [DN^2]. */
  double
  RestAt(double levelDn) const
  {
    if (restsDn2.empty())
    {
      return 0.0;
    }
    const double      last = static_cast<double>(restsDn2.size()) - 1.0;
    const double      at = std::clamp((levelDn - lowestDn) / spacingDn, 0.0, last);
    const std::size_t low = std::min(static_cast<std::size_t>(at), restsDn2.size() - 2);
    const double      share = at - static_cast<double>(low);
    return restsDn2[low] + share * (restsDn2[low + 1] - restsDn2[low]);
  }
};

/** The noise of \a codes on the usable pixels of \a frame, whose noise is about \a model's: a pixel's frames reach the
 * codes about its mean. \a darkStepDn, above 0, is the step in the dark as dark frames tell it. */
SensorNoise_EXPORT CodeNoise
MakeCodeNoise(const CodeRange & codes, const ReferenceFrame & frame, const ProvisionalModel & model, double darkStepDn);

/** Takes the line of \a noise off the lines that were fitted. */
SensorNoise_EXPORT void
TakeOffLine(StaticVariance & variance, const CodeNoise & noise);

} // namespace sensornoise

#endif
