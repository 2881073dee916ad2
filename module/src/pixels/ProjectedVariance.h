// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_pixels_ProjectedVariance_h
#define sensornoise_pixels_ProjectedVariance_h

#include "SensorNoiseExport.h"
#include "sensornoise/Parallel.h"
#include "pixels/CodeNoise.h"
#include "pixels/FrameFreedom.h"
#include "pixels/ResidualSquares.h"
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
struct ProvisionalModel;
struct ReferenceFrame;

/** \class ProjectedVariance
 * \brief Every pixel's variance after what is not sensor noise has been taken out of its time series.
 *
 * With the coordinates S_j of the time series in the basis, J of them, and the sum of squares SS about the mean,
 *
 *     RSS = SS - sum_j S_j^2,   K_ij = sum_t Q_tj^2 Q_ti,
 *
 *     V = (RSS + g sum_i S_i sum_j K_ij) / ((T - 1 - J) (1 - h)).
 *
 * The pixel's response to each series is free: the projection is exact on edges, for any optics and interpolation, for
 * pixels of different sensitivity, and for light that differs over the frame. Estimator.md, 3.5, which this simplifies:
 *
 * - The noise changes with the light, so a series that lives on the frames in which a pixel is bright takes out more
 *   than its share. The coordinates themselves tell how the pixel's light changes, by flicker or by motion: the second
 *   term, 0.1 to 0.5 % of g.
 * - The motion series were estimated from the same pixels and follow their noise by the pixel's leverage,
 *   h = w D' G^-1 D, which counts in the few pixels that dominate the regression.
 * - With both, every series can be projected out of every pixel, for 5 to 15 % of the degrees of freedom; no class of
 *   pixels need be told which series it pays for, and no bias below a threshold is left.
 * - The squares are divided by (T - 1 - J) (1 - h); how precise the variance is, is another number where the
 *   illumination changes strongly, see FrameFreedom.
 *
 * Pixels are sorted into RoughnessClasses for the test of fit (JudgeClasses). */
class SensorNoise_EXPORT ProjectedVariance
{
public:
  static constexpr std::size_t Classes = RoughnessClasses;

  /** \a squares are those of the basis' coordinates. All references must outlive the object. */
  ProjectedVariance(const ReferenceFrame &            frame,
                    const TemporalBasis &             basis,
                    const MotionSeries &              motion,
                    ResidualSquares                   squares,
                    const ProvisionalModel &          model,
                    const std::vector<std::uint8_t> & mask,
                    const ParallelFor &               parallelFor);

  /** Takes off what of the noise of rounding is no line. */
  void
  TakeOffRest(const CodeNoise & noise);

  /** Other squares of pixel \a p of the mask, whose expectation is \a freedom times its variance: that of a frame's
   * tiles may be known with what their rows share taken off. Before SetIllumination() and Compute(). */
  void
  ReplaceSquares(std::size_t p, double squares, double freedom);

  /** Allows for frames of different noise: \a gamma + 1 is the illumination factor of each frame, for which \a offsetDn
   * is the dark offset. The shot noise of the pixels is that of the provisional model, until Compute(line); if it is
   * not \a isShotNoiseKnown, all of their noise, with the least degrees of freedom that these frames allow. */
  void
  SetIllumination(const std::vector<double> & gamma, double offsetDn, bool isShotNoiseKnown = true);

  /** Computes the variance with another gain [DN/e-], which serves the noise that changes with the light; at first it
   * is 0. */
  void
  Compute(double gain);
  /** The same, and the degrees of freedom with the shot noise that \a line has. */
  void
  Compute(const VarianceLine & line);

  /** Divides the variance of every pixel by its ratio to that of a common sensor, see MapOfRatios() [1]; empty: leaves
   * the variance as it is. What was set before is undone. */
  void
  SetRatios(std::vector<float> ratios);
  /** Whether the variance is divided by ratios. */
  bool
  HasRatios() const
  {
    return !m_Ratios.empty();
  }
  /** The variance as it was measured, without the ratios [DN^2]. */
  std::vector<double>
  MeasuredVariance() const;

  /** The gain of the last Compute() [DN/e-]. */
  double
  GetGain() const
  {
    return m_Gain;
  }
  /** [DN^2]; 0 outside the mask. */
  const std::vector<double> &
  GetVariance() const
  {
    return m_Variance;
  }
  /** Gives the measured variance away. */
  std::vector<double>
  TakeVariance()
  {
    this->SetRatios({});
    return std::move(m_Variance);
  }
  /** Effective degrees of freedom of every pixel's variance, by which it scatters; 0 outside the mask. */
  const std::vector<float> &
  GetFreedom() const
  {
    return m_Freedom.empty() ? m_Divisor : m_Freedom;
  }
  /** What every pixel's squares are divided by: (T - 1 - J) (1 - h); 0 outside the mask. */
  const std::vector<float> &
  GetDivisor() const
  {
    return m_Divisor;
  }
  /** The fraction of the degrees of freedom that the change of the illumination leaves to pixels of a level [1]. */
  double
  FreedomFractionAt(double levelDn) const
  {
    return m_FrameFreedom.IsEqual() ? 1.0 : m_FrameFreedom.FractionAt(this->ShotFractionAt(levelDn));
  }
  /** Whether frames differ in their noise by as much as counts. */
  bool
  HasUnequalFrames() const
  {
    return !m_FrameFreedom.IsEqual();
  }
  /** What the gain is multiplied by in the squares of each pixel: sum_i S_i sum_j K_ij [DN]. */
  const std::vector<float> &
  GetSkew() const
  {
    return m_Skew;
  }
  /** The class of roughness of pixel \a p, from 0, flat, to Classes - 1. */
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
  /** Divides the squares of the mask's pixels. */
  void
  DivideSquares(const MotionSeries & motion, const ProvisionalModel & model);
  /** The effective degrees of freedom of the mask's pixels. */
  void
  CountFreedom();
  /** The fraction of the variance that is shot noise, by the neighbours' mean [1]. */
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
  CodeNoise                         m_CodeNoise; // of which the rest is taken off
  std::vector<double>               m_Variance;
  std::vector<float>                m_Skew; // sum_i S_i sum_j K_ij
  std::vector<float>                m_Divisor;
  std::vector<float>                m_Ratios;  // empty: 1
  std::vector<float>                m_Freedom; // empty: equal to the divisor
  FrameFreedom                      m_FrameFreedom;
  VarianceLine                      m_NoiseLine; // by which m_Freedom was counted
  double                            m_OffsetDn{ 0.0 };
  bool                              m_IsShotNoiseKnown{ true };
  std::vector<std::uint8_t>         m_ClassOf;
};

} // namespace sensornoise

#endif
