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
#ifndef SensorNoiseVarianceLine_h
#define SensorNoiseVarianceLine_h

#include "SensorNoiseBlockSums.h"
#include "SensorNoiseChiSquare.h"
#include "SensorNoiseProvisionalModel.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

namespace sensornoise
{

/** Maps of a regression of the variance on the mean. */
struct VarianceData
{
  const double *       mean;          ///< [DN]
  const double *       neighbourMean; ///< mean of the 8 neighbours [DN]
  const double *       variance;      ///< unbiased [DN^2]
  const float *        freedom;       ///< degrees of freedom of the variance
  const std::uint8_t * mask;
  std::size_t          pixels;
};

/** variance = intercept + gain mean, and how sure. */
struct VarianceLine
{
  double          gain{ 0.0 };
  double          intercept{ 0.0 };
  double          lowestDn2{ 0.0 };                      ///< the line is cut there where it serves as a variance
  Eigen::Matrix2d covariance{ Eigen::Matrix2d::Zero() }; ///< of (gain, intercept), sandwich
  double          weightSum{ 0.0 };                      ///< of the weights
  double          centreDn{ 0.0 };                       ///< weighted mean of the means
  double          spreadDn2{ 0.0 };                      ///< weighted sum of their squared deviations
  double          curvature{ 0.0 };                      ///< of the parabola in its place [1]
  double          curvatureTilt{ 0.0 };                  ///< of the parabola's departure, see BendAt()
  double          curvatureLift{ 0.0 };
  double          curvatureSd{ 0.0 };     ///< standard error of the curvature
  double          trimmedFraction{ 0.0 }; ///< of the pixels
  bool            isDetermined{ false };

  double
  At(double meanDn) const
  {
    return std::max(lowestDn2, intercept + gain * meanDn);
  }
  /** The degrees of freedom of the normal sample variance that scatters as much as this one. Shot noise has the fourth
   * cumulant g^3 q, at most g^2 V, so that Var(s^2) / V^2 = 2 / freedom + g^2 / (V T) where few electrons make a DN. */
  double
  EffectiveFreedom(double freedom, double varianceDn2) const
  {
    return freedom / (1.0 + 0.5 * gain * gain / varianceDn2);
  }
  /** How far the parabola in the line's place departs from it [DN^2]. */
  double
  BendAt(double meanDn) const
  {
    const double x = meanDn - centreDn;
    return curvature * (x * x - curvatureTilt * x - curvatureLift);
  }
};

/** \class ChiSquareTrim
 * \brief Two-sided trimming of sample variances at a tail probability of 1e-4 each, and its bias: a trimmed mean of
 * chi-square variables of k degrees of freedom is (F_{k+2}(b) - F_{k+2}(a)) / (F_k(b) - F_k(a)) of the mean. */
class ChiSquareTrim
{
public:
  static constexpr double Tail = 1e-4;

  /** For degrees of freedom from \a lowest to \a highest. */
  ChiSquareTrim(double lowest, double highest)
    : m_First(static_cast<std::size_t>(std::max(1.0, std::round(lowest))))
  {
    for (auto k = static_cast<double>(m_First); k <= std::max(1.0, std::round(highest)); k += 1.0)
    {
      const double low = ChiSquareQuantile(Tail, k);
      const double high = ChiSquareUpperQuantile(Tail, k);
      m_Limits.push_back({ low / k,
                           high / k,
                           (ChiSquareCdf(high, k + 2.0) - ChiSquareCdf(low, k + 2.0)) / (1.0 - 2.0 * Tail),
                           ChiSquareQuantile(0.5, k) / k });
    }
  }
  struct Limits
  {
    double low;
    double high;
    double mean;
    double median;
  };
  const Limits &
  Of(double freedom) const
  {
    const auto k = static_cast<std::size_t>(std::max(1.0, std::round(freedom)));
    return m_Limits[std::min(m_Limits.size() - 1, k - std::min(k, m_First))];
  }

private:
  std::size_t         m_First;
  std::vector<Limits> m_Limits;
};

/** Fits the line by re-weighted least squares. The weights freedom / (2 V^2) take V at the neighbours' mean, which is
 * independent of the pixel's own noise; outliers on either side are trimmed with the exact correction of the mean. It
 * starts from the medians of 40 intensity bins, or from \a start. The covariance is the sandwich, which stands whether
 * or not the weights are right. Estimator.md, 3.6. Not determined with fewer than 10 pixels or one intensity. */
inline VarianceLine
FitVarianceLine(const VarianceData &                data,
                const ParallelFor &                 parallelFor,
                const std::optional<VarianceLine> & start = std::nullopt,
                int                                 iterations = 8)
{
  VarianceLine        line;
  std::vector<double> level;
  std::vector<double> freedoms{ 1e300, 0.0 };
  double              centre = 0.0;
  {
    std::vector<std::uint8_t> mask(data.mask, data.mask + data.pixels);
    const auto                sample = detail::SamplePixels(mask);
    if (sample.size() < 10)
    {
      return line;
    }
    for (std::size_t p = 0; p < data.pixels; ++p)
    {
      if (data.mask[p] != 0)
      {
        freedoms[0] = std::min(freedoms[0], static_cast<double>(data.freedom[p]));
        freedoms[1] = std::max(freedoms[1], static_cast<double>(data.freedom[p]));
      }
    }
    for (const std::size_t p : sample)
    {
      level.push_back(data.neighbourMean[p]);
      centre += data.mean[p] / static_cast<double>(sample.size());
    }
    const ChiSquareTrim   trim(freedoms[0], freedoms[1]);
    constexpr std::size_t bins = 40;
    const auto            binOf = detail::BinsOfEqualCount(level, bins);
    std::vector<double>   value;
    std::vector<double>   meanOfBin(bins, 0.0);
    std::vector<double>   count(bins, 0.0);
    for (std::size_t i = 0; i < sample.size(); ++i)
    {
      value.push_back(data.variance[sample[i]] / trim.Of(data.freedom[sample[i]]).median);
      meanOfBin[binOf[i]] += data.mean[sample[i]] - centre;
      count[binOf[i]] += 1.0;
    }
    const auto medians = detail::MediansOfBins(value, binOf, bins);
    double     s0 = 0.0, s1 = 0.0, s2 = 0.0, r0 = 0.0, r1 = 0.0;
    double     lowest = std::numeric_limits<double>::infinity();
    for (std::size_t b = 0; b < bins; ++b)
    {
      if (count[b] > 5.0 && medians[b] > 0.0)
      {
        const double w = count[b] / (medians[b] * medians[b]);
        const double x = meanOfBin[b] / count[b];
        s0 += w;
        s1 += w * x;
        s2 += w * x * x;
        r0 += w * medians[b];
        r1 += w * x * medians[b];
        lowest = std::min(lowest, medians[b]);
      }
    }
    const double determinant = s0 * s2 - s1 * s1;
    if (!(determinant > 1e-12 * s0 * s2) || !std::isfinite(lowest))
    {
      return line;
    }
    line.lowestDn2 = std::max(1e-9, 0.2 * lowest);
    line.gain = start ? start->gain : (s0 * r1 - s1 * r0) / determinant;
    line.intercept = start ? start->intercept : (s2 * r0 - s1 * r1) / determinant - line.gain * centre;
  }

  const ChiSquareTrim trim(line.EffectiveFreedom(freedoms[0], line.lowestDn2), freedoms[1]);
  // A pixel's weight, and its variance freed of the trimming's bias; weight 0: trimmed.
  const auto weigh = [&](std::size_t p, double & value) {
    const double own = line.At(data.mean[p]);
    const auto & limits = trim.Of(line.EffectiveFreedom(data.freedom[p], own));
    const double ratio = data.variance[p] / own;
    const double expected = line.At(data.neighbourMean[p]);
    value = data.variance[p] / limits.mean;
    return ratio > limits.low && ratio < limits.high ? 0.5 * data.freedom[p] / (expected * expected) : 0.0;
  };
  double determinant = 0.0;
  for (int iteration = 0; iteration < iterations; ++iteration)
  {
    const auto s = SumOverBlocks<5>(data.pixels, parallelFor, [&](std::size_t p, auto & sums) {
      double value = 0.0;
      if (data.mask[p] != 0)
      {
        const double w = weigh(p, value);
        const double x = data.mean[p] - centre;
        sums[0] += w;
        sums[1] += w * x;
        sums[2] += w * x * x;
        sums[3] += w * value;
        sums[4] += w * x * value;
      }
    });
    determinant = s[0] * s[2] - s[1] * s[1];
    if (!(determinant > 1e-12 * s[0] * s[2]))
    {
      return line;
    }
    const double gain = (s[0] * s[4] - s[1] * s[3]) / determinant;
    const double intercept = (s[2] * s[3] - s[1] * s[4]) / determinant - gain * centre;
    const double change = std::abs(gain - line.gain) / (std::abs(gain) + 1e-300) +
                          std::abs(intercept - line.intercept) / (std::abs(intercept) + std::abs(gain * centre));
    line.gain = gain;
    line.intercept = intercept;
    line.weightSum = s[0];
    line.centreDn = centre + s[1] / s[0];
    line.spreadDn2 = determinant / s[0];
    if (change < 1e-9)
    {
      break;
    }
  }

  const auto s = SumOverBlocks<10>(data.pixels, parallelFor, [&](std::size_t p, auto & sums) {
    if (data.mask[p] != 0)
    {
      double       value = 0.0;
      const double w = weigh(p, value);
      const double x = data.mean[p] - line.centreDn;
      const double residual = value - line.intercept - line.gain * data.mean[p];
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
  inverse << 1.0 / line.spreadDn2, 0.0, 0.0, 1.0 / line.weightSum;
  Eigen::Matrix2d meat;
  meat << s[2], s[1], s[1], s[0];
  Eigen::Matrix2d toIntercept;
  toIntercept << 1.0, 0.0, -line.centreDn, 1.0;
  line.covariance = toIntercept * inverse * meat * inverse * toIntercept.transpose();
  // The parabola's third column, freed of the first two: q = x^2 - a x - b.
  const double a = s[3] / s[9];
  const double b = s[9] / s[8];
  const double quadratic = s[4] - a * s[3] - b * s[9];
  if (quadratic > 0.0)
  {
    line.curvature = s[5] / quadratic;
    line.curvatureSd = 1.0 / std::sqrt(quadratic);
    line.curvatureTilt = a;
    line.curvatureLift = b;
  }
  line.trimmedFraction = s[6] / s[7];
  line.isDetermined = std::isfinite(line.gain) && line.covariance.allFinite();
  return line;
}

} // namespace sensornoise

#endif
