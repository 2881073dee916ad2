// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_pixels_ProjectedSquares_h
#define sensornoise_pixels_ProjectedSquares_h

#include "SensorNoiseExport.h"
#include "pixels/CodeNoise.h"
#include "pixels/ProjectionSums.h"
#include "pixels/UnequalIllumination.h"
#include "pixels/VarianceLine.h"
#include "sensornoise/Parallel.h"

#include <cstddef>
#include <cstdint>
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
  /** \a squares are the residual squares for the components of \a basis. The remainder of \a codeNoise, which is not a
   * line in the level, is subtracted. References to frame, basis and mask are kept, and must outlive the object. */
  ProjectedSquares(const ReferenceFrame &            frame,
                   const TemporalBasis &             basis,
                   const MotionSeries &              motion,
                   ResidualSquares                   squares,
                   const InitialNoiseModel &         model,
                   const std::vector<std::uint8_t> & mask,
                   const ParallelFor &               parallelFor,
                   const FrameIllumination &         illumination = {},
                   const ReplacedSquares &           replaced = {},
                   const CodeNoise &                 codeNoise = {});

  /** Returns the variance of every pixel with the correction of \a gain [DN/e-]; 0 outside the mask [DN^2]. */
  PixelVariance
  VarianceAt(double gain) const
  {
    return { m_Variance.data(), m_PerGain.data(), nullptr, gain };
  }
  /** Moves this variance out of the object. */
  std::vector<double>
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
  std::vector<double>               m_Variance; // variance for the gain 0 [DN^2]
  std::vector<float>                m_PerGain;  // rise of the variance with the gain [DN]
  std::vector<float>                m_Divisor;
  FrameDof                          m_FrameDof;
  double                            m_OffsetDn;
  bool                              m_IsShotNoiseKnown;
  VarianceLine                      m_InitialLine;
  std::vector<std::uint8_t>         m_ClassOf;
};

} // namespace sensornoise

#endif
