// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_scene_InitialNoiseModel_h
#define sensornoise_scene_InitialNoiseModel_h

#include "SensorNoiseExport.h"
#include "base/Eigen.h"
#include "scene/ReferenceFrame.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace sensornoise
{

/** \class InitialNoiseModel
 * \brief Initial noise model: the uncorrected temporal variance, from the maps of the first pass alone. It is (2.20)
 * of Sur & Gredi\'ac 2015, fitted robustly and with weights.
 *
 *     variance = intercept + slope x + sigma_gamma^2 x^2 + sigma_a^2 gx^2 + sigma_b^2 gy^2 + 2 sigma_ab gx gy
 *
 * with x the neighbours' mean above the darkest level, gx and gy the derivatives of the mean. The model yields the
 * weights of all later steps, the guard band at the clip levels, and the pixels that are no part of a static scene. No
 * estimate of it is reported. Estimator.md, 3.2. */
struct InitialNoiseModel
{
  double darkestDn{ 0.0 };   ///< darkest quantile of the mean of the usable pixels [DN]
  double brightestDn{ 0.0 }; ///< brightest quantile of the mean of the usable pixels [DN]
  double centreDn{ 0.0 };    ///< mean of the usable pixels, about which the regressions are centred [DN]

  double interceptDn2{ 0.0 };      ///< variance at the darkest level [DN^2]
  double slopeDn{ 0.0 };           ///< approximate gain [DN/e-]
  double flickerVariance{ 0.0 };   ///< approximate sigma_gamma^2 [1]
  double vibrationXPixels2{ 0.0 }; ///< approximate sigma_alpha^2 [pixel^2]
  double vibrationYPixels2{ 0.0 }; ///< approximate sigma_beta^2 [pixel^2]
  double vibrationXY{ 0.0 };       ///< approximate sigma_alpha,beta [pixel^2]

  /** Ratio of raw to modelled variance above which the model does not explain a pixel [1]. */
  double largestRatio{ 0.0 };
  /** Whether edges are sharper than a pixel, so that motion explains a pixel up to LargestVariance(). */
  bool isSharp{ false };

  /** Returns the variance without flicker and motion at a mean of the neighbours [DN^2]. */
  double
  NoiseVariance(double neighbourMeanDn) const
  {
    return interceptDn2 + slopeDn * std::max(0.0, neighbourMeanDn - darkestDn);
  }
  /** Returns the variance that motion adds at a gradient, \a gx and \a gy in DN/pixel, without the covariance of both
   * directions [DN^2]. */
  double
  MotionVariance(double gx, double gy) const
  {
    return vibrationXPixels2 * gx * gx + vibrationYPixels2 * gy * gy;
  }
  /** Returns the largest variance of a pixel that the model explains, at a mean of the neighbours, with the steps
   * \a squares around the pixel (see SquaredStepsNear()) [DN^2]. */
  double
  LargestVariance(double neighbourMeanDn, const std::array<double, 2> & squares) const
  {
    const double x = neighbourMeanDn - darkestDn;
    return largestRatio * (NoiseVariance(neighbourMeanDn) + flickerVariance * x * x + vibrationXPixels2 * squares[0] +
                           vibrationYPixels2 * squares[1]);
  }
  /** Returns the whole uncorrected variance [DN^2]. */
  double
  RawVariance(double neighbourMeanDn, double gx, double gy) const
  {
    const double x = neighbourMeanDn - darkestDn;
    return NoiseVariance(neighbourMeanDn) + flickerVariance * x * x + MotionVariance(gx, gy) +
           2.0 * vibrationXY * gx * gy;
  }
};

/** Fits the model. It starts from the medians of 32 intensity bins of the smoother half of the pixels. Then it excludes
 * pixels whose variance is far above the model and fits again, five times. Where edges are sharper than a pixel, the
 * model comes from FitSharpScene(). Throws NothingToMeasure if fewer than 100 pixels are usable. */
SensorNoise_EXPORT InitialNoiseModel
FitInitialNoiseModel(const ReferenceFrame & frame);

/** The pixels to which an InitialNoiseModel is fitted: their raw variance, and the terms of the model. */
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

/** Returns the largest squared difference between the pixels before and after a pixel, along x and along y, among the
 * 3 x 3 pixels around pixel \a p of a \a mean of \a width columns [DN^2]. The pixel is at least StencilMargin pixels
 * from the border.
 *
 * The variance that motion by a standard deviation of one pixel adds to one pixel is at most their sum. An edge that is
 * sharper than a pixel lies within one pixel, which changes by the whole step; its central difference is half of it,
 * and the next pixel, which does not change at all, has the same difference. */
SensorNoise_EXPORT std::array<double, 2>
SquaredStepsNear(const double * mean, std::size_t width, std::size_t p);

/** Fits the initial noise model to a scene whose edges are sharper than a pixel. Returns null if the edges are not
 * sharper, or if no vibration explains them.
 *
 * If a fit excludes pixels that hold more than a tenth of the squared derivatives of the mean, but hardly any of the
 * smoother half of the pixels, it has excluded the motion itself. This fit starts from the motion that sums over 3 x 3
 * pixels show, and excludes the pixels whose variance is far above the largest that motion explains. Estimator.md, 3.2.
 * \param sample sample of the variance at \a pixels, at least one of them
 * \param prediction variance by the fit without sharp edges, with the pixels that it keeps
 * \param ratio ratio of raw to explained variance above which a pixel is excluded [1] */
SensorNoise_EXPORT std::optional<VarianceSample::Coefficients>
FitSharpScene(const ReferenceFrame &           frame,
              const std::vector<std::size_t> & pixels,
              const VarianceSample &           sample,
              const VariancePrediction &       prediction,
              double                           ratio);

/** Throws NothingToMeasure if the noise of floating-point frames is too small or too large for their unit. */
SensorNoise_EXPORT void
RequireUnitOfFrames(const InitialNoiseModel & model);

} // namespace sensornoise

#endif
