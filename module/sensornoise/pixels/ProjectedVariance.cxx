// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/pixels/ProjectedVariance.h"

#include "sensornoise/base/BoxSum.h"
#include "sensornoise/base/Eigen.h"
#include "sensornoise/base/Parallel.h"
#include "sensornoise/base/Quantiles.h"
#include "sensornoise/base/Stencils.h"
#include "sensornoise/pixels/Constants.h"
#include "sensornoise/pixels/PixelCoordinates.h"
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
                                     const PixelCoordinates &          coordinates,
                                     const ProvisionalModel &          model,
                                     const std::vector<std::uint8_t> & mask,
                                     const ParallelFor &               parallelFor)
  : m_Frame(frame)
  , m_Basis(basis)
  , m_Coordinates(coordinates)
  , m_Mask(mask)
  , m_ParallelFor(parallelFor)
  , m_Rss(frame.mean.size(), 0.0)
  , m_Skew(frame.mean.size(), 0.0F)
  , m_Variance(frame.mean.size(), 0.0)
  , m_Freedom(frame.mean.size(), 0.0F)
  , m_ClassOf(frame.mean.size(), 0)
{
  this->SumCoordinates();
  this->CountFreedom(motion, model);
  this->Classify(model);
}

void
ProjectedVariance::Compute(double gain)
{
  ForBlocks(m_Mask.size(), m_ParallelFor, [&](std::size_t begin, std::size_t end) {
    for (std::size_t p = begin; p < end; ++p)
    {
      m_Variance[p] =
        m_Mask[p] != 0 ? (m_Rss[p] + gain * m_Skew[p]) / m_Freedom[p] - m_CodeNoise.RestAt(m_Frame.mean[p]) : 0.0;
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
ProjectedVariance::SumCoordinates()
{
  const Eigen::MatrixXd & q = m_Basis.GetBasis();
  const Eigen::VectorXd   skew = q.transpose() * q.cwiseAbs2().rowwise().sum();
  ForBlocks(m_Mask.size(), m_ParallelFor, [&](std::size_t begin, std::size_t end) {
    for (std::size_t first = begin; first < end; first += PixelCoordinates::BlockPixels)
    {
      const std::size_t pixels = std::min(PixelCoordinates::BlockPixels, end - first);
      std::copy_n(m_Frame.squares.data() + first, pixels, m_Rss.data() + first);
      for (std::size_t j = 0; j < m_Basis.Size(); ++j)
      {
        const double * coordinates = m_Coordinates.Of(first, j);
        const double   factor = skew(static_cast<Eigen::Index>(j));
        for (std::size_t i = 0; i < pixels; ++i)
        {
          m_Rss[first + i] -= coordinates[i] * coordinates[i];
          m_Skew[first + i] += static_cast<float>(factor * coordinates[i]);
        }
      }
    }
  });
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
      }
    }
  });
}

void
ProjectedVariance::Classify(const ProvisionalModel & model)
{
  const std::size_t  width = m_Frame.geometry.width;
  std::vector<float> energy(m_Mask.size(), 0.0F);
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
  std::vector<double> roughness = BoxSum(energy, width, m_Frame.geometry.height, radius, m_ParallelFor);
  std::vector<double> sample;
  ForBlocks(roughness.size(), m_ParallelFor, [&](std::size_t begin, std::size_t end) {
    for (std::size_t p = begin; p < end; ++p)
    {
      roughness[p] /= model.NoiseVariance(m_Frame.neighbourMean[p]);
    }
  });
  for (const std::size_t p : SamplePixels(m_Mask))
  {
    sample.push_back(roughness[p]);
  }
  std::vector<double> edges;
  for (std::size_t c = 1; c < Classes && !sample.empty(); ++c)
  {
    // 15 classes up to the quantile 0.9, then 8 to 0.995.
    const double rank = c <= 15 ? 0.06 * static_cast<double>(c) : 0.92 + 0.075 * static_cast<double>(c - 16) / 7.0;
    edges.push_back(Quantile(sample, rank));
  }
  ForBlocks(roughness.size(), m_ParallelFor, [&](std::size_t begin, std::size_t end) {
    for (std::size_t p = begin; p < end; ++p)
    {
      m_ClassOf[p] =
        static_cast<std::uint8_t>(CountEdges(edges, [own = roughness[p]](double edge) { return edge < own; }));
    }
  });
}

} // namespace sensornoise
