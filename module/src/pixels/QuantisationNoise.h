// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_pixels_QuantisationNoise_h
#define sensornoise_pixels_QuantisationNoise_h

#include "SensorNoiseExport.h"
#include "base/Eigen.h"
#include "sensornoise/StepResults.h"
#include "scene/InitialNoiseModel.h"
#include "scene/ReferenceFrame.h"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace sensornoise
{

struct StaticVariance;

/** \class QuantisationNoise
 * \brief Quantization noise of companded data beyond the quantization noise in the dark, as a function of the level.
 *
 * The excess is split into a line in the level and a remainder. For data that are companded by a square root, the line
 * is all of it. The remainder is subtracted from the variance of every pixel, so that the variance can be fitted by a
 * line. The line is subtracted after the fit: until then the variance includes it, as the scatter of the pixels does.
 * With uniform quantization the excess is 0. */
struct SensorNoise_EXPORT QuantisationNoise
{
  /** Quantization noise in the dark, which stays in the intercept [DN^2]. */
  double darkVarianceDn2{ 0.0 };
  double slopeDn{ 0.0 };      ///< slope of the line [DN]
  double interceptDn2{ 0.0 }; ///< intercept of the line [DN^2]

  double              lowestDn{ 0.0 };  ///< level of the first remainder [DN]
  double              spacingDn{ 1.0 }; ///< distance of the levels of two successive remainders [DN]
  std::vector<double> remaindersDn2;    ///< remainders at equally spaced levels [DN^2]; empty: none

  double darkErrorDn2{ 0.0 }; ///< standard error of darkVarianceDn2 [DN^2]

  /** Returns the covariance of gain and intercept that the uncertainty of this noise adds:
   * InPixels.errorOfQuantisationNoise of the slope, and darkErrorDn2. \a pivotDn is the level at which an error of the
   * slope leaves the line unchanged [DN]. Zero with uniform quantization. */
  Eigen::Matrix2d
  ErrorOfLine(double pivotDn) const;

  /** Returns the remainder at a level, linear between two levels and constant beyond the first and the last one
   * [DN^2]. */
  double
  RemainderAt(double levelDn) const
  {
    if (remaindersDn2.empty())
    {
      return 0.0;
    }
    const double      last = static_cast<double>(remaindersDn2.size()) - 1.0;
    const double      at = std::clamp((levelDn - lowestDn) / spacingDn, 0.0, last);
    const std::size_t low = std::min(static_cast<std::size_t>(at), remaindersDn2.size() - 2);
    const double      fraction = at - static_cast<double>(low);
    return remaindersDn2[low] + fraction * (remaindersDn2[low + 1] - remaindersDn2[low]);
  }
};

/** Computes the quantization noise of \a dnRange at the levels of the usable pixels of \a frame. The values of a pixel
 * over time are taken to be normally distributed, with the variance of \a model. \a darkStepDn is the quantization step
 * in the dark as measured in dark frames [DN]; 0: not measured, the first step of \a dnRange is used. */
SensorNoise_EXPORT QuantisationNoise
MakeQuantisationNoise(const DnRange &           dnRange,
                      const ReferenceFrame &    frame,
                      const InitialNoiseModel & model,
                      double                    darkStepDn);

/** Returns \a variance without the line of its quantization noise in all fitted lines, and with the covariance of this
 * line in theirs. */
SensorNoise_EXPORT StaticVariance
SubtractQuantisationLine(StaticVariance variance);

} // namespace sensornoise

#endif
