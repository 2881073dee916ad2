/*=========================================================================
 *
 *  Copyright the ITKSensorNoise contributors
 *
 *  Licensed under the Apache License, Version 2.0 (the "License");
 *  you may not use this file except in compliance with the License.
 *  You may obtain a copy of the License at
 *
 *         https://www.apache.org/licenses/LICENSE-2.0.txt
 *
 *  Unless required by applicable law or agreed to in writing, software
 *  distributed under the License is distributed on an "AS IS" BASIS,
 *  WITHOUT WARRANTIES OR CONDITIONS OF ANY KIND, either express or implied.
 *  See the License for the specific language governing permissions and
 *  limitations under the License.
 *
 *=========================================================================*/
#ifndef sensornoise_pixels_ProjectedVariance_h
#define sensornoise_pixels_ProjectedVariance_h

#include "sensornoise/base/BoxSum.h"
#include "sensornoise/base/Eigen.h"
#include "sensornoise/base/Parallel.h"
#include "sensornoise/base/Quantiles.h"
#include "sensornoise/base/Stencils.h"
#include "sensornoise/pixels/ProjectionSums.h"
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
 *
 * Pixels are sorted into 24 classes by the energy of the derivatives in their neighbourhood over the noise, for the
 * test of fit (JudgeClasses). */
class ProjectedVariance
{
public:
  static constexpr std::size_t Classes = 24;

  /** Turns \a sums into coordinates and keeps it. All references must outlive the object. */
  ProjectedVariance(const ReferenceFrame &            frame,
                    const TemporalBasis &             basis,
                    const MotionSeries &              motion,
                    ProjectionSums &                  sums,
                    const ProvisionalModel &          model,
                    const std::vector<std::uint8_t> & mask,
                    const ParallelFor &               parallelFor)
    : m_Frame(frame)
    , m_Basis(basis)
    , m_Sums(sums)
    , m_Mask(mask)
    , m_ParallelFor(parallelFor)
    , m_Rss(frame.mean.size(), 0.0)
    , m_Skew(frame.mean.size(), 0.0F)
    , m_Variance(frame.mean.size(), 0.0)
    , m_Freedom(frame.mean.size(), 0.0F)
    , m_ClassOf(frame.mean.size(), 0)
  {
    const Eigen::MatrixXd & q = basis.GetBasis();
    const Eigen::VectorXd   skew = q.transpose() * q.cwiseAbs2().rowwise().sum();
    const auto              frames = static_cast<double>(frame.frames);
    const double            freedom = frames - 1.0 - static_cast<double>(basis.Size());
    ForBlocks(mask.size(), parallelFor, [&](std::size_t begin, std::size_t end) {
      constexpr std::size_t block = ProjectionSums::BlockPixels;
      for (std::size_t p = begin; p < end; p += block)
      {
        this->Project(p, std::min(block, end - p), skew);
      }
      for (std::size_t p = begin; p < end; ++p)
      {
        if (mask[p] != 0)
        {
          const double noise = model.NoiseVariance(frame.neighbourMean[p]);
          const double leverage = this->Leverage(motion, p, 1e-5 * noise) / noise;
          m_Freedom[p] = static_cast<float>(freedom * (1.0 - std::min(0.5, leverage)));
        }
      }
    });
    this->Classify(model);
  }

  /** Computes the variance; \a gain serves the noise that changes with the light. */
  void
  Compute(double gain)
  {
    ForBlocks(m_Mask.size(), m_ParallelFor, [&](std::size_t begin, std::size_t end) {
      for (std::size_t p = begin; p < end; ++p)
      {
        m_Variance[p] = m_Mask[p] != 0 ? (m_Rss[p] + gain * m_Skew[p]) / m_Freedom[p] : 0.0;
      }
    });
  }

  /** [DN^2]; 0 outside the mask. */
  const std::vector<double> &
  GetVariance() const
  {
    return m_Variance;
  }
  /** Gives the variance away. */
  std::vector<double>
  TakeVariance()
  {
    return std::move(m_Variance);
  }
  const std::vector<float> &
  GetFreedom() const
  {
    return m_Freedom;
  }
  std::uint8_t
  ClassOf(std::size_t p) const
  {
    return m_ClassOf[p];
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
  /** The coordinates of the mask's pixels. */
  const ProjectionSums &
  GetCoordinates() const
  {
    return m_Sums;
  }
  VarianceData
  GetData(const std::vector<std::uint8_t> & mask) const
  {
    return { m_Frame.mean.data(), m_Frame.neighbourMean.data(), m_Variance.data(), m_Freedom.data(), mask.data(),
             mask.size() };
  }

private:
  /** Coordinates, residual squares and skew term of \a pixels pixels of one block of the sums. */
  void
  Project(std::size_t first, std::size_t pixels, const Eigen::VectorXd & skew)
  {
    if (m_Basis.Size() > 0)
    {
      m_Basis.ToCoordinates(&m_Sums.At(first, 0), ProjectionSums::BlockPixels, m_Frame.mean.data() + first, pixels);
    }
    std::copy_n(m_Frame.squares.data() + first, pixels, m_Rss.data() + first);
    for (std::size_t j = 0; j < m_Basis.Size(); ++j)
    {
      const double * coordinates = &m_Sums.At(first, j);
      const double   factor = skew(static_cast<Eigen::Index>(j));
      for (std::size_t i = 0; i < pixels; ++i)
      {
        m_Rss[first + i] -= coordinates[i] * coordinates[i];
        m_Skew[first + i] += static_cast<float>(factor * coordinates[i]);
      }
    }
  }

  /** D' G^-1 D of pixel \a p; 0 where it is below \a negligible, by the bound K sum_k D_k^2 (G^-1)_kk for K series. */
  double
  Leverage(const MotionSeries & motion, std::size_t p, double negligible) const
  {
    const std::size_t                    size = motion.stencils.size();
    const auto                           all = ApplyStencils(m_Frame.mean.data(), m_Frame.geometry.width, p);
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

  void
  Classify(const ProvisionalModel & model)
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
    const double        sd = std::sqrt(std::max(model.vibrationXPixels2, model.vibrationYPixels2));
    const auto          radius = static_cast<std::size_t>(sd < 0.35 ? 2.0 : 2.0 + std::ceil(3.0 * std::min(sd, 4.0)));
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
          static_cast<std::uint8_t>(std::lower_bound(edges.begin(), edges.end(), roughness[p]) - edges.begin());
      }
    });
  }

  const ReferenceFrame &            m_Frame;
  const TemporalBasis &             m_Basis;
  ProjectionSums &                  m_Sums;
  const std::vector<std::uint8_t> & m_Mask;
  ParallelFor                       m_ParallelFor;
  std::vector<double>               m_Rss;
  std::vector<float>                m_Skew; // sum_i S_i sum_j K_ij
  std::vector<double>               m_Variance;
  std::vector<float>                m_Freedom;
  std::vector<std::uint8_t>         m_ClassOf;
};

} // namespace sensornoise

#endif
