// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "pixels/VarianceCurve.h"

#include "base/Constants.h"
#include "pixels/Constants.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

namespace sensornoise
{

namespace
{
std::vector<ExcessOfBin>
ComputeExcesses(const VarianceCurve & curve)
{
  std::vector<ExcessOfBin> bins;
  for (const CurveBin & bin : curve.bins)
  {
    if (bin.weight > 0.0)
    {
      bins.push_back({ bin.x / bin.weight, bin.excess / bin.weight, bin.weight });
    }
  }
  return bins;
}

/** Level at which the variance may have a step, and the fit of a line with that step. */
struct StepCandidate
{
  double                   x{ 0.0 };         // level of the step above the pivot [DN]
  double                   halfWidth{ 0.0 }; // half width of the interval without bins [DN]
  std::vector<ExcessOfBin> bins;             // bins outside of this interval
  CurveRegression<3>       fit;              // on 1, x and the step
};

CurveRegression<3>
FitStep(const std::vector<ExcessOfBin> & bins, double at)
{
  return RegressCurve<3>(bins, [at](double x) { return Eigen::Vector3d{ 1.0, x, x > at ? 1.0 : 0.0 }; });
}

/** Returns the candidate that reduces chi-square most compared with a line. */
std::optional<StepCandidate>
FindBestStep(const VarianceCurve & curve, const std::vector<ExcessOfBin> & bins)
{
  std::optional<StepCandidate> best;
  double                       most = 0.0;
  for (std::size_t b = InSteps.leastBins; b + InSteps.leastBins < bins.size(); ++b)
  {
    StepCandidate tried;
    tried.x = bins[b].x;
    // Beyond it, fewer than 5 % of a pixel's values are of the other amplifier.
    tried.halfWidth = Significance.hint * std::sqrt(std::max(0.0, curve.line.At(curve.line.pivotDn + tried.x)));
    std::size_t below = 0;
    for (std::size_t k = 0; k < bins.size(); ++k)
    {
      if (k != b && std::abs(bins[k].x - tried.x) > tried.halfWidth)
      {
        tried.bins.push_back(bins[k]);
        below += bins[k].x < tried.x ? 1 : 0;
      }
    }
    if (below < InSteps.leastBins || tried.bins.size() < below + InSteps.leastBins)
    {
      continue;
    }
    tried.fit = FitStep(tried.bins, tried.x);
    if (tried.fit.isDetermined)
    {
      const double size = tried.fit.coefficients(2);
      // Chi-square of a line minus chi-square with the step.
      const double gained = size * size / tried.fit.covariance(2, 2);
      if (gained > most)
      {
        most = gained;
        best = std::move(tried);
      }
    }
  }
  return best;
}

/** Returns the smallest chi-square of models without a step: a cubic, and broken lines with the break at any bin. */
double
LeastSmoothChi2(const std::vector<ExcessOfBin> & bins)
{
  const double scale = std::max(std::abs(bins.front().x), std::abs(bins.back().x));
  const auto   cubic = RegressCurve<4>(bins, [scale](double x) {
    const double s = x / scale;
    return Eigen::Vector4d{ 1.0, s, s * s, s * s * s };
  });
  double       least = cubic.isDetermined ? cubic.chi2 : std::numeric_limits<double>::infinity();
  for (const ExcessOfBin & knee : bins)
  {
    const auto twoLines =
      RegressCurve<3>(bins, [at = knee.x](double x) { return Eigen::Vector3d{ 1.0, x, std::max(0.0, x - at) }; });
    least = twoLines.isDetermined ? std::min(least, twoLines.chi2) : least;
  }
  return least;
}

/** Returns whether the step remains if a parabola, which describes a smooth non-linearity, is fitted too. */
bool
IsSignificantBesideCurve(const StepCandidate & step, double scatter)
{
  const auto fit = RegressCurve<4>(
    step.bins, [at = step.x](double x) { return Eigen::Vector4d{ 1.0, x, x * x, x > at ? 1.0 : 0.0 }; });
  const double ratio = fit.coefficients(3) / step.fit.coefficients(2);
  return fit.isDetermined && ratio > InSteps.leastBesideCurve &&
         std::abs(fit.coefficients(3)) > Significance.manyTests * std::sqrt(scatter * fit.covariance(3, 3));
}

/** Slope of one side minus the common slope, and its standard error [DN/e-]. */
struct SlopeOfSide
{
  double value{ 0.0 };
  double error{ 0.0 };
};

/** Estimates the slope of one side from its bins and from the prior standard deviation \a prior [DN/e-]. \a scatter is
 * the dispersion of the bins, which multiplies the variance [1]. */
SlopeOfSide
FitSide(const StepCandidate & step, bool isAbove, double prior, double scatter)
{
  std::vector<ExcessOfBin> side;
  for (const ExcessOfBin & bin : step.bins)
  {
    if ((bin.x > step.x) == isAbove)
    {
      side.push_back(bin);
    }
  }
  const auto fit = RegressCurve<2>(side, [](double x) { return Eigen::Vector2d{ 1.0, x }; });
  if (!fit.isDetermined)
  {
    return { 0.0, prior };
  }
  const double variance = scatter * fit.covariance(1, 1);
  const double fraction = prior * prior / (prior * prior + variance);
  return { fraction * (fit.coefficients(1) - step.fit.coefficients(1)), std::sqrt(fraction * variance) };
}
} // namespace

VarianceCurve
VarianceStep::RestOf(const VarianceCurve & curve) const
{
  VarianceCurve rest{ line, {} };
  for (const CurveBin & bin : curve.bins)
  {
    if (!(bin.weight > 0.0))
    {
      continue;
    }
    const double level = curve.LevelOf(bin);
    if (std::abs(level - levelDn) > halfWidthDn)
    {
      const double variance = curve.VarianceOf(bin);
      const double own = line.intercept + line.gain * level + (level > levelDn ? sizeDn2 : 0.0);
      rest.bins.push_back(
        { bin.pixels, bin.weight, bin.weight * (level - line.pivotDn), bin.weight * (variance - own) });
    }
  }
  return rest;
}

std::optional<VarianceStep>
FindVarianceStep(const VarianceCurve & curve)
{
  const std::vector<ExcessOfBin> bins = ComputeExcesses(curve);
  if (bins.size() < 2 * InSteps.leastBins + 1)
  {
    return std::nullopt;
  }
  const std::optional<StepCandidate> found = FindBestStep(curve, bins);
  if (!found)
  {
    return std::nullopt;
  }
  const CurveRegression<3> & fit = found->fit;
  // Four parameters, including the level of the step.
  const double dof = static_cast<double>(found->bins.size()) - 4.0;
  const double scatter = std::max(1.0, fit.chi2 / std::max(1.0, dof));
  VarianceStep step;
  step.levelDn = curve.line.pivotDn + found->x;
  step.halfWidthDn = std::max(found->halfWidth, 1e-9 * std::abs(step.levelDn));
  step.sizeDn2 = fit.coefficients(2);
  step.errorDn2 = std::sqrt(scatter * fit.covariance(2, 2));
  step.line = curve.line;
  step.line.gain += fit.coefficients(1);
  step.line.intercept += fit.coefficients(0) - fit.coefficients(1) * curve.line.pivotDn;
  const double below = step.line.intercept + step.line.gain * step.levelDn;
  const double least = InSteps.leastSize * std::max({ below, below + step.sizeDn2, 0.0 });
  const double gained = LeastSmoothChi2(found->bins) - fit.chi2; // compared with a smooth curve
  if (std::abs(step.sizeDn2) < least || std::abs(step.sizeDn2) < Significance.severalTests * step.errorDn2 ||
      gained < -InCommon.strongEvidence * scatter)
  {
    return std::nullopt;
  }
  step.isCertain = std::abs(step.sizeDn2) >= Significance.manyTests * step.errorDn2 &&
                   gained >= Significance.manyTests * Significance.manyTests * scatter &&
                   IsSignificantBesideCurve(*found, scatter);
  const double pivot = curve.line.pivotDn;
  auto &       covariance = step.line.covariance;
  covariance(0, 0) = fit.covariance(1, 1);
  covariance(0, 1) = covariance(1, 0) = fit.covariance(0, 1) - pivot * fit.covariance(1, 1);
  covariance(1, 1) = fit.covariance(0, 0) - 2.0 * pivot * fit.covariance(0, 1) + pivot * pivot * fit.covariance(1, 1);
  covariance *= scatter;
  const double      prior = InSteps.priorOfGains * std::abs(step.line.gain);
  const SlopeOfSide ofBelow = FitSide(*found, false, prior, scatter);
  const SlopeOfSide ofAbove = FitSide(*found, true, prior, scatter);
  step.slopeBelow = ofBelow.value;
  step.slopeAbove = ofAbove.value;
  step.errorOfSlopes = std::max(ofBelow.error, ofAbove.error);
  return step;
}

} // namespace sensornoise
