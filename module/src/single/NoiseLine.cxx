// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "single/NoiseLine.h"

#include "single/Constants.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace sensornoise
{
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
    constexpr double least = 1e-10; // of the product of the diagonal: rounding leaves 6 digits
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

/** One evaluation of the model: expected variances, which sets are fitted, and the sums. */
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
    const double        stepDn2 = 1e-4 * std::max(std::abs(line.atCentreDn2), leastVarianceDn2); // of the derivatives
    CentredLine         higher = line;
    CentredLine         steeper = line;
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
      const double weight = set.details / InSingle.truncatedVariance;
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
    if (fitted < InSingle.leastLevelSets || !sums.IsRegular())
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
