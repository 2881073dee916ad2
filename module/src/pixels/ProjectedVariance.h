// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_pixels_ProjectedVariance_h
#define sensornoise_pixels_ProjectedVariance_h

#include "SensorNoiseExport.h"
#include "sensornoise/Parallel.h"
#include "pixels/CodeNoise.h"
#include "pixels/UnequalIllumination.h"
#include "pixels/ProjectionSums.h"
#include "pixels/RoughnessClasses.h"
#include "pixels/VarianceLine.h"

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace sensornoise
{

class TemporalBasis;
struct MotionSeries;
struct InitialNoiseModel;
struct ReferenceFrame;

/** \class ProjectedVariance
 * \brief Variance of every pixel over time, without the variation that is not sensor noise.
 *
 * With the J coordinates S_j of the time series in the basis, and the sum of squares SS about the mean,
 *
 *     RSS = SS - sum_j S_j^2,   K_ij = sum_t Q_tj^2 Q_ti,
 *
 *     V = (RSS + g sum_i S_i sum_j K_ij) / ((T - 1 - J) (1 - h)).
 *
 * The response of a pixel to each component is free. The projection is therefore exact on edges, for any optics and
 * interpolation, for pixels of different sensitivity, and for local illumination. This is a simple form of
 * Estimator.md, 3.5:
 *
 * - The noise changes with the signal. A component that is large in the frames in which a pixel is bright removes more
 *   noise than its number of degrees of freedom. The second term corrects this, by 0.1 to 0.5 % of g: the coordinates
 *   contain the change of the pixel's signal by flicker and by motion.
 * - The motion components were estimated from the same pixels. They follow the noise of a pixel by its leverage
 *   h = w D' G^-1 D, which matters in the few pixels that dominate the regression.
 * - With both corrections, every component can be projected out of every pixel. This takes 5 to 15 % of the degrees of
 *   freedom, needs no selection of components by class of pixels, and leaves no bias below a threshold.
 * - The divisor of the squares is (T - 1 - J) (1 - h). The degrees of freedom by which the variance scatters are a
 *   different number where the illumination changes strongly, see FrameDof.
 *
 * Pixels are sorted into RoughnessClasses for the test of fit (TestClasses). */
class SensorNoise_EXPORT ProjectedVariance
{
public:
  /** Number of roughness classes. */
  static constexpr std::size_t Classes = RoughnessClasses;

  /** Computes the variance with the gain 0. \a squares are the residual squares for the components of \a basis. All
   * references must outlive the object. */
  ProjectedVariance(const ReferenceFrame &            frame,
                    const TemporalBasis &             basis,
                    const MotionSeries &              motion,
                    ResidualSquares                   squares,
                    const InitialNoiseModel &         model,
                    const std::vector<std::uint8_t> & mask,
                    const ParallelFor &               parallelFor);

  /** Subtracts the remainder of the quantization noise that is not a line in the level, see CodeNoise. */
  void
  SubtractRemainder(const CodeNoise & noise);

  /** Replaces the squares of pixel \a p of the mask by \a squares [DN^2], whose expectation is \a freedom times the
   * variance of the pixel. Squares without the noise that is common to a row are an example. To be called before
   * SetIllumination() and Compute(). */
  void
  ReplaceSquares(std::size_t p, double squares, double dof);

  /** Allows for noise that differs from frame to frame. \a gamma + 1 is the illumination factor of each frame, and
   * \a offsetDn the dark offset. The fraction of shot noise is taken from the initial noise model until Compute(line)
   * is called. If not \a isShotNoiseKnown, all noise is taken to be shot noise, which gives the fewest degrees of
   * freedom. */
  void
  SetIllumination(const std::vector<double> & gamma, double offsetDn, bool isShotNoiseKnown = true);

  /** Computes the variance with another gain [DN/e-] for the correction of noise that changes with the signal. */
  void
  Compute(double gain);
  /** Computes the variance with the gain of \a line, and the degrees of freedom with its fraction of shot noise. */
  void
  Compute(const VarianceLine & line);

  /** Divides the variance of every pixel by its ratio to the variance of a uniform sensor, see MapOfRatios() [1].
   * Empty: the variance is not divided. Earlier ratios are undone first. */
  void
  SetRatios(std::vector<float> ratios);
  /** Returns whether the variance is divided by ratios. */
  bool
  HasRatios() const
  {
    return !m_Ratios.empty();
  }
  /** Returns the measured variance, which is not divided by ratios [DN^2]. */
  std::vector<double>
  MeasuredVariance() const;

  /** Returns the gain of the last Compute() [DN/e-]; at first 0. */
  double
  GetGain() const
  {
    return m_Gain;
  }
  /** Returns the variance of every pixel [DN^2]; 0 outside the mask. */
  const std::vector<double> &
  GetVariance() const
  {
    return m_Variance;
  }
  /** Moves the measured variance out of the object. */
  std::vector<double>
  TakeVariance()
  {
    this->SetRatios({});
    return std::move(m_Variance);
  }
  /** Returns the effective degrees of freedom of every pixel's variance; 0 outside the mask. */
  const std::vector<float> &
  GetDof() const
  {
    return m_Dof.empty() ? m_Divisor : m_Dof;
  }
  /** Returns the divisor of every pixel's squares, (T - 1 - J) (1 - h); 0 outside the mask. */
  const std::vector<float> &
  GetDivisor() const
  {
    return m_Divisor;
  }
  /** Returns the fraction of the degrees of freedom that a change of the illumination leaves to pixels of a level
   * [1]. */
  double
  DofFractionAtPixel(double levelDn) const
  {
    return m_FrameDof.IsEqual() ? 1.0 : m_FrameDof.DofFractionAt(this->ShotFractionAt(levelDn));
  }
  /** Returns whether the noise differs from frame to frame by as much as matters, see FrameDof::IsEqual(). */
  bool
  HasUnequalNoise() const
  {
    return !m_FrameDof.IsEqual();
  }
  /** Returns the factor of the gain in the corrected squares of each pixel, sum_i S_i sum_j K_ij [DN]. */
  const std::vector<float> &
  GetSkew() const
  {
    return m_Skew;
  }
  /** Returns the roughness class of pixel \a p, from 0 (flat) to Classes - 1. */
  std::uint8_t
  ClassOf(std::size_t p) const
  {
    return m_ClassOf[p];
  }
  const std::vector<std::uint8_t> &
  GetClasses() const
  {
    return m_ClassOf;
  }
  const ReferenceFrame &
  GetFrame() const
  {
    return m_Frame;
  }
  const TemporalBasis &
  GetBasis() const
  {
    return m_Basis;
  }
  VarianceData
  GetData(const std::vector<std::uint8_t> & mask) const;

private:
  /** Divides the squares of the mask's pixels by their divisors. */
  void
  DivideSquares(const MotionSeries & motion, const InitialNoiseModel & model);
  /** Computes the effective degrees of freedom of the mask's pixels. */
  void
  ComputeDof();
  /** Returns the fraction of the variance at a level of the neighbours' mean that is shot noise [1]. */
  double
  ShotFractionAt(double levelDn) const
  {
    return m_IsShotNoiseKnown ? m_NoiseLine.gain * (levelDn - m_OffsetDn) / m_NoiseLine.At(levelDn) : 1.0;
  }

  const ReferenceFrame &            m_Frame;
  const TemporalBasis &             m_Basis;
  const std::vector<std::uint8_t> & m_Mask;
  ParallelFor                       m_ParallelFor;
  double                            m_Gain{ 0.0 };
  CodeNoise                         m_CodeNoise; // its remainder is subtracted from the variance
  std::vector<double>               m_Variance;
  std::vector<float>                m_Skew; // sum_i S_i sum_j K_ij [DN]
  std::vector<float>                m_Divisor;
  std::vector<float>                m_Ratios; // variance relative to a uniform sensor [1]; empty: 1
  std::vector<float>                m_Dof;    // effective degrees of freedom; empty: equal to the divisor
  FrameDof                          m_FrameDof;
  VarianceLine                      m_NoiseLine; // gives the fraction of shot noise for m_Dof
  double                            m_OffsetDn{ 0.0 };
  bool                              m_IsShotNoiseKnown{ true };
  std::vector<std::uint8_t>         m_ClassOf;
};

} // namespace sensornoise

#endif
