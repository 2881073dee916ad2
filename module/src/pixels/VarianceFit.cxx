// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "pixels/VarianceFit.h"

#include "base/Constants.h"
#include "sensornoise/Parallel.h"
#include "base/Quantiles.h"
#include "pixels/ChiSquareTrim.h"
#include "pixels/Constants.h"
#include "pixels/MedianLine.h"
#include "pixels/VarianceCurve.h"
#include "pixels/VarianceLine.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace sensornoise
{

namespace
{
ValueRange
FindDofRange(const VarianceData & data, const ParallelFor & parallelFor)
{
  return RangeOverPixels(
    data.pixels,
    parallelFor,
    [&data](std::size_t p) { return data.mask[p] != 0; },
    [&data](std::size_t p) { return static_cast<double>(data.dof[p]); });
}

/** Returns the highest degrees of freedom of the pixels at and above a level, where a strong change of the illumination
 * leaves the fewest. Returns \a otherwise if there are no such pixels. */
double
HighestDofAbove(double levelDn, const VarianceData & data, double otherwise, const ParallelFor & parallelFor)
{
  const ValueRange range = RangeOverPixels(
    data.pixels,
    parallelFor,
    [&data, levelDn](std::size_t p) { return data.mask[p] != 0 && data.neighbourMean[p] >= levelDn; },
    [&data](std::size_t p) { return static_cast<double>(data.dof[p]); });
  return range.values > 0 ? range.highest : otherwise;
}
} // namespace

VarianceFit::VarianceFit(const VarianceData &                data,
                         const ParallelFor &                 parallelFor,
                         const std::optional<VarianceLine> & start,
                         TrimRule                            rule,
                         double                              blackDn)
  : m_Data(data)
  , m_ParallelFor(parallelFor)
  , m_Dofs(FindDofRange(data, parallelFor))
  , m_Rule(rule)
  , m_BlackDn(blackDn)
{
  if (m_Dofs.values >= InPixels.fewestPixelsOfFit)
  {
    const std::optional<VarianceLine> first =
      start ? start : FitMedians(data, ChiSquareTrim(m_Dofs.lowest, m_Dofs.highest));
    if (first)
    {
      m_Line.gain = first->gain;
      m_Line.intercept = first->intercept;
      m_Line.lowestDn2 = first->lowestDn2;
      m_Line.pivotDn = first->pivotDn;
      m_Line.noiseDispersionDn4 = first->noiseDispersionDn4;
      m_Trim.emplace(this->MakeTrim());
      if (m_Rule == TrimRule::Distance)
      {
        std::vector<double> levels = this->SampleLevels();
        m_DarkestDn = Quantile(levels, InCommon.darkestQuantile);
        m_BrightestDn = Quantile(levels, InCommon.brightestQuantile);
        m_BrightDof = HighestDofAbove(m_BrightestDn, m_Data, m_Dofs.highest, m_ParallelFor);
        this->SetReach();
        this->SetNoiseDispersion();
      }
    }
  }
}

VarianceFit::VarianceFit(const VarianceData & data, const VarianceFit & ofSample)
  : VarianceFit(ofSample)
{
  m_Data = data;
  m_Dofs = FindDofRange(data, m_ParallelFor);
}

ChiSquareTrim
VarianceFit::MakeTrim() const
{
  return { m_Line.EffectiveDof(m_Dofs.lowest, m_Line.lowestDn2), m_Dofs.highest };
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
  for (int iteration = 0; m_Trim && iteration < iterations; ++iteration)
  {
    const double pivot = m_Line.pivotDn;
    const auto   s = this->SumTerms<Sums>([](double w, double x, double value) {
      return std::array<double, Sums>{ w, w * x, w * x * x, w * value, w * x * value };
    });
    const double determinant = s[W] * s[WXX] - s[WX] * s[WX];
    m_Line.isDetermined = determinant > InPixels.leastDeterminant * s[W] * s[WXX];
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
    if (m_Rule == TrimRule::Distance && iteration < 3 && iteration + 1 < iterations)
    {
      this->SetReach();
      this->SetNoiseDispersion();
    }
    else if (change < 1e-9)
    {
      return;
    }
  }
}

std::vector<std::uint8_t>
VarianceFit::FindTrimmed() const
{
  std::vector<std::uint8_t> trimmed(m_Data.pixels, 0);
  if (m_Trim)
  {
    ForBlocks(m_Data.pixels, m_ParallelFor, [&](std::size_t begin, std::size_t end) {
      Run run{};
      ForRuns(begin, end, [&](std::size_t first, std::size_t pixels) {
        this->WeighRun(first, pixels, run);
        for (std::size_t i = 0; i < pixels; ++i)
        {
          trimmed[first + i] = m_Data.mask[first + i] != 0 && !(run.weight[i] > 0.0) ? 1 : 0;
        }
      });
    });
  }
  return trimmed;
}

VarianceCurve
VarianceFit::CurveAbout(const VarianceLine & line, SortedBy sortedBy) const
{
  const double * const levels = sortedBy == SortedBy::OwnLevel ? m_Data.mean : m_Data.neighbourMean;
  using SumsOfBins = std::array<double, VarianceCurve::Bins * CurveBin::Sums>;
  const std::vector<double> edges = EdgesOfEqualCount(this->SampleLevels(), VarianceCurve::Bins);
  const double              toPivot = m_Line.pivotDn - line.pivotDn;
  const double              atPivot = line.intercept + line.gain * m_Line.pivotDn;
  const auto sumRun = [&](std::size_t first, std::size_t pixels, const KeptRun & kept, SumsOfBins & sums) {
    for (std::size_t i = 0; i < pixels; ++i)
    {
      const double w = kept.weight[i];
      if (w > 0.0)
      {
        double * own = sums.data() + CurveBin::Sums * BinOf(edges, levels[first + i]);
        own[0] += 1.0;
        own[1] += w;
        own[2] += w * (kept.x[i] + toPivot);
        own[3] += w * (kept.value[i] - atPivot - line.gain * kept.x[i]);
      }
    }
  };
  const auto s = SumBlocks<std::tuple_size_v<SumsOfBins>>(
    m_Data.pixels, m_ParallelFor, [&](std::size_t begin, std::size_t end, SumsOfBins & sums) {
      this->ForKept(begin, end, [&](std::size_t first, std::size_t pixels, const KeptRun & kept) {
        sumRun(first, pixels, kept, sums);
      });
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

} // namespace sensornoise
