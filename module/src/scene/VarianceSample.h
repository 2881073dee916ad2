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

struct InitialNoiseModel;

/** The pixels to which a InitialNoiseModel is fitted: their raw variance, and the terms of the model. */
struct VarianceSample
{
  static constexpr int Terms = 6; ///< number of terms: intercept, x, x^2, gx^2, gy^2, gx gy

  using Coefficients = Eigen::Matrix<double, Terms, 1>;

  Eigen::Matrix<double, Eigen::Dynamic, Terms, Eigen::RowMajor> design;

  std::vector<double> level;        ///< mean of the neighbours [DN]
  std::vector<double> raw;          ///< variance [DN^2]
  std::vector<double> energy;       ///< squared gradient [DN^2/pixel^2]
  double              scale{ 1.0 }; ///< unit of x in the design [DN]

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

/** Samples \a pixels. The darkest and the brightest level are taken from \a model. */
SensorNoise_EXPORT VarianceSample
SampleVariance(const ReferenceFrame & frame, const std::vector<std::size_t> & pixels, const InitialNoiseModel & model);

/** Variance that a fit predicts for every pixel, and the pixels that the fit keeps. */
struct VariancePrediction
{
  std::vector<double>       variance;      ///< predicted variance [DN^2]
  std::vector<std::uint8_t> keep;          ///< 1: the variance of the pixel is not far above
  double                    lowest{ 0.0 }; ///< smallest median of an intensity bin, or another estimate of the darkest
                                           ///< variance [DN^2]
};

/** Starts a fit from the medians over 32 intensity bins of the smoother half of the pixels, where motion adds little.
 */
SensorNoise_EXPORT VariancePrediction
StartFromMedians(const VarianceSample & sample);

/** Fits the coefficients by weighted least squares over the pixels that are kept. */
SensorNoise_EXPORT VarianceSample::Coefficients
SolveKept(const VarianceSample & sample, const VariancePrediction & prediction);

/** Sets the prediction for the coefficients \a theta. Keeps the pixels whose raw variance is below \a largestRatio
 * times the prediction [1]. */
SensorNoise_EXPORT void
Predict(const VarianceSample &               sample,
        const VarianceSample::Coefficients & theta,
        double                               largestRatio,
        VariancePrediction &                 prediction);

} // namespace sensornoise

#endif
