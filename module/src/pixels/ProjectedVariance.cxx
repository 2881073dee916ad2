// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "pixels/ProjectedVariance.h"

#include "base/BoxSum.h"
#include "base/FirstTouch.h"
#include "sensornoise/Parallel.h"
#include "base/Stencils.h"
#include "base/Avx2.h"
#include "pixels/Constants.h"
#include "pixels/MotionLeverage.h"
#include "pixels/VarianceLine.h"
#include "scene/InitialNoiseModel.h"
#include "scene/ReferenceFrame.h"
#include "series/MotionSeries.h"
#include "series/TemporalBasis.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace sensornoise
{

ProjectedVariance::ProjectedVariance(const ReferenceFrame &            frame,
                                     const TemporalBasis &             basis,
                                     const MotionSeries &              motion,
                                     ResidualSquares                   squares,
                                     const InitialNoiseModel &         model,
                                     const std::vector<std::uint8_t> & mask,
                                     const ParallelFor &               parallelFor)
  : m_Frame(frame)
  , m_Basis(basis)
  , m_Mask(mask)
  , m_ParallelFor(parallelFor)
  , m_Variance(std::move(squares.rss))
  , m_Skew(std::move(squares.skew))
  , m_Divisor(MakeMap<float>(frame.mean.size(), parallelFor))
  , m_ClassOf(ClassifyRoughness(frame, model, mask, parallelFor))
{
  m_NoiseLine.gain = model.slopeDn;
  m_NoiseLine.intercept = model.interceptDn2 - model.slopeDn * model.darkestDn;
  m_NoiseLine.lowestDn2 = model.interceptDn2;
  this->DivideSquares(motion, model);
}

void
ProjectedVariance::ReplaceSquares(std::size_t p, double squares, double dof)
{
  const double all = static_cast<double>(m_Frame.frames) - 1.0 - static_cast<double>(m_Basis.Size());
  m_Divisor[p] = static_cast<float>(static_cast<double>(m_Divisor[p]) * dof / all);
  m_Variance[p] = squares / static_cast<double>(m_Divisor[p]);
  if (!m_CodeNoise.remaindersDn2.empty())
  {
    m_Variance[p] -= m_CodeNoise.RemainderAt(m_Frame.mean[p]);
  }
}

void
ProjectedVariance::SetIllumination(const std::vector<double> & gamma, double offsetDn, bool isShotNoiseKnown)
{
  m_FrameDof = FrameDof(m_Basis.GetBasis(), gamma);
  m_OffsetDn = offsetDn;
  m_IsShotNoiseKnown = isShotNoiseKnown;
  this->ComputeDof();
}

void
ProjectedVariance::Compute(const VarianceLine & line)
{
  this->Compute(line.gain);
  m_NoiseLine = line;
  this->ComputeDof();
}

void
ProjectedVariance::Compute(double gain)
{
  const double       more = gain - std::exchange(m_Gain, gain);
  std::vector<float> ratios = m_Ratios;
  this->SetRatios({});
  ForBlocks(m_Mask.size(), m_ParallelFor, [&](std::size_t begin, std::size_t end) {
    CallWithAvx2([=, mask = m_Mask.data(), skew = m_Skew.data(), divisor = m_Divisor.data(), own = m_Variance.data()] {
      for (std::size_t p = begin; p < end; ++p)
      {
        // Outside of the condition, so that SIMD instructions are used.
        const double added = more * skew[p] / divisor[p];
        own[p] += mask[p] != 0 ? added : 0.0;
      }
    });
  });
  this->SetRatios(std::move(ratios));
}

void
ProjectedVariance::SetRatios(std::vector<float> ratios)
{
  if (!m_Ratios.empty())
  {
    m_Variance = this->MeasuredVariance();
  }
  m_Ratios = std::move(ratios);
  if (!m_Ratios.empty())
  {
    ForPixels(m_Variance.size(), m_ParallelFor, [this](std::size_t p) { m_Variance[p] /= m_Ratios[p]; });
  }
}

std::vector<double>
ProjectedVariance::MeasuredVariance() const
{
  std::vector<double> measured = m_Variance;
  if (!m_Ratios.empty())
  {
    ForPixels(measured.size(), m_ParallelFor, [&](std::size_t p) { measured[p] *= m_Ratios[p]; });
  }
  return measured;
}

void
ProjectedVariance::SubtractRemainder(const CodeNoise & noise)
{
  m_CodeNoise = noise;
  if (noise.remaindersDn2.empty())
  {
    return;
  }
  ForBlocks(m_Mask.size(), m_ParallelFor, [&](std::size_t begin, std::size_t end) {
    for (std::size_t p = begin; p < end; ++p)
    {
      m_Variance[p] -= m_Mask[p] != 0 ? noise.RemainderAt(m_Frame.mean[p]) : 0.0;
    }
  });
}

VarianceData
ProjectedVariance::GetData(const std::vector<std::uint8_t> & mask) const
{
  return { m_Frame.mean.data(), m_Frame.neighbourMean.data(), m_Variance.data(), this->GetDof().data(), mask.data(),
           mask.size() };
}

void
ProjectedVariance::DivideSquares(const MotionSeries & motion, const InitialNoiseModel & model)
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
        const double      share = 1.0 - std::min(InPixels.largestLeverage, taken);
        m_Divisor[p] = m_Mask[p] != 0 ? static_cast<float>(all * share) : 0.0F;
        m_Variance[p] = m_Mask[p] != 0 ? m_Variance[p] / m_Divisor[p] : 0.0;
      }
    }
  });
}

void
ProjectedVariance::ComputeDof()
{
  if (m_FrameDof.IsEqual())
  {
    m_Dof.clear();
    return;
  }
  if (m_Dof.empty())
  {
    m_Dof = MakeMap<float>(m_Divisor.size(), m_ParallelFor);
  }
  ForPixels(m_Dof.size(), m_ParallelFor, [this](std::size_t p) {
    const double fraction = m_Mask[p] != 0 ? this->DofFractionAtPixel(m_Frame.neighbourMean[p]) : 0.0;
    m_Dof[p] = static_cast<float>(fraction * m_Divisor[p]);
  });
}

} // namespace sensornoise
