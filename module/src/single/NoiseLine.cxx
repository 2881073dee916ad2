// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "single/NoiseLine.h"

#include "base/ChiSquare.h"
#include "single/Constants.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace sensornoise
{
namespace
{
/** Standard deviations from a clip level beyond which clipping changes no digit of the moments [1]: 1e-15 is cut off.
 */
constexpr double NoClipping = 8.0;

double
NormalDensity(double z)
{
  constexpr double rootOf2Pi = 2.5066282746310002;
  return std::exp(-0.5 * z * z) / rootOf2Pi;
}

double
NormalTail(double z)
{
  constexpr double rootOf2 = 1.4142135623730951;
  return 0.5 * std::erfc(z / rootOf2);
}
} // namespace

ClippedMoments
MomentsOfClipped(double meanDn, double sdDn, const ClipLevels & levels)
{
  // Beyond this distance the densities are 0, and an infinite level must not be multiplied by 0.
  constexpr double farthest = 40.0;
  const double     low = std::clamp((levels.lowDn - meanDn) / sdDn, -farthest, farthest);
  const double     high = std::clamp((levels.highDn - meanDn) / sdDn, -farthest, farthest);
  if (low < -NoClipping && high > NoClipping)
  {
    return { meanDn, sdDn * sdDn, 1.0 };
  }
  const double below = NormalTail(-low);
  const double above = NormalTail(high);
  const double inside = 1.0 - below - above;
  const double densityLow = NormalDensity(low);
  const double densityHigh = NormalDensity(high);
  // The moments are in standard deviations from the mean before clipping.
  const double first = densityLow - densityHigh + low * below + high * above;
  const double second = inside + low * densityLow - high * densityHigh + low * low * below + high * high * above;
  return { meanDn + sdDn * first, sdDn * sdDn * std::max(0.0, second - first * first), std::max(0.0, inside) };
}

ClippedMoments
ClippedAtMean(double clippedMeanDn, const CentredLine & line, const ClipLevels & levels, double leastVarianceDn2)
{
  const auto sdAt = [&](double level) { return std::sqrt(std::max(line.At(level), leastVarianceDn2)); };
  // The mean of clipped values rises with the mean before clipping, by the probability of a value in between.
  constexpr int    steps = 60;
  constexpr double leastRise = 0.1;
  constexpr double enough = 1e-9; // standard deviations
  constexpr double farthest = 3.0;
  double           level = clippedMeanDn;
  ClippedMoments   moments{};
  for (int i = 0; i < steps; ++i)
  {
    const double sd = sdAt(level);
    moments = MomentsOfClipped(level, sd, levels);
    const double missing = clippedMeanDn - moments.meanDn;
    if (std::abs(missing) <= enough * sd)
    {
      break;
    }
    level = std::clamp(level + missing / std::max(moments.unclipped, leastRise),
                       levels.lowDn - farthest * sd,
                       levels.highDn + farthest * sd);
  }
  moments.varianceDn2 = std::max(moments.varianceDn2, leastVarianceDn2);
  return moments;
}

namespace
{
/** Sums of the normal equations of Fisher scoring, whose unknowns are the variance at the centre and the slope. */
struct NormalSums
{
  double cc{ 0.0 };
  double cs{ 0.0 };
  double ss{ 0.0 };
  double c{ 0.0 };
  double s{ 0.0 };
  double chi2{ 0.0 };

  double
  Determinant() const
  {
    return cc * ss - cs * cs;
  }
  bool
  IsRegular() const
  {
    constexpr double least = 1e-10; // fraction of the product of the diagonal: rounding leaves 6 digits
    return this->Determinant() > least * cc * ss;
  }
};

/** Weighted mean level, and the root mean square of levels about it. */
struct LevelSpread
{
  double centreDn{ 0.0 };
  double rmsDn{ 0.0 };
};

LevelSpread
SpreadOf(const std::vector<LevelSet> & sets)
{
  double weights = 0.0;
  double sum = 0.0;
  double squares = 0.0;
  for (const LevelSet & set : sets)
  {
    weights += set.details;
    sum += set.details * set.levelDn;
  }
  const double centre = weights > 0.0 ? sum / weights : 0.0;
  for (const LevelSet & set : sets)
  {
    squares += set.details * (set.levelDn - centre) * (set.levelDn - centre);
  }
  return { centre, weights > 0.0 ? std::sqrt(squares / weights) : 0.0 };
}

/** Evaluation of the model: expected variances, the sets that are fitted, and the sums. */
struct LineFit
{
  const std::vector<LevelSet> & sets;
  const ClipLevels &            levels;
  double                        leastVarianceDn2;
  double                        rmsDn;

  NormalSums
  Evaluate(NoiseLine & fit) const
  {
    NormalSums sums;
    fit.details = 0.0;
    const CentredLine & line = fit.line;
    // step of the numerical derivatives
    const double stepDn2 = 1e-4 * std::max(std::abs(line.atCentreDn2), leastVarianceDn2);
    CentredLine  higher = line;
    CentredLine  steeper = line;
    higher.atCentreDn2 += stepDn2;
    steeper.slopeDn += stepDn2 / rmsDn;
    for (std::size_t i = 0; i < sets.size(); ++i)
    {
      const LevelSet & set = sets[i];
      const auto at = [&](const CentredLine & of) { return ClippedAtMean(set.levelDn, of, levels, leastVarianceDn2); };
      const ClippedMoments moments = at(line);
      const double         expected = moments.varianceDn2;
      fit.expectedDn2[i] = expected;
      fit.isFitted[i] = set.details >= InSingle.leastOfLevelSet && moments.unclipped > InSingle.leastUnclipped;
      if (!fit.isFitted[i])
      {
        continue;
      }
      const double weight = set.details / TruncatedVariance;
      const double byCentre = (at(higher).varianceDn2 - expected) / (stepDn2 * expected);
      const double bySlope = (at(steeper).varianceDn2 - expected) * rmsDn / (stepDn2 * expected);
      const double residual = set.varianceDn2 / expected - 1.0;
      const double pull = std::min(residual, InSingle.largestResidual);
      fit.details += set.details;
      sums.cc += weight * byCentre * byCentre;
      sums.cs += weight * byCentre * bySlope;
      sums.ss += weight * bySlope * bySlope;
      sums.c += weight * byCentre * pull;
      sums.s += weight * bySlope * pull;
      sums.chi2 += weight * residual * residual;
    }
    return sums;
  }
};
} // namespace

NoiseLine
FitNoiseLine(const std::vector<LevelSet> & sets,
             const ClipLevels &            levels,
             double                        leastVarianceDn2,
             const CentredLine &           start)
{
  NoiseLine         fit;
  const LevelSpread spread = SpreadOf(sets);
  fit.line = { spread.centreDn, start.slopeDn, start.At(spread.centreDn) };
  fit.expectedDn2.resize(sets.size());
  fit.isFitted.resize(sets.size());
  if (!(spread.rmsDn > 0.0) || !std::isfinite(fit.line.atCentreDn2))
  {
    return fit;
  }
  const LineFit problem{ sets, levels, leastVarianceDn2, spread.rmsDn };
  NormalSums    sums = problem.Evaluate(fit);
  for (int i = 0; i < InSingle.fitSteps; ++i)
  {
    const auto fitted = static_cast<std::size_t>(std::count(fit.isFitted.begin(), fit.isFitted.end(), true));
    if (fitted < InCommon.fewestLevels || !sums.IsRegular())
    {
      return fit;
    }
    const double determinant = sums.Determinant();
    const double higher = (sums.ss * sums.c - sums.cs * sums.s) / determinant;
    const double steeper = (sums.cc * sums.s - sums.cs * sums.c) / determinant;
    fit.line.atCentreDn2 += higher;
    fit.line.slopeDn += steeper;
    sums = problem.Evaluate(fit);
    fit.reducedChi2 = sums.chi2 / static_cast<double>(std::max<std::size_t>(1, fitted - 2));
    constexpr double enough = 1e-9; // relative to the variance
    if (std::abs(higher) + std::abs(steeper) * spread.rmsDn <= enough * std::abs(fit.line.atCentreDn2))
    {
      break;
    }
  }
  if (!sums.IsRegular())
  {
    return fit;
  }
  const double scale = std::max(1.0, fit.reducedChi2) / sums.Determinant();
  fit.centreVariance = scale * sums.ss;
  fit.slopeVariance = scale * sums.cc;
  fit.slopeCovariance = -scale * sums.cs;
  fit.isDetermined = std::isfinite(fit.line.slopeDn) && std::isfinite(fit.line.atCentreDn2);
  return fit;
}

} // namespace sensornoise
