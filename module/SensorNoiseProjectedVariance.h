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
#ifndef SensorNoiseProjectedVariance_h
#define SensorNoiseProjectedVariance_h

#include "SensorNoiseProjectionSums.h"
#include "SensorNoiseVarianceLine.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace sensornoise
{

/** How a texture class treats a series of the basis. */
enum class SeriesUse : std::uint8_t
{
  Ignored,   ///< it has no part in the pixels of the class
  Projected, ///< taken out of every pixel's time series, at the cost of a degree of freedom
  Subtracted ///< its prediction by the motion model is taken off: for short bursts
};

/** \class ProjectedVariance
 * \brief Every pixel's variance after what is not sensor noise has been taken out of its time series.
 *
 * With the coordinates S_j of the time series in the basis and the sum of squares SS about the mean,
 *
 *     RSS = SS - sum_{j projected} S_j^2,    V = (RSS + g sum_{j projected} sum_i S_i K_ij) / freedom,
 *     K_ij = sum_t Q_tj^2 Q_ti over the series i of light.
 *
 * The last term is there because the noise itself flickers: a series that lives on bright frames takes out more than
 * its share (0.1 to 0.5 % of g). As each pixel's own response S_i tells its flicker, no offset is needed.
 *
 * Which series a pixel pays for is decided by its texture class, 24 classes of the energy of the derivatives in the
 * neighbourhood over the noise, never by its own coordinates, which would select on the noise. A series is projected in
 * a class if the motion model predicts more than 0.002 V from it there, or if its mean square exceeds V by 5 standard
 * errors; light always. Where that would take more than 0.4 of the degrees of freedom, the weakest are subtracted
 * instead. Estimator.md, 3.5. */
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
    , m_Variance(frame.mean.size(), 0.0)
    , m_Freedom(frame.mean.size(), 0.0F)
    , m_ClassOf(frame.mean.size(), 0)
    , m_Use(Classes * basis.Size(), SeriesUse::Projected)
  {
    const auto frames = static_cast<double>(frame.frames);
    ForBlocks(mask.size(), parallelFor, [&](std::size_t begin, std::size_t end) {
      for (std::size_t p = begin; p < end; ++p)
      {
        basis.ToCoordinates(sums.OfPixel(p), frame.mean[p] * frames);
      }
    });
    const auto &          q = basis.GetBasis();
    const auto            light = static_cast<Eigen::Index>(basis.NumberOfLightFactors());
    const Eigen::MatrixXd squares = q.cwiseAbs2();
    m_LightShare = q.leftCols(light).transpose() * squares;
    Eigen::MatrixXd coefficients = Eigen::MatrixXd::Zero(q.rows(), NumberOfStencils);
    for (Eigen::Index k = 0; k < motion.coefficients.cols(); ++k)
    {
      coefficients.col(static_cast<Eigen::Index>(motion.stencils[static_cast<std::size_t>(k)])) =
        motion.coefficients.col(k);
    }
    m_Prediction = q.transpose() * coefficients;
    const Eigen::MatrixXd kernels = detail::KernelGram().bottomRightCorner<NumberOfStencils, NumberOfStencils>();
    m_PredictionNoise = (m_Prediction * kernels * m_Prediction.transpose()).diagonal() / frames;
    this->Classify(model);
  }

  /** Computes the variance with the series that the classes use; \a gain serves the flickering noise. */
  void
  Compute(double gain)
  {
    ForBlocks(m_Mask.size(), m_ParallelFor, [&](std::size_t begin, std::size_t end) {
      for (std::size_t p = begin; p < end; ++p)
      {
        if (m_Mask[p] != 0)
        {
          this->ComputePixel(p, gain);
        }
      }
    });
  }

  /** Decides which series each class projects, from the variances of a first line. */
  void
  ChooseSeries(const VarianceLine & line)
  {
    const std::size_t series = m_Basis.Size();
    const std::size_t stride = 2 + 2 * series;
    const double      spread = 6.0 * std::sqrt(2.0 / static_cast<double>(m_Frame.frames - 1 - series));
    const auto sums = SumOverBlocks(m_Mask.size(), m_ParallelFor, Classes * stride, [&](std::size_t p, double * s) {
      const double ratio = m_Variance[p] / line.At(m_Frame.mean[p]);
      if (m_Mask[p] != 0 && ratio > 0.0 && ratio < 1.0 + spread)
      {
        const double   noise = line.At(m_Frame.mean[p]);
        const double   w = noise / std::pow(line.At(m_Frame.neighbourMean[p]), 2);
        const double * coordinates = m_Sums.OfPixel(p);
        double *       own = s + m_ClassOf[p] * stride;
        const auto     derivatives = this->Derivatives(p);
        own[0] += 1.0;
        own[1] += w * noise;
        for (std::size_t j = m_Basis.NumberOfLightFactors(); j < series; ++j)
        {
          const double predicted = this->Predict(derivatives, j);
          own[2 + j] += w * (predicted * predicted - m_PredictionNoise(static_cast<Eigen::Index>(j)) * noise);
          own[2 + series + j] +=
            w * (coordinates[j] * coordinates[j] - noise - line.gain * this->FlickeringNoise(coordinates, j));
        }
      }
    });
    const auto most = static_cast<std::size_t>(std::max(1.0, 0.4 * static_cast<double>(m_Frame.frames - 1)));
    for (std::size_t c = 0; c < Classes; ++c)
    {
      const double *                              own = sums.data() + c * stride;
      std::vector<std::pair<double, std::size_t>> wanted;
      std::size_t                                 projected = 0;
      for (std::size_t j = 0; j < series; ++j)
      {
        const double predicted = own[1] > 0.0 ? own[2 + j] / own[1] : 0.0;
        const double excess = own[1] > 0.0 ? own[2 + series + j] / own[1] : 0.0;
        SeriesUse &  use = m_Use[c * series + j];
        use = SeriesUse::Ignored;
        if (j < m_Basis.NumberOfLightFactors())
        {
          use = SeriesUse::Projected;
          ++projected;
        }
        else if (predicted > 0.002 || excess > 5.0 * std::sqrt(2.0 / std::max(1.0, own[0])))
        {
          wanted.emplace_back(-predicted, j);
        }
      }
      std::sort(wanted.begin(), wanted.end());
      for (const auto & [energy, j] : wanted)
      {
        m_Use[c * series + j] = projected < most ? SeriesUse::Projected : SeriesUse::Subtracted;
        ++projected;
      }
      m_IsOvercrowded[c] = static_cast<double>(projected) > 0.4 * static_cast<double>(m_Frame.frames - 1);
    }
  }

  const std::vector<double> &
  GetVariance() const
  {
    return m_Variance;
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
  SeriesUse
  GetUse(std::size_t textureClass, std::size_t series) const
  {
    return m_Use[textureClass * m_Basis.Size() + series];
  }
  /** Whether a class wants more series than a short burst can pay for. */
  bool
  IsOvercrowded(std::size_t textureClass) const
  {
    return m_IsOvercrowded[textureClass];
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
  std::array<double, NumberOfStencils>
  Derivatives(std::size_t p) const
  {
    std::array<double, NumberOfStencils> values{};
    for (std::size_t k = 0; k < NumberOfStencils; ++k)
    {
      values[k] = ApplyStencil(MotionStencils()[k], m_Frame.mean.data(), m_Frame.geometry.width, p);
    }
    return values;
  }
  double
  Predict(const std::array<double, NumberOfStencils> & derivatives, std::size_t j) const
  {
    double sum = 0.0;
    for (std::size_t k = 0; k < NumberOfStencils; ++k)
    {
      sum += m_Prediction(static_cast<Eigen::Index>(j), static_cast<Eigen::Index>(k)) * derivatives[k];
    }
    return sum;
  }
  double
  FlickeringNoise(const double * coordinates, std::size_t j) const
  {
    double sum = 0.0;
    for (Eigen::Index i = 0; i < m_LightShare.rows(); ++i)
    {
      sum += coordinates[i] * m_LightShare(i, static_cast<Eigen::Index>(j));
    }
    return sum;
  }

  void
  ComputePixel(std::size_t p, double gain)
  {
    const std::size_t                    series = m_Basis.Size();
    const SeriesUse *                    use = m_Use.data() + m_ClassOf[p] * series;
    const double *                       coordinates = m_Sums.OfPixel(p);
    double                               rss = m_Frame.squares[p];
    double                               freedom = static_cast<double>(m_Frame.frames - 1);
    double                               flickering = 0.0;
    bool                                 hasDerivatives = false;
    std::array<double, NumberOfStencils> derivatives{};
    for (std::size_t j = 0; j < series; ++j)
    {
      if (use[j] == SeriesUse::Projected)
      {
        rss -= coordinates[j] * coordinates[j];
        freedom -= 1.0;
        flickering += this->FlickeringNoise(coordinates, j);
      }
      else if (use[j] == SeriesUse::Subtracted)
      {
        if (!hasDerivatives)
        {
          derivatives = this->Derivatives(p);
          hasDerivatives = true;
        }
        const double rest = coordinates[j] - this->Predict(derivatives, j);
        rss += rest * rest - coordinates[j] * coordinates[j];
        freedom += m_PredictionNoise(static_cast<Eigen::Index>(j));
      }
    }
    m_Freedom[p] = static_cast<float>(freedom);
    m_Variance[p] = (rss + gain * flickering) / freedom;
  }

  void
  Classify(const ProvisionalModel & model)
  {
    const auto &       stencils = MotionStencils();
    const std::size_t  width = m_Frame.geometry.width;
    std::vector<float> energy(m_Mask.size(), 0.0F);
    ForBlocks(m_Mask.size(), m_ParallelFor, [&](std::size_t begin, std::size_t end) {
      for (std::size_t p = begin; p < end; ++p)
      {
        if (m_Frame.usable[p] != 0)
        {
          const double * mean = m_Frame.mean.data();
          const double   gx = ApplyStencil(stencils[StencilX], mean, width, p);
          const double   gy = ApplyStencil(stencils[StencilY], mean, width, p);
          const double   xx = ApplyStencil(stencils[StencilXX], mean, width, p);
          const double   yy = ApplyStencil(stencils[StencilYY], mean, width, p);
          energy[p] = static_cast<float>(gx * gx + gy * gy + 0.25 * (xx * xx + yy * yy));
        }
      }
    });
    const double        sd = std::sqrt(std::max(model.vibrationXPixels2, model.vibrationYPixels2));
    const auto          radius = static_cast<std::size_t>(sd < 0.35 ? 2.0 : 2.0 + std::ceil(3.0 * std::min(sd, 4.0)));
    std::vector<double> roughness = BoxSum(energy, width, m_Frame.geometry.height, radius, m_ParallelFor);
    std::vector<double> sample;
    for (std::size_t p = 0; p < roughness.size(); ++p)
    {
      roughness[p] /= model.NoiseVariance(m_Frame.neighbourMean[p]);
    }
    for (const std::size_t p : detail::SamplePixels(m_Mask))
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
    for (std::size_t p = 0; p < roughness.size(); ++p)
    {
      m_ClassOf[p] =
        static_cast<std::uint8_t>(std::lower_bound(edges.begin(), edges.end(), roughness[p]) - edges.begin());
    }
  }

  const ReferenceFrame &            m_Frame;
  const TemporalBasis &             m_Basis;
  ProjectionSums &                  m_Sums;
  const std::vector<std::uint8_t> & m_Mask;
  ParallelFor                       m_ParallelFor;
  std::vector<double>               m_Variance;
  std::vector<float>                m_Freedom;
  std::vector<std::uint8_t>         m_ClassOf;
  std::vector<SeriesUse>            m_Use;
  std::array<bool, Classes>         m_IsOvercrowded{};
  Eigen::MatrixXd                   m_LightShare;      // light x series: K_ij
  Eigen::MatrixXd                   m_Prediction;      // series x stencils
  Eigen::VectorXd                   m_PredictionNoise; // of each series, in units of the noise variance
};

} // namespace sensornoise

#endif
