// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/pixels/VarianceFit.h"

#include "sensornoise/base/ChiSquare.h"
#include "sensornoise/base/Constants.h"
#include "sensornoise/base/Eigen.h"
#include "sensornoise/base/Parallel.h"
#include "sensornoise/base/Quantiles.h"
#include "sensornoise/moments/Constants.h"
#include "sensornoise/moments/DefectivePixels.h"
#include "sensornoise/pixels/ChiSquareTrim.h"
#include "sensornoise/pixels/Constants.h"
#include "sensornoise/pixels/MedianLine.h"
#include "sensornoise/pixels/VarianceCurve.h"
#include "sensornoise/pixels/VarianceLine.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace sensornoise
{

VarianceFit::VarianceFit(const VarianceData &                data,
                         const ParallelFor &                 parallelFor,
                         const std::optional<VarianceLine> & start,
                         TrimRule                            rule,
                         double                              blackDn)
  : m_Data(data)
  , m_ParallelFor(parallelFor)
  , m_Freedoms(RangeOfFreedom(data, parallelFor))
  , m_Rule(rule)
  , m_BlackDn(blackDn)
{
  if (m_Freedoms.pixels >= InPixels.fewestPixelsOfFit)
  {
    const std::optional<VarianceLine> first =
      start ? start : FitMedians(data, ChiSquareTrim(m_Freedoms.lowest, m_Freedoms.highest));
    if (first)
    {
      m_Line.gain = first->gain;
      m_Line.intercept = first->intercept;
      m_Line.lowestDn2 = first->lowestDn2;
      m_Line.pivotDn = first->pivotDn;
      m_Line.noiseSpreadDn4 = first->noiseSpreadDn4;
      m_Trim.emplace(this->MakeTrim());
      if (m_Rule == TrimRule::Distance)
      {
        std::vector<double> levels = this->SampleLevels();
        m_DarkestDn = Quantile(levels, InCommon.darkestQuantile);
        m_BrightestDn = Quantile(levels, InCommon.brightestQuantile);
        this->SetReach();
        this->SetNoiseSpread();
      }
    }
  }
}

VarianceFit::FreedomRange
VarianceFit::RangeOfFreedom(const VarianceData & data, const ParallelFor & parallelFor)
{
  std::vector<FreedomRange> parts(data.pixels / PixelsPerBlock + 1);
  ForBlocks(data.pixels, parallelFor, [&](std::size_t begin, std::size_t end) {
    FreedomRange part;
    for (std::size_t p = begin; p < end; ++p)
    {
      if (data.mask[p] != 0)
      {
        part.lowest = std::min(part.lowest, static_cast<double>(data.freedom[p]));
        part.highest = std::max(part.highest, static_cast<double>(data.freedom[p]));
        ++part.pixels;
      }
    }
    parts[begin / PixelsPerBlock] = part;
  });
  FreedomRange range;
  for (const FreedomRange & part : parts)
  {
    range.lowest = std::min(range.lowest, part.lowest);
    range.highest = std::max(range.highest, part.highest);
    range.pixels += part.pixels;
  }
  return range;
}

ChiSquareTrim
VarianceFit::MakeTrim() const
{
  return { m_Line.EffectiveFreedom(m_Freedoms.lowest, m_Line.lowestDn2), m_Freedoms.highest };
}

VarianceFit::Weighed
VarianceFit::Weigh(std::size_t p) const
{
  const double own = m_Line.At(m_Data.mean[p]);
  const double expected = m_Line.At(m_Data.neighbourMean[p]);
  const double halfFreedom = 0.5 * m_Data.freedom[p];
  const double weight = halfFreedom / (expected * expected + halfFreedom * m_Line.noiseSpreadDn4);
  if (m_Rule == TrimRule::Distance)
  {
    const double excess = m_Data.variance[p] - own;
    return { excess < m_ReachDn2 && excess > -m_ReachBelowDn2 ? weight : 0.0, m_Data.variance[p] };
  }
  const auto & limits = m_Trim->Of(m_Line.EffectiveFreedom(m_Data.freedom[p], own));
  const double ratio = m_Data.variance[p] / own;
  return { ratio > limits.low && ratio < limits.high ? weight : 0.0, m_Data.variance[p] / limits.mean };
}

std::vector<double>
VarianceFit::SampleLevels() const
{
  std::vector<double> levels;
  for (const std::size_t p : SamplePixels({ m_Data.mask, m_Data.mask + m_Data.pixels }))
  {
    levels.push_back(m_Data.neighbourMean[p]);
  }
  return levels;
}

void
VarianceFit::SetReach()
{
  const double darkest = m_Line.At(m_DarkestDn);
  const double brightest = m_Line.At(m_BrightestDn);
  const double largest = std::max(darkest, brightest);
  const double freedom = std::max(1.0, m_Line.SamplingFreedom(m_Freedoms.highest, largest));
  const double chance = largest * (ChiSquareUpperQuantile(InPixels.reachTail, freedom) / freedom - 1.0);
  const double atBlack = std::max(0.0, m_Line.intercept + m_Line.gain * m_BlackDn);
  const double noisy =
    (InMoments.defectiveNoiseFactor * InMoments.defectiveNoiseFactor - 1.0) * std::min({ darkest, brightest, atBlack });
  m_ReachDn2 = std::max(chance, noisy);
  m_ReachBelowDn2 = largest * (1.0 - ChiSquareQuantile(InPixels.reachTail, freedom) / freedom);
}

void
VarianceFit::SetNoiseSpread()
{
  // Sums of squared weights, times what the squared residuals have more than sampling noise, and times that noise.
  enum : std::size_t
  {
    WW,
    WWMore,
    WWChance,
    Sums
  };
  const auto   s = SumOverBlocks<Sums>(m_Data.pixels, m_ParallelFor, [&](std::size_t p, auto & sums) {
    if (m_Data.mask[p] != 0 && this->Weigh(p).weight > 0.0)
    {
      const double own = m_Line.At(m_Data.mean[p]);
      const double expected = m_Line.At(m_Data.neighbourMean[p]);
      const double chance = 2.0 * expected * expected / m_Line.SamplingFreedom(m_Data.freedom[p], expected);
      const double residual = m_Data.variance[p] - own;
      const double w = 1.0 / (chance * chance);
      sums[WW] += w;
      sums[WWMore] += w * (residual * residual - chance);
      sums[WWChance] += w * chance;
    }
  });
  const double spread = s[WWMore] / std::max(1e-300, s[WW]);
  m_Line.noiseSpreadDn4 = spread * s[WW] > InPixels.leastNoiseSpread * s[WWChance] ? spread : 0.0;
}

void
VarianceFit::Iterate(int iterations)
{
  // Sums of the weight times powers of x, the mean above the pivot, and times V, the variance.
  enum : std::size_t
  {
    W,
    WX,
    WXX,
    WV,
    WXV,
    Sums
  };
  const double pivot = m_Line.pivotDn;
  for (int iteration = 0; m_Trim && iteration < iterations; ++iteration)
  {
    const auto   s = SumOverBlocks<Sums>(m_Data.pixels, m_ParallelFor, [&](std::size_t p, auto & sums) {
      if (m_Data.mask[p] != 0)
      {
        const auto [w, value] = this->Weigh(p);
        const double x = m_Data.mean[p] - pivot;
        sums[W] += w;
        sums[WX] += w * x;
        sums[WXX] += w * x * x;
        sums[WV] += w * value;
        sums[WXV] += w * x * value;
      }
    });
    const double determinant = s[W] * s[WXX] - s[WX] * s[WX];
    m_Line.isDetermined = determinant > 1e-12 * s[W] * s[WXX];
    if (!m_Line.isDetermined)
    {
      return;
    }
    const double gain = (s[W] * s[WXV] - s[WX] * s[WV]) / determinant;
    const double intercept = (s[WXX] * s[WV] - s[WX] * s[WXV]) / determinant - gain * pivot;
    const double change = std::abs(gain - m_Line.gain) / (std::abs(gain) + 1e-300) +
                          std::abs(intercept - m_Line.intercept) / (std::abs(intercept) + std::abs(gain * pivot));
    m_Line.gain = gain;
    m_Line.intercept = intercept;
    m_Line.weightSum = s[W];
    m_Line.pivotDn = pivot + s[WX] / s[W];
    m_Line.spreadDn2 = determinant / s[W];
    if (m_Rule == TrimRule::Distance && iteration < 3)
    {
      this->SetReach();
      this->SetNoiseSpread();
    }
    else if (change < 1e-9)
    {
      return;
    }
  }
}

void
VarianceFit::FillErrors()
{
  if (!m_Line.isDetermined)
  {
    return;
  }
  // Sums of the weight and the residual R squared, times powers of x, the mean above the pivot; and of the weight times
  // powers of x and R.
  enum : std::size_t
  {
    WWRR,
    WWRRX,
    WWRRXX,
    WX3,
    WX4,
    WXXR,
    Trimmed,
    Pixels,
    W,
    WXX,
    Sums
  };
  const auto s = SumOverBlocks<Sums>(m_Data.pixels, m_ParallelFor, [&](std::size_t p, auto & sums) {
    if (m_Data.mask[p] != 0)
    {
      const auto [w, value] = this->Weigh(p);
      const double x = m_Data.mean[p] - m_Line.pivotDn;
      const double residual = value - m_Line.intercept - m_Line.gain * m_Data.mean[p];
      const double square = w * w * residual * residual;
      sums[WWRR] += square;
      sums[WWRRX] += square * x;
      sums[WWRRXX] += square * x * x;
      sums[WX3] += w * x * x * x;
      sums[WX4] += w * x * x * x * x;
      sums[WXXR] += w * x * x * residual;
      sums[Trimmed] += w > 0.0 ? 0.0 : 1.0;
      sums[Pixels] += 1.0;
      sums[W] += w;
      sums[WXX] += w * x * x;
    }
  });
  // In coordinates (gain, value at pivotDn) the information is diagonal.
  Eigen::Matrix2d inverse;
  inverse << 1.0 / m_Line.spreadDn2, 0.0, 0.0, 1.0 / m_Line.weightSum;
  Eigen::Matrix2d meat;
  meat << s[WWRRXX], s[WWRRX], s[WWRRX], s[WWRR];
  Eigen::Matrix2d toIntercept;
  toIntercept << 1.0, 0.0, -m_Line.pivotDn, 1.0;
  m_Line.covariance = toIntercept * inverse * meat * inverse * toIntercept.transpose();
  // The parabola's third column, freed of the first two: q = x^2 - a x - b.
  const double a = s[WX3] / s[WXX];
  const double b = s[WXX] / s[W];
  const double quadratic = s[WX4] - a * s[WX3] - b * s[WXX];
  if (quadratic > 0.0)
  {
    m_Line.curvature = s[WXXR] / quadratic;
    m_Line.curvatureSd = 1.0 / std::sqrt(quadratic);
    m_Line.curvatureTilt = a;
    m_Line.curvatureLift = b;
  }
  m_Line.trimmedFraction = s[Trimmed] / s[Pixels];
  m_Line.isDetermined = std::isfinite(m_Line.gain) && m_Line.covariance.allFinite();
}

std::vector<std::uint8_t>
VarianceFit::FindTrimmed() const
{
  std::vector<std::uint8_t> trimmed(m_Data.pixels, 0);
  if (m_Trim)
  {
    ForBlocks(m_Data.pixels, m_ParallelFor, [&](std::size_t begin, std::size_t end) {
      for (std::size_t p = begin; p < end; ++p)
      {
        trimmed[p] = m_Data.mask[p] != 0 && !(this->Weigh(p).weight > 0.0) ? 1 : 0;
      }
    });
  }
  return trimmed;
}

VarianceCurve
VarianceFit::CurveAbout(const VarianceLine & line) const
{
  const std::vector<double> edges = EdgesOfEqualCount(this->SampleLevels(), VarianceCurve::Bins);
  const auto                s =
    SumOverBlocks<VarianceCurve::Bins * CurveBin::Sums>(m_Data.pixels, m_ParallelFor, [&](std::size_t p, auto & sums) {
      if (m_Data.mask[p] != 0)
      {
        const auto [w, value] = this->Weigh(p);
        const double x = m_Data.mean[p] - line.pivotDn;
        const double excess = value - line.intercept - line.gain * m_Data.mean[p];
        double *     own = sums.data() + CurveBin::Sums * BinOf(edges, m_Data.neighbourMean[p]);
        own[0] += w > 0.0 ? 1.0 : 0.0;
        own[1] += w;
        own[2] += w * x;
        own[3] += w * excess;
      }
    });
  VarianceCurve curve{ line, {} };
  for (std::size_t b = 0; b < VarianceCurve::Bins; ++b)
  {
    const double * own = s.data() + CurveBin::Sums * b;
    if (own[1] > 0.0)
    {
      curve.bins.push_back({ own[0], own[1], own[2], own[3] });
    }
  }
  return curve;
}

VarianceLine
FitVarianceLine(const VarianceData &                data,
                const ParallelFor &                 parallelFor,
                const std::optional<VarianceLine> & start,
                int                                 iterations,
                TrimRule                            rule)
{
  VarianceFit fit(data, parallelFor, start, rule);
  fit.Iterate(iterations);
  fit.FillErrors();
  return fit.GetLine();
}

} // namespace sensornoise
