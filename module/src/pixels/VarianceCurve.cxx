// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "pixels/VarianceCurve.h"

#include "base/Eigen.h"
#include "base/Constants.h"
#include "base/Jackknife.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

namespace sensornoise
{

CurveBin &
CurveBin::operator+=(const CurveBin & other)
{
  pixels += other.pixels;
  weight += other.weight;
  x += other.x;
  excess += other.excess;
  return *this;
}

CurveBin
VarianceCurve::SumOf(std::size_t first, std::size_t last) const
{
  CurveBin sum;
  for (std::size_t b = first; b < last; ++b)
  {
    sum += bins[b];
  }
  return sum;
}

VarianceCurve
VarianceCurve::Of(const VarianceLine & line, const double * sums)
{
  VarianceCurve curve{ line, {} };
  for (std::size_t b = 0; b < Bins; ++b)
  {
    const double * own = sums + CurveBin::Sums * b;
    if (own[1] > 0.0)
    {
      curve.bins.push_back({ own[0], own[1], own[2], own[3] });
    }
  }
  return curve;
}

double
VarianceCurve::ReducedChi2(double varianceInflation) const
{
  double chi2 = 0.0;
  double used = 0.0;
  for (const CurveBin & bin : bins)
  {
    if (bin.weight > 0.0)
    {
      chi2 += bin.excess * bin.excess / bin.weight;
      used += 1.0;
    }
  }
  const double reduced = used > 2.0 ? chi2 / (used - 2.0) : 1.0;
  return reduced / std::clamp(reduced, 1.0, varianceInflation);
}

double
VarianceCurve::Nonlinearity(double dispersion) const
{
  double largest = 0.0;
  for (std::size_t g = 0; g < Groups; ++g)
  {
    const CurveBin group = this->SumOf(g * bins.size() / Groups, (g + 1) * bins.size() / Groups);
    if (group.weight > 0.0)
    {
      const double excess = group.excess / group.weight;
      const double square = excess * excess - Significance.oneTest * Significance.oneTest * dispersion / group.weight;
      largest = std::max(largest, std::sqrt(std::max(0.0, square)) / line.At(this->LevelOf(group)));
    }
  }
  return largest;
}

double
VarianceCurve::DarkestFraction(double blackDn) const
{
  if (bins.empty())
  {
    return 1.0;
  }
  const double brightest = this->LevelOf(bins.back()) - blackDn;
  return brightest > 0.0 ? std::clamp((this->LevelOf(bins.front()) - blackDn) / brightest, 0.0, 1.0) : 1.0;
}

VarianceCurve::Slope
VarianceCurve::SlopeOf(std::size_t first, std::size_t last) const
{
  // Only differences between bins are used: within a bin, levels also differ by fixed-pattern noise.
  const CurveBin all = this->SumOf(first, last);
  const double   centre = all.weight > 0.0 ? all.x / all.weight : 0.0;
  double         information = 0.0;
  double         product = 0.0;
  for (std::size_t b = first; b < last; ++b)
  {
    const double x = bins[b].x / bins[b].weight - centre;
    information += bins[b].weight * x * x;
    product += bins[b].excess * x;
  }
  return { information, all.weight, information > 0.0 ? product / information : 0.0 };
}

std::vector<SlopeExcess>
VarianceCurve::FitHalves() const
{
  const CurveBin all = this->SumOf(0, bins.size());
  const Slope    whole = this->SlopeOf(0, bins.size());
  double         pixels = 0.0;
  double         information = 0.0;
  std::size_t    byCount = 0;
  std::size_t    byInformation = 0;
  for (const CurveBin & bin : bins)
  {
    const double x = bin.x / bin.weight - all.x / all.weight;
    pixels += bin.pixels;
    information += bin.weight * x * x;
    byCount += pixels <= 0.5 * all.pixels ? 1 : 0;
    byInformation += information <= 0.5 * whole.information ? 1 : 0;
  }
  std::vector<SlopeExcess> slopes;
  for (const std::size_t middle : { byCount, byInformation })
  {
    for (const Slope & half : { this->SlopeOf(0, middle), this->SlopeOf(middle, bins.size()) })
    {
      if (half.information > 1e-9 * whole.information)
      {
        slopes.push_back({ half.excess,
                           std::max(0.0, 1.0 / half.information - 1.0 / whole.information),
                           half.information / half.weight });
      }
    }
  }
  return slopes;
}

namespace
{
/** Adjacent bins of a curve. */
struct GroupOfBins
{
  std::vector<CurveBin> bins;

  GroupOfBins &
  operator+=(const GroupOfBins & other)
  {
    bins.insert(bins.end(), other.bins.begin(), other.bins.end());
    return *this;
  }
};
} // namespace

double
VarianceCurve::SlopeVarianceByGroups() const
{
  const CurveBin           all = this->SumOf(0, bins.size());
  const Slope              whole = this->SlopeOf(0, bins.size());
  std::vector<GroupOfBins> groups;
  double                   information = 0.0;
  bool                     isComplete = true; // the last group
  for (const CurveBin & bin : bins)
  {
    if (isComplete)
    {
      groups.emplace_back();
    }
    groups.back().bins.push_back(bin);
    const double x = bin.x / bin.weight - all.x / all.weight;
    information += bin.weight * x * x;
    isComplete = information * Groups >= whole.information * static_cast<double>(groups.size());
  }
  bool                    isDetermined = groups.size() > 1;
  const JackknifeEstimate slope = Jackknife(groups, [&](const GroupOfBins & rest) {
    const VarianceCurve curve{ line, rest.bins };
    const Slope         ofRest = curve.SlopeOf(0, rest.bins.size());
    isDetermined = isDetermined && ofRest.information > 0.0;
    return Eigen::VectorXd::Constant(1, ofRest.excess);
  });
  return isDetermined ? slope.covariance(0, 0) : 0.0;
}

namespace
{
/** The levels of the curve's bins, from 0 at the darkest to 1 at the brightest, and the line along them. */
struct ScaledCurve
{
  std::vector<double> level;
  std::vector<double> pixels;
  double              lineAtDarkest{ 0.0 }; // [DN^2]
  double              lineRise{ 0.0 };      // from the darkest to the brightest [DN^2]
  double              rangeDn{ 0.0 };
  double              darkestSignalDn{ 0.0 }; // signal at the darkest level [DN]; 0: taken to be small
};

double
PolynomialAt(const Eigen::VectorXd & coefficients, double x)
{
  double value = 0.0;
  for (Eigen::Index k = coefficients.size(); k-- > 0;)
  {
    value = value * x + coefficients(k);
  }
  return value;
}

/** Returns the inverse of a matrix of normal equations; null if they do not determine all terms. */
std::optional<Eigen::MatrixXd>
InverseOf(Eigen::MatrixXd matrix)
{
  double     smallest = std::numeric_limits<double>::infinity();
  double     largest = 0.0;
  const bool isDetermined = InvertNormalEquations(matrix, [&](Eigen::Index, double pivot) {
    smallest = std::min(smallest, pivot);
    largest = std::max(largest, pivot);
    return smallest > 1e-10 * largest;
  });
  return isDetermined ? std::optional(std::move(matrix)) : std::nullopt;
}

/** Returns the mean local gain of the line plus the polynomial \a excess; null if there is none, see FindMeanGain(). */
std::optional<double>
MeanLocalGain(const ScaledCurve & curve, const Eigen::VectorXd & excess)
{
  const auto   at = [&](double x) { return curve.lineAtDarkest + curve.lineRise * x + PolynomialAt(excess, x); };
  const double slope = (curve.lineRise + excess(1)) / curve.rangeDn;
  const double darkest = at(0.0);
  if (!(slope > 0.0) || !(darkest > 0.0))
  {
    return std::nullopt;
  }
  double z = std::sqrt(darkest) / slope;
  if (curve.darkestSignalDn > 0.0)
  {
    const double power = std::min(1.9, slope * curve.darkestSignalDn / darkest);
    z = curve.darkestSignalDn / ((2.0 - power) * std::sqrt(darkest));
  }
  double sum = 0.0;
  double count = 0.0;
  double x = 0.0;
  for (std::size_t b = 0; b < curve.level.size(); ++b)
  {
    // V is taken to be a line over each step, which is exact for a line, however steep its square root is near the
    // dark.
    constexpr int steps = 8;
    const double  step = (curve.level[b] - x) / steps;
    for (int i = 0; i < steps && step > 0.0; ++i)
    {
      const double first = at(x);
      const double last = at(x + step);
      if (!(first > 0.0 && last > 0.0))
      {
        return std::nullopt;
      }
      z += curve.rangeDn * step / (std::sqrt(first) + std::sqrt(last));
      x += step;
    }
    sum += curve.pixels[b] * std::sqrt(at(curve.level[b])) / z;
    count += curve.pixels[b];
  }
  return sum / count;
}
} // namespace

std::optional<MeanGain>
FindMeanGain(const VarianceCurve & curve, int degree, const std::optional<double> & offsetDn)
{
  const auto terms = static_cast<Eigen::Index>(degree + 1);
  if (curve.bins.size() < static_cast<std::size_t>(degree) + 2)
  {
    return std::nullopt;
  }
  // The bins are sorted by the levels of the neighbours, so their own levels need not rise.
  const auto            levelOf = [](const CurveBin & bin) { return bin.x / bin.weight; };
  std::vector<CurveBin> bins = curve.bins;
  std::sort(bins.begin(), bins.end(), [&](const CurveBin & a, const CurveBin & b) { return levelOf(a) < levelOf(b); });
  const double darkest = levelOf(bins.front());
  ScaledCurve  scaled;
  scaled.rangeDn = levelOf(bins.back()) - darkest;
  scaled.darkestSignalDn = offsetDn ? std::max(0.0, curve.line.pivotDn + darkest - *offsetDn) : 0.0;
  scaled.lineAtDarkest = curve.line.intercept + curve.line.gain * (curve.line.pivotDn + darkest);
  scaled.lineRise = curve.line.gain * scaled.rangeDn;
  Eigen::MatrixXd gram = Eigen::MatrixXd::Zero(terms, terms);
  Eigen::VectorXd right = Eigen::VectorXd::Zero(terms);
  double          information = 0.0;
  for (const CurveBin & bin : bins)
  {
    const double    x = (levelOf(bin) - darkest) / scaled.rangeDn;
    Eigen::VectorXd powers(terms);
    for (Eigen::Index k = 0; k < terms; ++k)
    {
      powers(k) = std::pow(x, static_cast<double>(k));
    }
    gram += bin.weight * powers * powers.transpose();
    right += bin.excess * powers;
    scaled.level.push_back(x);
    scaled.pixels.push_back(bin.pixels);
    information += bin.weight * std::pow(bin.x / bin.weight, 2);
  }
  const std::optional<Eigen::MatrixXd> covariance = InverseOf(gram);
  if (!covariance || !(scaled.rangeDn > 0.0))
  {
    return std::nullopt;
  }
  const Eigen::VectorXd       excess = ProductInLoops(*covariance, right);
  const std::optional<double> value = MeanLocalGain(scaled, excess);
  if (!value)
  {
    return std::nullopt;
  }
  // Derivatives of the gain with respect to the coefficients, by differences of a tenth of a standard error.
  Eigen::VectorXd derivative(terms);
  for (Eigen::Index k = 0; k < terms; ++k)
  {
    const double    step = std::sqrt((*covariance)(k, k));
    Eigen::VectorXd moved = excess;
    moved(k) += 0.1 * step;
    derivative(k) = (MeanLocalGain(scaled, moved).value_or(*value) - *value) / (0.1 * step);
  }
  const Eigen::VectorXd moment = ProductInLoops(*covariance, derivative);
  double                variance = -1.0 / information; // sampling variance of the line's gain, which is subtracted
  for (Eigen::Index k = 0; k < terms; ++k)
  {
    variance += derivative(k) * moment(k);
  }
  return MeanGain{ *value, std::max(0.0, variance) };
}

} // namespace sensornoise
