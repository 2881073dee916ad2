// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/pixels/ProjectedVariance.h"

#include "sensornoise/base/BoxSum.h"
#include "sensornoise/base/Eigen.h"
#include "sensornoise/base/FirstTouch.h"
#include "sensornoise/base/Parallel.h"
#include "sensornoise/base/Quantiles.h"
#include "sensornoise/base/Stencils.h"
#include "sensornoise/base/WideVectors.h"
#include "sensornoise/pixels/Constants.h"
#include "sensornoise/pixels/VarianceLine.h"
#include "sensornoise/scene/ProvisionalModel.h"
#include "sensornoise/scene/ReferenceFrame.h"
#include "sensornoise/series/MotionSeries.h"
#include "sensornoise/series/TemporalBasis.h"

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
/** D' G^-1 D of pixel \a p; 0 where it is below \a negligible, by the bound K sum_k D_k^2 (G^-1)_kk for K series. */
double
Leverage(const ReferenceFrame & frame, const MotionSeries & motion, std::size_t p, double negligible)
{
  const std::size_t                    size = motion.stencils.size();
  const auto                           all = ApplyStencils(frame.mean.data(), frame.geometry.width, p);
  std::array<double, NumberOfStencils> derivatives{};
  double                               bound = 0.0;
  for (std::size_t k = 0; k < size; ++k)
  {
    derivatives[k] = all[motion.stencils[k]];
    bound += derivatives[k] * derivatives[k] * motion.inverseGram.data()[k * size + k];
  }
  if (static_cast<double>(size) * bound < negligible)
  {
    return 0.0;
  }
  double sum = 0.0;
  for (std::size_t i = 0; i < size; ++i)
  {
    const double * inverse = motion.inverseGram.data() + i * size;
    sum += derivatives[i] * std::inner_product(inverse, inverse + size, derivatives.begin(), 0.0);
  }
  return sum;
}
} // namespace

ProjectedVariance::ProjectedVariance(const ReferenceFrame &            frame,
                                     const TemporalBasis &             basis,
                                     const MotionSeries &              motion,
                                     ResidualSquares                   squares,
                                     const ProvisionalModel &          model,
                                     const std::vector<std::uint8_t> & mask,
                                     const ParallelFor &               parallelFor)
  : m_Frame(frame)
  , m_Basis(basis)
  , m_Mask(mask)
  , m_ParallelFor(parallelFor)
  , m_Variance(std::move(squares.rss))
  , m_Skew(std::move(squares.skew))
  , m_Freedom(MakeMap<float>(frame.mean.size(), parallelFor))
  , m_ClassOf(frame.mean.size(), 0)
{
  this->CountFreedom(motion, model);
  this->Classify(model);
}

void
ProjectedVariance::Compute(double gain)
{
  const double more = gain - std::exchange(m_Gain, gain);
  ForBlocks(m_Mask.size(), m_ParallelFor, [&](std::size_t begin, std::size_t end) {
    WithWideVectors(
      [=, mask = m_Mask.data(), skew = m_Skew.data(), freedom = m_Freedom.data(), own = m_Variance.data()] {
        for (std::size_t p = begin; p < end; ++p)
        {
          const double added = more * skew[p] / freedom[p]; // outside of the condition, or no vectors
          own[p] += mask[p] != 0 ? added : 0.0;
        }
      });
  });
}

void
ProjectedVariance::TakeOffRest(const CodeNoise & noise)
{
  if (noise.restsDn2.empty())
  {
    return;
  }
  ForBlocks(m_Mask.size(), m_ParallelFor, [&](std::size_t begin, std::size_t end) {
    for (std::size_t p = begin; p < end; ++p)
    {
      m_Variance[p] -= m_Mask[p] != 0 ? noise.RestAt(m_Frame.mean[p]) : 0.0;
    }
  });
}

VarianceData
ProjectedVariance::GetData(const std::vector<std::uint8_t> & mask) const
{
  return { m_Frame.mean.data(), m_Frame.neighbourMean.data(), m_Variance.data(), m_Freedom.data(), mask.data(),
           mask.size() };
}

void
ProjectedVariance::CountFreedom(const MotionSeries & motion, const ProvisionalModel & model)
{
  const auto   frames = static_cast<double>(m_Frame.frames);
  const double freedom = frames - 1.0 - static_cast<double>(m_Basis.Size());
  ForBlocks(m_Mask.size(), m_ParallelFor, [&](std::size_t begin, std::size_t end) {
    for (std::size_t p = begin; p < end; ++p)
    {
      if (m_Mask[p] != 0)
      {
        const double noise = model.NoiseVariance(m_Frame.neighbourMean[p]);
        const double leverage = Leverage(m_Frame, motion, p, 1e-5 * noise) / noise;
        m_Freedom[p] = static_cast<float>(freedom * (1.0 - std::min(InPixels.largestLeverage, leverage)));
        m_Variance[p] /= m_Freedom[p];
      }
      else
      {
        m_Variance[p] = 0.0;
      }
    }
  });
}

void
ProjectedVariance::Classify(const ProvisionalModel & model)
{
  const std::size_t width = m_Frame.geometry.width;
  auto              energy = MakeMap<float>(m_Mask.size(), m_ParallelFor);
  ForBlocks(m_Mask.size(), m_ParallelFor, [&](std::size_t begin, std::size_t end) {
    for (std::size_t p = begin; p < end; ++p)
    {
      if (m_Frame.usable[p] != 0)
      {
        energy[p] = static_cast<float>(StencilEnergy(ApplyStencils(m_Frame.mean.data(), width, p)));
      }
    }
  });
  const double sd = std::sqrt(std::max(model.vibrationXPixels2, model.vibrationYPixels2));
  const auto   radius = static_cast<std::size_t>(
    sd < InPixels.smallMotion ? 2.0 : 2.0 + std::ceil(InPixels.motionSds * std::min(sd, InPixels.largestMotion)));
  // Twice, for a sample and for all: the sums are cheaper to make than to hold.
  const auto forRoughness = [&](const auto & use) {
    const auto rows = [&] { return RowsOf(energy, width); };
    ForBoxRows(rows, width, m_Frame.geometry.height, radius, m_ParallelFor, [&](std::size_t y, const double * sums) {
      use(y * width, (y + 1) * width, [&, first = y * width](std::size_t p) {
        return sums[p - first] / model.NoiseVariance(m_Frame.neighbourMean[p]);
      });
    });
  };
  const std::vector<std::size_t> pixels = SamplePixels(m_Mask);
  std::vector<double>            sample(pixels.size());
  forRoughness([&](std::size_t begin, std::size_t end, const auto & roughnessOf) {
    const auto first = std::lower_bound(pixels.begin(), pixels.end(), begin);
    const auto last = std::lower_bound(first, pixels.end(), end);
    std::transform(first, last, sample.begin() + (first - pixels.begin()), roughnessOf);
  });
  std::vector<double> edges;
  for (std::size_t c = 1; c < Classes && !sample.empty(); ++c)
  {
    // 15 classes up to the quantile 0.9, then 8 to 0.995.
    const double rank = c <= 15 ? 0.06 * static_cast<double>(c) : 0.92 + 0.075 * static_cast<double>(c - 16) / 7.0;
    edges.push_back(Quantile(sample, rank));
  }
  forRoughness([&](std::size_t begin, std::size_t end, const auto & roughnessOf) {
    for (std::size_t p = begin; p < end; ++p)
    {
      m_ClassOf[p] =
        static_cast<std::uint8_t>(CountEdges(edges, [own = roughnessOf(p)](double edge) { return edge < own; }));
    }
  });
}

} // namespace sensornoise
