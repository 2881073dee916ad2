// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/pixels/VarianceFit.h"

#include "sensornoise/base/Constants.h"
#include "sensornoise/base/Eigen.h"
#include "sensornoise/base/Parallel.h"
#include "sensornoise/base/Quantiles.h"
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
  , m_Freedoms(RangeOverPixels(
      data.pixels,
      parallelFor,
      [&data](std::size_t p) { return data.mask[p] != 0; },
      [&data](std::size_t p) { return static_cast<double>(data.freedom[p]); }))
  , m_Rule(rule)
  , m_BlackDn(blackDn)
{
  if (m_Freedoms.values >= InPixels.fewestPixelsOfFit)
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

ChiSquareTrim
VarianceFit::MakeTrim() const
{
  return { m_Line.EffectiveFreedom(m_Freedoms.lowest, m_Line.lowestDn2), m_Freedoms.highest };
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
    const auto   s = this->SumWeighed<Sums>([&](std::size_t p, const Weighed & weighed, auto & sums) {
      const auto [w, value] = weighed;
      const double x = m_Data.mean[p] - pivot;
      sums[W] += w;
      sums[WX] += w * x;
      sums[WXX] += w * x * x;
      sums[WV] += w * value;
      sums[WXV] += w * x * value;
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
  const auto s = this->SumWeighed<Sums>([&](std::size_t p, const Weighed & weighed, auto & sums) {
    const auto [w, value] = weighed;
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
      Run run{};
      for (std::size_t first = begin; first < end; first += Run::MostPixels)
      {
        const std::size_t pixels = std::min(Run::MostPixels, end - first);
        this->WeighRun(first, pixels, run);
        for (std::size_t i = 0; i < pixels; ++i)
        {
          trimmed[first + i] = m_Data.mask[first + i] != 0 && !(run.weight[i] > 0.0) ? 1 : 0;
        }
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
    this->SumWeighed<VarianceCurve::Bins * CurveBin::Sums>([&](std::size_t p, const Weighed & weighed, auto & sums) {
      const auto [w, value] = weighed;
      const double x = m_Data.mean[p] - line.pivotDn;
      const double excess = value - line.intercept - line.gain * m_Data.mean[p];
      double *     own = sums.data() + CurveBin::Sums * BinOf(edges, m_Data.neighbourMean[p]);
      own[0] += w > 0.0 ? 1.0 : 0.0;
      own[1] += w;
      own[2] += w * x;
      own[3] += w * excess;
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
