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
#ifndef sensornoise_pixels_VarianceFit_h
#define sensornoise_pixels_VarianceFit_h

#include "sensornoise/base/Eigen.h"
#include "sensornoise/base/Parallel.h"
#include "sensornoise/pixels/ChiSquareTrim.h"
#include "sensornoise/pixels/MedianLine.h"
#include "sensornoise/pixels/VarianceLine.h"

#include <cmath>
#include <cstddef>
#include <optional>

namespace sensornoise
{

/** \class VarianceFit
 * \brief The regression of the variance on the mean, by re-weighted least squares.
 *
 * The weights freedom / (2 V^2) take V at the neighbours' mean, which is independent of the pixel's own noise; outliers
 * on either side are trimmed with the exact correction of the mean. Estimator.md, 3.6. */
class VarianceFit
{
public:
  /** Starts from \a start, or from the medians of bins of the intensity. The data must outlive the object. */
  VarianceFit(const VarianceData & data, const ParallelFor & parallelFor, const std::optional<VarianceLine> & start)
    : m_Data(data)
    , m_ParallelFor(parallelFor)
    , m_Freedoms(detail::RangeOfFreedom(data, parallelFor))
  {
    if (m_Freedoms.pixels >= 10)
    {
      const std::optional<VarianceLine> first = start ? start : detail::FitMedians(data, m_Freedoms);
      if (first)
      {
        m_Line.gain = first->gain;
        m_Line.intercept = first->intercept;
        m_Line.lowestDn2 = first->lowestDn2;
        m_Line.centreDn = first->centreDn;
        m_Trim.emplace(this->MakeTrim(ChiSquareTrim::Tail));
      }
    }
  }

  /** Fits the line, without its errors. Not determined with fewer than 10 pixels or one intensity. */
  void
  Iterate(int iterations)
  {
    const double centre = m_Line.centreDn;
    for (int iteration = 0; m_Trim && iteration < iterations; ++iteration)
    {
      const auto   s = SumOverBlocks<5>(m_Data.pixels, m_ParallelFor, [&](std::size_t p, auto & sums) {
        if (m_Data.mask[p] != 0)
        {
          const auto [w, value] = this->Weigh(p, *m_Trim);
          const double x = m_Data.mean[p] - centre;
          sums[0] += w;
          sums[1] += w * x;
          sums[2] += w * x * x;
          sums[3] += w * value;
          sums[4] += w * x * value;
        }
      });
      const double determinant = s[0] * s[2] - s[1] * s[1];
      m_Line.isDetermined = determinant > 1e-12 * s[0] * s[2];
      if (!m_Line.isDetermined)
      {
        return;
      }
      const double gain = (s[0] * s[4] - s[1] * s[3]) / determinant;
      const double intercept = (s[2] * s[3] - s[1] * s[4]) / determinant - gain * centre;
      const double change = std::abs(gain - m_Line.gain) / (std::abs(gain) + 1e-300) +
                            std::abs(intercept - m_Line.intercept) / (std::abs(intercept) + std::abs(gain * centre));
      m_Line.gain = gain;
      m_Line.intercept = intercept;
      m_Line.weightSum = s[0];
      m_Line.centreDn = centre + s[1] / s[0];
      m_Line.spreadDn2 = determinant / s[0];
      if (change < 1e-9)
      {
        return;
      }
    }
  }

  /** Fills in the covariance, by the sandwich, which stands whether or not the weights are right, and the curvature. */
  void
  FillErrors()
  {
    if (!m_Line.isDetermined)
    {
      return;
    }
    const auto s = SumOverBlocks<10>(m_Data.pixels, m_ParallelFor, [&](std::size_t p, auto & sums) {
      if (m_Data.mask[p] != 0)
      {
        const auto [w, value] = this->Weigh(p, *m_Trim);
        const double x = m_Data.mean[p] - m_Line.centreDn;
        const double residual = value - m_Line.intercept - m_Line.gain * m_Data.mean[p];
        const double square = w * w * residual * residual;
        sums[0] += square;
        sums[1] += square * x;
        sums[2] += square * x * x;
        sums[3] += w * x * x * x;
        sums[4] += w * x * x * x * x;
        sums[5] += w * x * x * residual;
        sums[6] += w > 0.0 ? 0.0 : 1.0;
        sums[7] += 1.0;
        sums[8] += w;
        sums[9] += w * x * x;
      }
    });
    // In coordinates (gain, value at centreDn) the information is diagonal.
    Eigen::Matrix2d inverse;
    inverse << 1.0 / m_Line.spreadDn2, 0.0, 0.0, 1.0 / m_Line.weightSum;
    Eigen::Matrix2d meat;
    meat << s[2], s[1], s[1], s[0];
    Eigen::Matrix2d toIntercept;
    toIntercept << 1.0, 0.0, -m_Line.centreDn, 1.0;
    m_Line.covariance = toIntercept * inverse * meat * inverse * toIntercept.transpose();
    // The parabola's third column, freed of the first two: q = x^2 - a x - b.
    const double a = s[3] / s[9];
    const double b = s[9] / s[8];
    const double quadratic = s[4] - a * s[3] - b * s[9];
    if (quadratic > 0.0)
    {
      m_Line.curvature = s[5] / quadratic;
      m_Line.curvatureSd = 1.0 / std::sqrt(quadratic);
      m_Line.curvatureTilt = a;
      m_Line.curvatureLift = b;
    }
    m_Line.trimmedFraction = s[6] / s[7];
    m_Line.isDetermined = std::isfinite(m_Line.gain) && m_Line.covariance.allFinite();
  }

  /** How much gain and intercept would move if 2 % of the pixels were trimmed on either side, as a covariance: 0 unless
   * that is more than chance. Pixels with a noise of their own, such as telegraph noise, too weak to be told one by
   * one, raise the variance; fewer of them are left by the closer trim (Hausman 1978). With the shift d and the test's
   * statistic S of two degrees of freedom, d d' (1 - 2 / S). */
  Eigen::Matrix2d
  TailDisagreement() const
  {
    if (!m_Line.isDetermined)
    {
      return Eigen::Matrix2d::Zero();
    }
    constexpr double      tail = 0.02;
    const ChiSquareTrim   close = this->MakeTrim(tail);
    const auto            s = SumOverBlocks<5>(m_Data.pixels, m_ParallelFor, [&](std::size_t p, auto & sums) {
      if (m_Data.mask[p] != 0)
      {
        const auto [w, value] = this->Weigh(p, *m_Trim);
        const auto [closeW, closeValue] = this->Weigh(p, close);
        const double own = m_Line.At(m_Data.mean[p]);
        const double score = closeW / (1.0 - 2.0 * tail) * (closeValue - own) - w * (value - own);
        const double x = m_Data.mean[p] - m_Line.centreDn;
        sums[0] += score;
        sums[1] += score * x;
        sums[2] += score * score;
        sums[3] += score * score * x;
        sums[4] += score * score * x * x;
      }
    });
    const Eigen::Vector2d scores(s[0], s[1]);
    Eigen::Matrix2d       squares;
    squares << s[2], s[3], s[3], s[4];
    const double          statistic = scores.dot(squares.ldlt().solve(scores));
    const double          gain = s[1] / m_Line.spreadDn2;
    const Eigen::Vector2d shift(gain, s[0] / m_Line.weightSum - gain * m_Line.centreDn);
    return statistic > 2.0 ? Eigen::Matrix2d((1.0 - 2.0 / statistic) * shift * shift.transpose())
                           : Eigen::Matrix2d::Zero();
  }

  const VarianceLine &
  GetLine() const
  {
    return m_Line;
  }

private:
  struct Weighed
  {
    double weight; // 0: trimmed
    double value;  // the variance, freed of the trimming's bias
  };

  ChiSquareTrim
  MakeTrim(double tail) const
  {
    return { m_Line.EffectiveFreedom(m_Freedoms.lowest, m_Line.lowestDn2), m_Freedoms.highest, tail };
  }

  Weighed
  Weigh(std::size_t p, const ChiSquareTrim & trim) const
  {
    const double own = m_Line.At(m_Data.mean[p]);
    const auto & limits = trim.Of(m_Line.EffectiveFreedom(m_Data.freedom[p], own));
    const double ratio = m_Data.variance[p] / own;
    const double expected = m_Line.At(m_Data.neighbourMean[p]);
    const bool   isKept = ratio > limits.low && ratio < limits.high;
    return { isKept ? 0.5 * m_Data.freedom[p] / (expected * expected) : 0.0, m_Data.variance[p] / limits.mean };
  }

  VarianceData                 m_Data;
  ParallelFor                  m_ParallelFor;
  detail::FreedomRange         m_Freedoms;
  VarianceLine                 m_Line;
  std::optional<ChiSquareTrim> m_Trim;
};

/** The line that fits the data, with its errors. */
inline VarianceLine
FitVarianceLine(const VarianceData &                data,
                const ParallelFor &                 parallelFor,
                const std::optional<VarianceLine> & start = std::nullopt,
                int                                 iterations = 8)
{
  VarianceFit fit(data, parallelFor, start);
  fit.Iterate(iterations);
  fit.FillErrors();
  return fit.GetLine();
}

} // namespace sensornoise

#endif
