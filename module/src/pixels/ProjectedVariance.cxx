// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "pixels/ProjectedVariance.h"

#include "base/BoxSum.h"
#include "base/Eigen.h"
#include "base/ParallelWork.h"
#include "base/Simd.h"
#include "base/Stencils.h"
#include "pixels/Constants.h"
#include "pixels/VarianceLine.h"
#include "scene/InitialNoiseModel.h"
#include "scene/ReferenceFrame.h"
#include "sensornoise/Parallel.h"
#include "series/FrameEquations.h"
#include "series/SceneSeries.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

namespace sensornoise
{

namespace
{
/** \class MotionLeverage
 * \brief Leverage of a pixel in the estimate of the motion, times its noise variance: D' G^-1 D, with its derivatives D
 * [DN^2].
 *
 * The motion was estimated from the same pixels, so the estimate follows the noise of each of them. This matters only
 * in the few pixels that dominate the regression. A bound, K sum_k D_k^2 (G^-1)_kk for K components, excludes the other
 * pixels row by row. The references must outlive the object. */
class MotionLeverage
{
public:
  /** Prepares the weights of the bound. */
  MotionLeverage(const ReferenceFrame & frame, const MotionSeries & motion);

  /** Sets bounds[x] to the bound of pixel x of row \a y [DN^2]. It is 0 at the StencilMargin pixels next to the left
   * and the right border. */
  void
  FillBounds(std::size_t y, double * bounds) const;

  /** Returns the leverage of pixel \a p times its noise variance [DN^2]. */
  double
  At(std::size_t p) const;

private:
  const ReferenceFrame &               m_Frame;
  const MotionSeries &                 m_Motion;
  std::array<double, NumberOfStencils> m_Weights{}; // weights of the squared derivatives in the bound
};

/** Adds the squares of a derivative along a row, times \a weight. Both pointers are at the first pixel that has a
 * derivative. */
template <std::size_t VStencil>
void
AddSquares(const double * row, std::size_t width, double weight, double * bounds)
{
  if (weight > 0.0)
  {
    for (std::size_t x = 0; x + 2 * StencilMargin < width; ++x)
    {
      const double derivative = detail::ValueOfStencil<VStencil>(row + x, static_cast<std::ptrdiff_t>(width));
      bounds[x] += weight * derivative * derivative;
    }
  }
}

template <std::size_t... VStencils>
void
AddAllSquares(const double *                               row,
              std::size_t                                  width,
              const std::array<double, NumberOfStencils> & weights,
              double *                                     bounds,
              std::index_sequence<VStencils...>)
{
  (AddSquares<VStencils>(row, width, weights[VStencils], bounds), ...);
}

MotionLeverage::MotionLeverage(const ReferenceFrame & frame, const MotionSeries & motion)
  : m_Frame(frame)
  , m_Motion(motion)
{
  const std::size_t size = motion.stencils.size();
  for (std::size_t k = 0; k < size; ++k)
  {
    m_Weights.at(motion.stencils[k]) = static_cast<double>(size) * motion.inverseGram.data()[k * size + k];
  }
}

void
MotionLeverage::FillBounds(std::size_t y, double * bounds) const
{
  const std::size_t    width = m_Frame.geometry.width;
  const double * const row = m_Frame.mean.data() + y * width;
  std::fill(bounds, bounds + width, 0.0);
  CallWithAvx2([this, row, width, bounds] {
    AddAllSquares(
      row + StencilMargin, width, m_Weights, bounds + StencilMargin, std::make_index_sequence<NumberOfStencils>());
  });
}

double
MotionLeverage::At(std::size_t p) const
{
  const std::size_t                    size = m_Motion.stencils.size();
  const auto                           all = ApplyStencils(m_Frame.mean.data(), m_Frame.geometry.width, p);
  std::array<double, NumberOfStencils> derivatives{};
  for (std::size_t k = 0; k < size; ++k)
  {
    derivatives[k] = all[m_Motion.stencils[k]];
  }
  double sum = 0.0;
  for (std::size_t i = 0; i < size; ++i)
  {
    const double * inverse = m_Motion.inverseGram.data() + i * size;
    sum += derivatives[i] * std::inner_product(inverse, inverse + size, derivatives.begin(), 0.0);
  }
  return sum;
}
} // namespace

ProjectedSquares::ProjectedSquares(const ReferenceFrame &            frame,
                                   const TemporalBasis &             basis,
                                   const MotionSeries &              motion,
                                   ResidualSquares                   squares,
                                   const InitialNoiseModel &         model,
                                   const std::vector<std::uint8_t> & mask,
                                   const ParallelFor &               parallelFor,
                                   const FrameIllumination &         illumination,
                                   const ReplacedSquares &           replaced,
                                   const QuantisationNoise &         quantisationNoise)
  : m_Frame(frame)
  , m_Basis(basis)
  , m_Mask(mask)
  , m_ParallelFor(parallelFor)
  , m_Variance(std::move(squares.rss))
  , m_PerGain(std::move(squares.skew))
  , m_Divisor(MakeMap<float>(frame.mean.size(), parallelFor))
  , m_FrameDof(illumination.gamma.empty() ? FrameDof() : FrameDof(basis.GetBasis(), illumination.gamma))
  , m_OffsetDn(illumination.offsetDn)
  , m_IsShotNoiseKnown(illumination.isShotNoiseKnown)
  , m_ClassOf(ClassifyRoughness(frame, model, mask, parallelFor))
{
  m_InitialLine.gain = model.slopeDn;
  m_InitialLine.intercept = model.interceptDn2 - model.slopeDn * model.darkestDn;
  m_InitialLine.lowestDn2 = model.interceptDn2;
  this->DivideSquares(motion, model);
  this->Replace(replaced);
  if (!quantisationNoise.remaindersDn2.empty())
  {
    ForPixels(m_Divisor.size(), m_ParallelFor, [&](std::size_t p) {
      m_Variance.Set(p, m_Variance[p] - (m_Mask[p] != 0 ? quantisationNoise.RemainderAt(m_Frame.mean[p]) : 0.0));
    });
  }
}

void
ProjectedSquares::Replace(const ReplacedSquares & replaced)
{
  const double all = static_cast<double>(m_Frame.frames) - 1.0 - static_cast<double>(m_Basis.Size());
  for (std::size_t i = 0; i < replaced.pixels.size(); ++i)
  {
    const std::size_t p = replaced.pixels[i];
    const auto        divisor = static_cast<float>(static_cast<double>(m_Divisor[p]) * replaced.dof / all);
    m_PerGain[p] *= m_Divisor[p] / divisor;
    m_Divisor[p] = divisor;
    m_Variance.Set(p, replaced.squares[i] / static_cast<double>(divisor));
  }
}

PixelMap
ProjectedSquares::TakeVarianceAt(double gain) &&
{
  ForPixels(m_Variance.size(), m_ParallelFor, [&](std::size_t p) {
    m_Variance.Set(p, m_Variance[p] + gain * static_cast<double>(m_PerGain[p]));
  });
  return std::move(m_Variance);
}

void
ProjectedSquares::DivideSquares(const MotionSeries & motion, const InitialNoiseModel & model)
{
  const MotionLeverage leverage(m_Frame, motion);
  const auto           frames = static_cast<double>(m_Frame.frames);
  const double         all = frames - 1.0 - static_cast<double>(m_Basis.Size());
  const std::size_t    width = m_Frame.geometry.width;
  ForBoxBands(m_Frame.geometry.height, m_ParallelFor, [&](std::size_t first, std::size_t last) {
    std::vector<double> bounds(width, 0.0);
    for (std::size_t y = first; y < last; ++y)
    {
      if (y >= StencilMargin && y + StencilMargin < m_Frame.geometry.height)
      {
        leverage.FillBounds(y, bounds.data());
      }
      for (std::size_t x = 0; x < width; ++x)
      {
        const std::size_t p = y * width + x;
        const double      noise = model.NoiseVariance(m_Frame.neighbourMean[p]);
        const double      taken = m_Mask[p] != 0 && !(bounds[x] < 1e-5 * noise) ? leverage.At(p) / noise : 0.0;
        const double      fraction = 1.0 - std::min(InPixels.largestLeverage, taken);
        m_Divisor[p] = m_Mask[p] != 0 ? static_cast<float>(all * fraction) : 0.0F;
        m_Variance.Set(p, m_Mask[p] != 0 ? m_Variance[p] / m_Divisor[p] : 0.0);
        m_PerGain[p] = m_Mask[p] != 0 ? m_PerGain[p] / m_Divisor[p] : 0.0F;
      }
    }
  });
}

std::vector<float>
ProjectedSquares::DofBy(const VarianceLine & line) const
{
  if (m_FrameDof.IsEqual())
  {
    return {};
  }
  auto dof = MakeMap<float>(m_Divisor.size(), m_ParallelFor);
  ForPixels(dof.size(), m_ParallelFor, [&](std::size_t p) {
    const double fraction = m_Mask[p] != 0 ? this->DofFractionAt(m_Frame.neighbourMean[p], line) : 0.0;
    dof[p] = static_cast<float>(fraction * m_Divisor[p]);
  });
  return dof;
}

VarianceData
ProjectedVariance::GetData(const std::vector<std::uint8_t> & mask) const
{
  const ReferenceFrame & frame = this->GetFrame();
  return { frame.mean.data(), frame.neighbourMean.data(), this->GetVariance(), this->GetDof().data(), mask.data(),
           mask.size() };
}

FrameDof::FrameDof(const Eigen::MatrixXd & basis, const std::vector<double> & gamma)
{
  const Eigen::Index    frames = basis.rows();
  const Eigen::VectorXd factor = Eigen::Map<const Eigen::VectorXd>(gamma.data(), frames).cwiseMax(-1.0);
  // P = 1 - Q Q', Q with the constant: sum_st P_st^2 gamma_s gamma_t = sum_t (1 - 2 h_t) gamma_t^2 + |Q' Gamma Q|^2.
  Eigen::MatrixXd q(frames, basis.cols() + 1);
  q << Eigen::VectorXd::Constant(frames, 1.0 / std::sqrt(static_cast<double>(frames))), basis;
  const Eigen::VectorXd leverage = q.cwiseAbs2().rowwise().sum();
  m_Dof = static_cast<double>(frames - q.cols());
  m_Linear = factor.dot(Eigen::VectorXd(1.0 - leverage.array()));
  m_Square = factor.cwiseAbs2().dot(Eigen::VectorXd(1.0 - 2.0 * leverage.array())) +
             (q.transpose() * factor.asDiagonal() * q).squaredNorm();
  // A single illuminated frame has no residual. The other frames are equal, but their mean is not the mean of all
  // frames.
  m_IsEqual = !(m_Dof > 0.0) || (this->DofFractionAt(1.0) > 1.0 - InPixels.leastLossOfDof &&
                                 std::abs(m_Linear) < InPixels.leastFeedback * m_Dof);
}

double
FrameDof::DofFractionAt(double shotFraction) const
{
  const double b = std::min(1.0, std::max(0.0, shotFraction)); // also makes NaN 0
  // Illuminated frames without residuals, and no read noise, leave no noise; then the frames count as equal.
  const double square = m_Dof + (2.0 * m_Linear + m_Square * b) * b;
  return square > m_Dof ? m_Dof / square : 1.0;
}

GainFeedback::GainFeedback(const ProjectedVariance &         projected,
                           const VarianceLine &              line,
                           const std::vector<std::uint8_t> & mask,
                           const ParallelFor &               parallelFor)
{
  // Sums of the weight times powers of x, the mean above the pivot, and times k.
  enum : std::size_t
  {
    W,
    WX,
    WXX,
    WK,
    WXK,
    Sums
  };
  const ReferenceFrame & frame = projected.GetFrame();
  const float * const    perGain = projected.GetSquares().GetPerGain().data();
  const float * const    dof = projected.GetDof().data();
  const auto   s = SumBlocks<Sums>(mask.size(), parallelFor, [&](std::size_t begin, std::size_t end, auto & sums) {
    for (std::size_t p = begin; p < end; ++p)
    {
      if (mask[p] != 0)
      {
        const double expected = line.At(frame.neighbourMean[p]);
        const double half = 0.5 * static_cast<double>(dof[p]);
        const double w = half / (expected * expected + half * line.noiseDispersionDn4);
        const double x = frame.mean[p] - line.pivotDn;
        const auto   k = static_cast<double>(perGain[p]);
        sums[W] += w;
        sums[WX] += w * x;
        sums[WXX] += w * x * x;
        sums[WK] += w * k;
        sums[WXK] += w * x * k;
      }
    }
  });
  const double determinant = s[W] * s[WXX] - s[WX] * s[WX];
  if (determinant > InPixels.leastDeterminant * s[W] * s[WXX])
  {
    m_OfGain = (s[W] * s[WXK] - s[WX] * s[WK]) / determinant;
    m_OfIntercept = (s[WK] - m_OfGain * (s[WX] + line.pivotDn * s[W])) / s[W];
  }
}

bool
GainFeedback::IsLarge() const
{
  return std::abs(m_OfGain) > InPixels.leastFeedback;
}

VarianceLine
GainFeedback::SolveFixedPoint(const VarianceLine & fitted, double gainPutIn) const
{
  VarianceLine settled = fitted;
  if (!this->IsLarge() || !fitted.isDetermined)
  {
    return settled;
  }
  if (m_OfGain > InPixels.largestFeedback)
  {
    // As large as a slope that explains all of the variance by the dispersion of the levels, whatever slope was fitted.
    const double          error = fitted.At(fitted.pivotDn) * std::sqrt(fitted.weightSum / fitted.spreadDn2);
    const Eigen::Vector2d direction(1.0, -fitted.pivotDn);
    settled.covariance += error * error * direction * direction.transpose();
    return settled;
  }
  settled.gain = (fitted.gain - m_OfGain * gainPutIn) / (1.0 - m_OfGain);
  settled.intercept += m_OfIntercept * (settled.gain - gainPutIn);
  Eigen::Matrix2d factor;
  factor << 1.0 / (1.0 - m_OfGain), 0.0, m_OfIntercept / (1.0 - m_OfGain), 1.0;
  settled.covariance = factor * fitted.covariance * factor.transpose();
  return settled;
}

} // namespace sensornoise
