// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_pixels_ProjectedVariance_h
#define sensornoise_pixels_ProjectedVariance_h

#include "SensorNoiseExport.h"
#include "base/PixelMap.h"
#include "pixels/RoughnessClasses.h"
#include "pixels/VarianceLine.h"
#include "pixels/QuantisationNoise.h"
#include "pixels/ProjectionSums.h"
#include "sensornoise/Parallel.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

namespace sensornoise
{

class TemporalBasis;
struct MotionSeries;
struct InitialNoiseModel;
struct ReferenceFrame;

/** Squares that replace the residual squares of some pixels, such as squares without the noise that is common to a
 * row. */
struct ReplacedSquares
{
  std::vector<std::size_t> pixels;
  std::vector<double>      squares;    ///< sum of squares of each of \a pixels [DN^2]
  double                   dof{ 0.0 }; ///< expectation of the squares over the variance of their pixel
};

/** Illumination of the frames, by which their noise differs. */
struct FrameIllumination
{
  std::vector<double> gamma{};         ///< illumination factor of each frame minus 1; empty: the frames are equal
  double              offsetDn{ 0.0 }; ///< dark offset [DN]
  /** Whether a line of the pixels gives the fraction of shot noise. If not, all noise is taken to be shot noise, which
   * gives the fewest degrees of freedom. */
  bool isShotNoiseKnown{ true };
};

/** \class ProjectedSquares
 * \brief Residual squares of every pixel, divided by their degrees of freedom: all of the variance that does not depend
 * on the gain.
 *
 * Constant after construction. ProjectedVariance is the variance for a gain. */
class SensorNoise_EXPORT ProjectedSquares
{
public:
  /** \a squares are the residual squares for the components of \a basis. The remainder of \a quantisationNoise, which
   * is not a line in the level, is subtracted. References to frame, basis and mask are kept, and must outlive the
   * object. */
  ProjectedSquares(const ReferenceFrame &            frame,
                   const TemporalBasis &             basis,
                   const MotionSeries &              motion,
                   ResidualSquares                   squares,
                   const InitialNoiseModel &         model,
                   const std::vector<std::uint8_t> & mask,
                   const ParallelFor &               parallelFor,
                   const FrameIllumination &         illumination = {},
                   const ReplacedSquares &           replaced = {},
                   const QuantisationNoise &         quantisationNoise = {});

  /** Returns the variance of every pixel with the correction of \a gain [DN/e-]; 0 outside the mask [DN^2]. */
  PixelVariance
  VarianceAt(double gain) const
  {
    const bool isDouble = m_Variance.GetPrecision() == Precision::Double;
    return { isDouble ? m_Variance.GetDoubles().data() : nullptr,
             m_PerGain.data(),
             nullptr,
             gain,
             isDouble ? nullptr : m_Variance.GetSingles().data() };
  }
  /** Moves this variance out of the object. */
  PixelMap
  TakeVarianceAt(double gain) &&;

  /** Returns the rise of each pixel's variance with the gain, sum_i S_i sum_j K_ij over the divisor [DN]. */
  const std::vector<float> &
  GetPerGain() const
  {
    return m_PerGain;
  }
  /** Returns the divisor of every pixel's squares, (T - 1 - J) (1 - h); 0 outside the mask. */
  const std::vector<float> &
  GetDivisor() const
  {
    return m_Divisor;
  }
  /** Returns the effective degrees of freedom of every pixel's variance, with the fraction of shot noise of \a line;
   * empty: they are equal to the divisor. 0 outside the mask. */
  std::vector<float>
  DofBy(const VarianceLine & line) const;
  /** Returns the fraction of the degrees of freedom that a change of the illumination leaves to pixels of a level, with
   * the fraction of shot noise of \a line [1]. */
  double
  DofFractionAt(double levelDn, const VarianceLine & line) const
  {
    const double shot =
      m_IsShotNoiseKnown ? line.gain * (levelDn - m_OffsetDn) / line.At(levelDn) : 1.0; // fraction of shot noise
    return m_FrameDof.IsEqual() ? 1.0 : m_FrameDof.DofFractionAt(shot);
  }
  /** Returns whether the noise differs from frame to frame by as much as matters, see FrameDof::IsEqual(). */
  bool
  HasUnequalNoise() const
  {
    return !m_FrameDof.IsEqual();
  }
  /** Returns the line of the initial noise model. */
  const VarianceLine &
  GetInitialLine() const
  {
    return m_InitialLine;
  }
  /** Returns the roughness class of every pixel, see ClassifyRoughness(). */
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

private:
  /** Divides the squares of the mask's pixels by their divisors. */
  void
  DivideSquares(const MotionSeries & motion, const InitialNoiseModel & model);
  void
  Replace(const ReplacedSquares & replaced);

  const ReferenceFrame &            m_Frame;
  const TemporalBasis &             m_Basis;
  const std::vector<std::uint8_t> & m_Mask;
  ParallelFor                       m_ParallelFor;
  PixelMap                          m_Variance; // variance for the gain 0 [DN^2]
  std::vector<float>                m_PerGain;  // rise of the variance with the gain [DN]
  std::vector<float>                m_Divisor;
  FrameDof                          m_FrameDof;
  double                            m_OffsetDn;
  bool                              m_IsShotNoiseKnown;
  VarianceLine                      m_InitialLine;
  std::vector<std::uint8_t>         m_ClassOf;
};

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
 * ProjectedSquares has the maps, from which the variance is computed where it is read: the object is small, and one is
 * made for each gain. Pixels are sorted into RoughnessClasses for the test of fit (TestClasses). */
class ProjectedVariance
{
public:
  /** Number of roughness classes. */
  static constexpr std::size_t Classes = RoughnessClasses;

  /** Ratio of the variance of each pixel to the variance of a uniform sensor, see MapOfRatios() [1]; null: 1. */
  using Ratios = std::shared_ptr<const std::vector<float>>;

  /** The variance with the correction of \a gain [DN/e-]. The initial noise model gives the fraction of shot noise.
   * \a squares must outlive the object. */
  ProjectedVariance(const ProjectedSquares & squares, double gain)
    : ProjectedVariance(squares, squares.GetInitialLine(), gain, nullptr)
  {}

  /** Returns the variance with the gain of \a line, its fraction of shot noise, and the ratios of this object. */
  ProjectedVariance
  WithLine(const VarianceLine & line) const
  {
    return { *m_Squares, line, line.gain, m_Ratios };
  }
  /** Returns the variance divided by \a ratios, otherwise as this object. */
  ProjectedVariance
  WithRatios(std::vector<float> ratios) const
  {
    return { *m_Squares, m_Line, m_Gain, std::make_shared<const std::vector<float>>(std::move(ratios)) };
  }
  /** Returns whether the variance is divided by ratios. */
  bool
  HasRatios() const
  {
    return m_Ratios != nullptr;
  }

  /** Returns the gain that corrects the variance [DN/e-]. */
  double
  GetGain() const
  {
    return m_Gain;
  }
  /** Returns the variance of every pixel [DN^2]; 0 outside the mask. */
  PixelVariance
  GetVariance() const
  {
    PixelVariance variance = m_Squares->VarianceAt(m_Gain);
    variance.ratios = m_Ratios ? m_Ratios->data() : nullptr;
    return variance;
  }
  /** Returns the effective degrees of freedom of every pixel's variance; 0 outside the mask. */
  const std::vector<float> &
  GetDof() const
  {
    return m_Dof.empty() ? m_Squares->GetDivisor() : m_Dof;
  }
  /** Returns ProjectedSquares::DofFractionAt() with the fraction of shot noise of this object [1]. */
  double
  DofFractionAtPixel(double levelDn) const
  {
    return m_Squares->DofFractionAt(levelDn, m_Line);
  }
  /** Returns the roughness class of pixel \a p, from 0 (flat) to Classes - 1. */
  std::uint8_t
  ClassOf(std::size_t p) const
  {
    return m_Squares->GetClasses()[p];
  }
  const ProjectedSquares &
  GetSquares() const
  {
    return *m_Squares;
  }
  const ReferenceFrame &
  GetFrame() const
  {
    return m_Squares->GetFrame();
  }
  /** Returns the maps for a regression. They are valid as long as this object. */
  SensorNoise_EXPORT VarianceData
  GetData(const std::vector<std::uint8_t> & mask) const;

private:
  ProjectedVariance(const ProjectedSquares & squares, const VarianceLine & line, double gain, Ratios ratios)
    : m_Squares(&squares)
    , m_Line(line)
    , m_Gain(gain)
    , m_Ratios(std::move(ratios))
    , m_Dof(squares.DofBy(line))
  {}

  const ProjectedSquares * m_Squares;
  VarianceLine             m_Line; // gives the fraction of shot noise
  double                   m_Gain;
  Ratios                   m_Ratios;
  std::vector<float>       m_Dof; // empty: equal to the divisor
};

} // namespace sensornoise

#endif
