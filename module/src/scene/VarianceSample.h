// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_scene_VarianceSample_h
#define sensornoise_scene_VarianceSample_h

#include "SensorNoiseExport.h"
#include "base/Eigen.h"
#include "scene/ReferenceFrame.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace sensornoise
{

struct ProvisionalModel;

/** The pixels to which a ProvisionalModel is fitted: their raw variance, and the terms that it is made of. */
struct VarianceSample
{
  static constexpr int Terms = 6; ///< intercept, x, x^2, gx^2, gy^2, gx gy

  using Coefficients = Eigen::Matrix<double, Terms, 1>;

  Eigen::Matrix<double, Eigen::Dynamic, Terms, Eigen::RowMajor> design;

  std::vector<double> level;        ///< neighbours' mean [DN]
  std::vector<double> raw;          ///< variance [DN^2]
  std::vector<double> energy;       ///< square of the gradient [DN^2/pixel^2]
  double              scale{ 1.0 }; ///< of x in the design [DN]

  std::size_t
  Size() const
  {
    return raw.size();
  }
  auto
  TermsOf(std::size_t i) const
  {
    return design.row(static_cast<Eigen::Index>(i));
  }
};

/** The sample of \a pixels; \a model tells the darkest and the brightest level. */
SensorNoise_EXPORT VarianceSample
SampleVariance(const ReferenceFrame & frame, const std::vector<std::size_t> & pixels, const ProvisionalModel & model);

/** What a fit predicts of every pixel, and which pixels it keeps. */
struct VariancePrediction
{
  std::vector<double>       variance;      ///< [DN^2]
  std::vector<std::uint8_t> keep;          ///< 1: the pixel is not far above
  double                    lowest{ 0.0 }; ///< median of a bin [DN^2]
};

/** Starts a fit from the medians over 32 bins of intensity of the smoother half of the pixels, where motion adds
 * little.
 */
SensorNoise_EXPORT VariancePrediction
StartFromMedians(const VarianceSample & sample);

/** Weighted least squares over the pixels that are kept. */
SensorNoise_EXPORT VarianceSample::Coefficients
SolveKept(const VarianceSample & sample, const VariancePrediction & prediction);

/** Sets what \a theta predicts; keeps the pixels up to \a largestRatio times that. */
SensorNoise_EXPORT void
Predict(const VarianceSample &               sample,
        const VarianceSample::Coefficients & theta,
        double                               largestRatio,
        VariancePrediction &                 prediction);

} // namespace sensornoise

#endif
