// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_limits_CramerRaoBound_h
#define sensornoise_limits_CramerRaoBound_h

#include "SensorNoiseExport.h"
#include "sensornoise/Parallel.h"
#include "sensornoise/Simulator.h"
#include "base/Eigen.h"

#include <cstddef>
#include <cstdint>
#include <limits>

namespace sensornoise
{

/** Smallest standard errors of an unbiased estimate from one stack (Cram\'er-Rao). Infinity: the stack does not
 * identify the quantity. The quantities describe this stack, not the population from which its flicker and
 * vibration were drawn: the flicker is (1 + gamma_t) / mean(1 + gamma) - 1, and the shifts are relative to their
 * mean. */
struct PrecisionLimit
{
  static constexpr double None = std::numeric_limits<double>::infinity();

  double gain{ None };              ///< g [DN/e-]
  double intercept{ None };         ///< sigma^2 - g mu [DN^2]
  double offset{ None };            ///< mu [DN]
  double readNoise{ None };         ///< sigma [DN]
  double flickerOfFrame{ None };    ///< gamma_t [1]; root mean square over the frames
  double flickerSd{ None };         ///< sigma_gamma [1]
  double vibrationXOfFrame{ None }; ///< alpha_t [pixel]; root mean square over the frames
  double vibrationYOfFrame{ None }; ///< beta_t [pixel]; root mean square over the frames
  double vibrationSdX{ None };      ///< sigma_alpha [pixel]
  double vibrationSdY{ None };      ///< sigma_beta [pixel]
  /** Correlation of the errors of g and sigma^2 - g mu [1]; -1 as long as they are not computed. */
  double gainInterceptCorrelation{ -1.0 };
};

/** Properties of a stack on which its precision depends. */
struct PrecisionInput
{
  const double *       mean;   ///< expected level of every pixel, offset included [DN]
  const std::uint8_t * mask;   ///< nonzero where the pixel is used; null: everywhere
  std::size_t          width;  ///< number of columns
  std::size_t          height; ///< number of rows

  double gainDnPerElectron; ///< g, above 0 [DN/e-]
  double offsetDn;          ///< mu [DN]
  /** sigma^2, plus step^2 / 12 if the data are quantized [DN^2]. */
  double totalReadVarianceDn2;
  /** Quantization step [DN]; 0: no quantization. */
  double      quantisationStepDn;
  std::size_t frames;    ///< T, at least 2
  double      flickerSd; ///< sigma_gamma of the frames themselves [1]
};

/** Computes the precision limit in closed form from sums over the pixels. It serves to plan an experiment and to
 * evaluate an estimator. The model is the normal approximation of (2.1) in Sur & Gredi\'ac 2015
 * (https://doi.org/10.1137/140977035),
 *
 *   u_xt ~ N(mu + L_xt, g L_xt + s),   L_xt = (1 + gamma_t) q_x(alpha_t, beta_t),   s = sigma^2 + step^2 / 12.
 *
 * The Fisher information of a datum of mean m and variance V on two parameters a, b is m_a m_b / V + V_a V_b / (2 V^2)
 * (Kay, Fundamentals of Statistical Signal Processing, vol. 1, 1993, (3.31)). If q_x, gamma_t and the shifts are all
 * unknown, the leading terms of its inverse are
 *
 *   var(g)           = 2 / ((T-1) sum (ubar - m)^2 / V^2),   m = sum (ubar/V^2) / sum (1/V^2)
 *   var(c)           = 2 / ((T-1) sum 1/V^2) + m^2 var(g),   c = sigma^2 - g mu,   cov(g, c) = -m var(g)
 *   var(mu)          = 1 / ((T-1) sigma_gamma^2 (A0 - A1^2/A2)),   A_k = sum q^k / V
 *   var(sigma^2)     = var(c) + mu^2 var(g) + 2 mu cov(g, c) + g^2 var(mu)
 *   var(gamma_t)     = 1 / A2
 *   var(sigma_gamma) = 1 / ((T-1) A2) + (sigma_gamma (A1/A2) sd(mu))^2
 *   var(alpha_t)     = 1 / sum (d ubar/dx)^2 / V,   var(sigma_alpha) = var(alpha_t) / (T-1);   beta_t likewise.
 *
 * With 100 frames and vibrations below a pixel, these agree with ComputeCramerRaoBound() within 3 %, except for the
 * vibrations, which can differ by 25 %. Twice the flicker halves sd(mu). Dark pixels have a small V and make A0 large.
 *
 * \throws std::invalid_argument if there are fewer than 2 frames, or the gain is not positive. */
SensorNoise_EXPORT PrecisionLimit
ComputePrecisionLimit(const PrecisionInput & input);

/** Input for the Cram\'er-Rao bound of a simulated stack. */
struct SensorNoise_EXPORT CramerRaoInput
{
  const double *          electrons;                 ///< p, the scene at rest, blurred by the optics [e-]
  const std::uint8_t *    mask;                      ///< nonzero where the pixel is used; null: everywhere
  std::size_t             width;                     ///< number of columns
  std::size_t             height;                    ///< number of rows
  const SimulationTruth * truth;                     ///< camera, flicker and shifts of the stack
  double                  quantisationStepDn{ 1.0 }; ///< quantization step [DN]; 0: no quantization

  /** Returns sigma^2 + step^2 / 12 [DN^2]. */
  double
  TotalReadVarianceDn2() const;

  /** Returns g times the mean of 1 + gamma: the mean flux of a pixel per electron of the scene [DN/e-]. */
  double
  MeanFluxPerElectronDn() const;
};

/** Fisher information of rows of a frame on the parameters that all pixels have in common, in the order g, c0, mu,
 * gamma_1..T, alpha_1..T, beta_1..T. The flux q_x of each pixel is unknown, too, and is eliminated: a pixel adds the
 * Schur complement I - c_x c_x' / I_xx of its arrow matrix. c0 is the noise variance at the mean level,
 * V = g (level - mean level) + c0. It is less correlated with g than the intercept, and does not depend on mu. */
class SensorNoise_EXPORT CramerRaoInformation
{
public:
  static constexpr Eigen::Index Gain = 0;
  static constexpr Eigen::Index CentralVariance = 1;
  static constexpr Eigen::Index Offset = 2;
  static constexpr Eigen::Index FirstSeries = 3;

  /** Prepares the information, all 0. \a meanFluxDn is the mean level minus mu [DN]. */
  CramerRaoInformation(const CramerRaoInput & input, double meanFluxDn);

  /** Adds the information of row \a y in all frames. */
  void
  AddRow(std::size_t y);

  /** Adds the information of other rows. */
  void
  Add(const CramerRaoInformation & other);

  /** Returns the standard errors that the parameters would have if each were the only unknown; 1 where there is no
   * information. */
  Eigen::VectorXd
  GetUnits() const;

  /** Returns the covariance of the parameters' errors under the constraints sum gamma = sum alpha = sum beta = 0, which
   * fix the scale and the position of the scene. A direction without information has a variance of 1e20 units. */
  Eigen::MatrixXd
  GetCovariance() const;

private:
  /** Derivatives of a row's data with respect to g, c0, mu and the frame's own gamma, alpha and beta, one row per
   * pixel. */
  using SixColumns = Eigen::Array<double, Eigen::Dynamic, 6>;
  struct Derivatives
  {
    SixColumns ofMean;
    SixColumns ofVariance;
  };

  /** Returns 1 where a pixel of row \a y is used, 0 elsewhere. */
  Eigen::ArrayXd
  GetUse(std::size_t y) const;

  Derivatives
  GetDerivatives(std::size_t y, std::size_t frame) const;

  /** Returns q(alpha, beta) of row \a y, interpolated as in StackSimulator [DN]. */
  Eigen::ArrayXd
  ShiftedFlux(std::size_t y, double alpha, double beta) const;

  CramerRaoInput  m_Input;
  double          m_FluxPerElectronDn;
  double          m_MeanFluxDn;
  Eigen::Index    m_Frames;
  Eigen::MatrixXd m_Schur;  // lower triangle
  Eigen::VectorXd m_Direct; // diagonal for known fluxes of the pixels
};

/** Computes the Cram\'er-Rao bound of a simulated stack in the model of ComputePrecisionLimit(). The flux of every
 * pixel, and the flicker and shift of every frame, are unknown. Both the mean and the variance of every datum
 * contribute information. The flicker is (1 + gamma_t) / mean(1 + gamma) - 1, and the shifts are relative to their
 * mean: the remaining scale and position of the scene cannot be identified from a stack.
 *
 * The effect of a shift on a pixel, the derivative of the interpolated scene, is taken as known. An estimator has only
 * the noisy gradients of the frames, so the bound for the vibrations is slightly too small.
 *
 * The cost is 9 T^2 operations per pixel, 4 s on one core for 512 x 512 pixels and 100 frames. \a parallelFor
 * distributes it over up to 8 threads, with the same bits for any number of threads. Memory: 8 times 72 T^2 bytes.
 *
 * \throws std::invalid_argument for one frame, a rolling shutter, or data without any noise in the dark. */
SensorNoise_EXPORT PrecisionLimit
ComputeCramerRaoBound(const CramerRaoInput & input, const ParallelFor & parallelFor = SerialFor);

} // namespace sensornoise

#endif
