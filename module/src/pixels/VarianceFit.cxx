// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "pixels/VarianceFit.h"

#include "base/Constants.h"
#include "base/Eigen.h"
#include "base/Quantiles.h"
#include "sensornoise/Parallel.h"
#include "pixels/Constants.h"
#include "pixels/VarianceCurve.h"
#include "pixels/VarianceLine.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

namespace sensornoise
{

namespace
{
/** Fits a first line to the medians of 40 bins of the intensity. \a trim has the medians for the degrees of freedom of
 * all pixels. Null if there is only one intensity. */
std::optional<VarianceLine>
FitMedians(const VarianceData & data, const ChiSquareTrim & trim)
{
  const auto          sample = SamplePixels(data.mask, data.pixels);
  VarianceLine        line;
  std::vector<double> level;
  for (const std::size_t p : sample)
  {
    level.push_back(data.neighbourMean[p]);
    line.pivotDn += data.mean[p] / static_cast<double>(sample.size());
  }
  constexpr std::size_t bins = 40;
  const auto            binOf = BinsOfEqualCount(level, bins);
  std::vector<double>   value;
  std::vector<double>   centred;
  std::vector<double>   count(bins, 0.0);
  for (std::size_t i = 0; i < sample.size(); ++i)
  {
    value.push_back(data.variance[sample[i]] / trim.Of(data.dof[sample[i]]).median);
    centred.push_back(data.mean[sample[i]] - line.pivotDn);
    count[binOf[i]] += 1.0;
  }
  // Medians on both axes: if a bin holds parts of two patches, both medians are from the larger part.
  const auto medians = MediansOfBins(value, binOf, bins);
  const auto levels = MediansOfBins(centred, binOf, bins);
  double     s0 = 0.0, s1 = 0.0, s2 = 0.0, r0 = 0.0, r1 = 0.0;
  double     lowest = std::numeric_limits<double>::infinity();
  for (std::size_t b = 0; b < bins; ++b)
  {
    if (count[b] > InPixels.fewestPixelsOfBin && medians[b] > 0.0)
    {
      const double w = count[b] / (medians[b] * medians[b]);
      const double x = levels[b];
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
    return std::nullopt;
  }
  line.lowestDn2 = std::max(smallestDivisor, InCommon.lowestFraction * lowest);
  line.gain = (s0 * r1 - s1 * r0) / determinant;
  line.intercept = (s2 * r0 - s1 * r1) / determinant - line.gain * line.pivotDn;
  return line;
}

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
        std::vector<double> levels = m_Data.SampleLevels();
        m_DarkestDn = Quantile(levels, InCommon.darkestQuantile);
        m_BrightestDn = Quantile(levels, 1.0 - InCommon.darkestQuantile);
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

VarianceFit::NormalTerms
VarianceFit::SumNormalTerms() const
{
  // Sums of the weight times x, the mean above the pivot, z, the neighbours' mean above it, and V, the variance.
  enum : std::size_t
  {
    W,
    WX,
    WXX,
    WV,
    WXV,
    WZ,
    WZX,
    WZZ,
    WZV,
    Sums
  };
  const auto   s = SumBlocks<Sums>(m_Data.pixels, m_ParallelFor, [&](std::size_t begin, std::size_t end, auto & sums) {
    this->ForKept(begin, end, [&](std::size_t, std::size_t, const KeptRun & kept) {
      AddTerms(
        [](double w, double x, double z, double value) {
          return std::array<double, Sums>{ w,     w * x,     w * x * x, w * value,    w * x * value,
                                           w * z, w * z * x, w * z * z, w * z * value };
        },
        sums,
        kept.weight,
        kept.x,
        kept.neighbours,
        kept.value);
    });
  });
  const auto   productOf = [&](std::size_t a, std::size_t b, std::size_t ab) { return s[W] * s[ab] - s[a] * s[b]; };
  const double common = productOf(WZ, WX, WZX);
  NormalTerms  of;
  of.isByNeighbours = m_Rule == TrimRule::Level && common > InPixels.leastCommonVariance * productOf(WZ, WZ, WZZ);
  of.w = s[W];
  of.wx = s[WX];
  of.wxx = s[WXX];
  of.determinant = of.isByNeighbours ? common : productOf(WX, WX, WXX);
  of.slope = (of.isByNeighbours ? productOf(WZ, WV, WZV) : productOf(WX, WV, WXV)) / of.determinant;
  of.atPivot = (s[WV] - of.slope * s[WX]) / s[W];
  return of;
}

void
VarianceFit::Iterate(int iterations)
{
  for (int iteration = 0; m_Trim && iteration < iterations; ++iteration)
  {
    const double      pivot = m_Line.pivotDn;
    const NormalTerms of = this->SumNormalTerms();
    m_Line.isDetermined = of.determinant > InPixels.leastDeterminant * of.w * of.wxx;
    if (!m_Line.isDetermined)
    {
      return;
    }
    const double gain = of.slope;
    const double intercept = of.atPivot - gain * pivot;
    const double change = std::abs(gain - m_Line.gain) / (std::abs(gain) + 1e-300) +
                          std::abs(intercept - m_Line.intercept) / (std::abs(intercept) + std::abs(gain * pivot));
    m_Line.gain = gain;
    m_Line.intercept = intercept;
    m_IsByNeighbours = of.isByNeighbours;
    m_Line.weightSum = of.w;
    m_Line.pivotDn = pivot + of.wx / of.w;
    m_Line.spreadDn2 = of.determinant / of.w;
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
  const bool isOfOwn = sortedBy == SortedBy::OwnLevel;
  using SumsOfBins = std::array<double, VarianceCurve::Bins * CurveBin::Sums>;
  const std::vector<double> edges = EdgesOfEqualCount(m_Data.SampleLevels(), VarianceCurve::Bins);
  const double              toPivot = m_Line.pivotDn - line.pivotDn;
  const double              atPivot = line.intercept + line.gain * m_Line.pivotDn;
  const auto sumRun = [&](std::size_t first, std::size_t pixels, const KeptRun & kept, SumsOfBins & sums) {
    for (std::size_t i = 0; i < pixels; ++i)
    {
      const double w = kept.weight[i];
      if (w > 0.0)
      {
        double * own = sums.data() + CurveBin::Sums *
                                       BinOf(edges, isOfOwn ? m_Data.mean[first + i] : m_Data.neighbourMean[first + i]);
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
  return VarianceCurve::Of(line, s.data());
}

/** \file
 * Errors and curvature of the line of VarianceFit. */

namespace
{
/** Returns the covariance of (gain, intercept) from the sums of the squared weighted residuals times 1, x and x
 * squared, where x is the mean above the line's pivot. */
Eigen::Matrix2d
Sandwich(const VarianceLine & line, double squaresXX, double squaresX, double squares)
{
  // In the coordinates (gain, value at pivotDn) the information is diagonal.
  Eigen::Matrix2d inverse;
  inverse << 1.0 / line.spreadDn2, 0.0, 0.0, 1.0 / line.weightSum;
  Eigen::Matrix2d meat;
  meat << squaresXX, squaresX, squaresX, squares;
  Eigen::Matrix2d toIntercept;
  toIntercept << 1.0, 0.0, -line.pivotDn, 1.0;
  return toIntercept * inverse * meat * inverse * toIntercept.transpose();
}
} // namespace

void
VarianceFit::FillErrors()
{
  if (!m_Line.isDetermined)
  {
    return;
  }
  // Sums of the squared weight times the squared residual R times powers of z, and sums of the weight times powers of
  // x, R and z: x is the mean above the pivot, z the mean of the instrument, the pixel itself or its neighbours.
  enum : std::size_t
  {
    WWRR,
    WWRRZ,
    WWRRZZ,
    WZ,
    WX3,
    WX4,
    WXXR,
    KeptPixels,
    W,
    WXX,
    Sums
  };
  const double atPivot = m_Line.intercept + m_Line.gain * m_Line.pivotDn;
  const auto   terms = [atPivot, gain = m_Line.gain](double w, double x, double z, double value) {
    const double residual = value - atPivot - gain * x;
    const double square = w * w * residual * residual;
    const double wxx = w * x * x;
    return std::array<double, Sums>{ square,      square * z,     square * z * z,      w * z, wxx * x,
                                     wxx * x * x, wxx * residual, w > 0.0 ? 1.0 : 0.0, w,     wxx };
  };
  const auto   s = SumBlocks<Sums>(m_Data.pixels, m_ParallelFor, [&](std::size_t begin, std::size_t end, auto & sums) {
    this->ForKept(begin, end, [&](std::size_t, std::size_t, const KeptRun & kept) {
      AddTerms(terms, sums, kept.weight, kept.x, m_IsByNeighbours ? kept.neighbours : kept.x, kept.value);
    });
  });
  const double mean = m_IsByNeighbours ? s[WZ] / s[W] : 0.0; // the mean of x is 0, because the pivot is the mean
  m_Line.covariance =
    Sandwich(m_Line, s[WWRRZZ] - 2.0 * mean * s[WWRRZ] + mean * mean * s[WWRR], s[WWRRZ] - mean * s[WWRR], s[WWRR]);
  const auto pixels = static_cast<double>(m_Dofs.values);
  // Quadratic column of the parabola, orthogonal to the first two columns: q = x^2 - a x - b.
  const double a = s[WX3] / s[WXX];
  const double b = s[WXX] / s[W];
  const double quadratic = s[WX4] - a * s[WX3] - b * s[WXX];
  if (quadratic > 0.0)
  {
    m_Line.curvature = s[WXXR] / quadratic;
    m_Line.curvatureSd = 1.0 / std::sqrt(quadratic);
  }
  m_Line.trimmedFraction = (pixels - s[KeptPixels]) / pixels;
  m_Line.isDetermined = std::isfinite(m_Line.gain) && m_Line.covariance.allFinite();
}

SampledVariance::SampledVariance(const VarianceData & data, std::size_t most, const ParallelFor & parallelFor)
{
  const std::vector<std::size_t> pixels = SamplePixels(data.mask, data.pixels, most);
  m_Mean.resize(pixels.size());
  m_NeighbourMean.resize(pixels.size());
  m_Variance.resize(pixels.size());
  m_Dof.resize(pixels.size());
  m_Mask.assign(pixels.size(), 1);
  ForPixels(pixels.size(), parallelFor, [&](std::size_t i) {
    const std::size_t p = pixels[i];
    m_Mean[i] = data.mean[p];
    m_NeighbourMean[i] = data.neighbourMean[p];
    m_Variance[i] = data.variance[p];
    m_Dof[i] = data.dof[p];
  });
}

VarianceData
SampledVariance::GetData() const
{
  return { m_Mean.data(), m_NeighbourMean.data(), { m_Variance.data() }, m_Dof.data(), m_Mask.data(), m_Mask.size() };
}

} // namespace sensornoise
