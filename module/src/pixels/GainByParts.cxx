// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "pixels/GainByParts.h"

#include "base/Constants.h"
#include "base/Quantiles.h"
#include "pixels/Constants.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numeric>
#include <utility>

namespace sensornoise
{

namespace
{
/** Converts chi-square to standard deviations of a normal variable, by its cube root (Wilson & Hilferty 1931). */
double
StandardDeviationsOf(double chi2, double dof)
{
  const double s = 2.0 / (9.0 * dof);
  return (std::cbrt(chi2 / dof) - 1.0 + s) / std::sqrt(s);
}

/** Returns the standard deviations of chi-square by which the \a count coefficients from \a first on differ from the
 * coefficients of a uniform sensor: for a smooth field, all except the constant are 0; for parts, all are equal. */
double
SignificanceOf(const PartRegression & fit, Eigen::Index first, Eigen::Index count)
{
  const Eigen::Index rank = count - 1;
  Eigen::MatrixXd    contrast = Eigen::MatrixXd::Zero(rank, fit.theta.size());
  for (Eigen::Index k = 0; k < rank; ++k)
  {
    contrast(k, first + k + (fit.IsSmooth() ? 1 : 0)) = 1.0;
    contrast(k, first + count - 1) -= fit.IsSmooth() ? 0.0 : 1.0;
  }
  const Eigen::VectorXd difference = contrast * fit.theta;
  const Eigen::MatrixXd chance = contrast * fit.covariance * contrast.transpose();
  return StandardDeviationsOf(difference.dot(chance.ldlt().solve(difference)), static_cast<double>(rank));
}

/** Returns the fraction of the pixels in each part. */
Eigen::VectorXd
CoefficientsOf(Partition partition, const std::vector<TileExcess> & tiles)
{
  Eigen::VectorXd fraction = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(KindOf(partition).parts));
  for (const TileExcess & tile : tiles)
  {
    fraction(static_cast<Eigen::Index>(PartOf(partition, tile.x, tile.y, tile.phase))) += tile.pixels;
  }
  return fraction;
}

/** Deviations of a quantity of the parts, d or h of PartRegression, from its pixel-weighted mean. */
struct Deviations
{
  Eigen::VectorXd ofParts;    ///< deviation of each part [1]
  Eigen::MatrixXd covariance; ///< covariance of ofParts [1]
  Eigen::VectorXd field;      ///< coefficients of a smooth field [1]; otherwise empty
  double          size{ 0 };  ///< rms over the pixels, beyond chance [1]
  double          z{ 0 };     ///< significance, in standard deviations of chi-square [1]
};

/** Returns the deviations of the quantity whose \a count coefficients start at \a first. \a unit is the number that the
 * quantity is relative to: 1 plus its mean, or 1 [1]. */
Deviations
DeviationsOf(const PartRegression &  fit,
             Eigen::Index            first,
             Eigen::Index            count,
             double                  unit,
             const Eigen::VectorXd & fraction,
             const Eigen::MatrixXd & ofParts)
{
  const Eigen::RowVectorXd mean = fraction.transpose() * ofParts;
  const Eigen::MatrixXd    centred = (ofParts - Eigen::VectorXd::Ones(fraction.size()) * mean) / unit; // to first order
  Deviations               found;
  found.ofParts = centred * fit.theta;
  found.covariance = centred * fit.covariance * centred.transpose();
  found.size = std::sqrt(
    std::max(0.0, fraction.dot((found.ofParts.array().square() - found.covariance.diagonal().array()).matrix())));
  if (count > 1)
  {
    found.z = SignificanceOf(fit, first, count);
    if (fit.IsSmooth())
    {
      found.field = fit.theta.segment(first, count);
      found.field(0) -= mean * fit.theta;
      found.field /= unit;
    }
  }
  return found;
}

/** Returns the gains of the parts relative to their pixel-weighted mean, and their significance. */
PartGains
GainsOf(const PartRegression & fit, const std::vector<TileExcess> & tiles)
{
  PartGains gains;
  gains.partition = fit.partition;
  gains.scale = fit.scale;
  Eigen::VectorXd fraction = CoefficientsOf(fit.partition, tiles);
  gains.pixels.assign(fraction.data(), fraction.data() + fraction.size());
  fraction /= fraction.sum();
  const Eigen::MatrixXd toGains = fit.ToParts(tiles, 0, fit.gains);
  const Eigen::MatrixXd toDark = fit.ToParts(tiles, fit.gains, fit.darks);
  const double          mean = 1.0 + fraction.dot(toGains * fit.theta);
  const Deviations      excess = DeviationsOf(fit, 0, fit.gains, mean, fraction, toGains);
  const Deviations      dark = DeviationsOf(fit, fit.gains, fit.darks, 1.0, fraction, toDark);
  const Eigen::VectorXd error = excess.covariance.diagonal().cwiseMax(0.0).cwiseSqrt();
  gains.excess.assign(excess.ofParts.data(), excess.ofParts.data() + fraction.size());
  gains.error.assign(error.data(), error.data() + fraction.size());
  gains.dark.assign(dark.ofParts.data(), dark.ofParts.data() + fraction.size());
  gains.knotsDn = fit.knotsDn;
  const Eigen::VectorXd curve = fit.theta.segment(fit.gains + fit.darks, static_cast<Eigen::Index>(fit.knotsDn.size()));
  gains.curve.assign(curve.data(), curve.data() + curve.size());
  gains.meanExcess = mean - 1.0;
  gains.meanDark = fraction.dot(toDark * fit.theta);
  gains.size = excess.size;
  gains.z = excess.z;
  gains.field = excess.field;
  gains.darkSize = dark.size;
  gains.darkZ = dark.z;
  gains.darkField = dark.field;
  gains.darkCovariance = fit.covariance.block(fit.gains, fit.gains, fit.darks, fit.darks);
  gains.meanOfTerms = (fraction.transpose() * toDark).segment(fit.gains, fit.darks).transpose();
  return gains;
}

/** Returns whether one part with a detailed curve of the levels has a criterion below \a criterion: with a step at one
 * level, or with many knots. If the scene is a ramp or has patches of one level, a step and such a curve look like
 * differences of parts. */
bool
AreLevelsBetter(const std::vector<TileExcess> & tiles, double scale, double criterion)
{
  if (FitUniform(tiles, std::nullopt, InParts.levelsOfStep).Criterion(tiles, scale) < criterion)
  {
    return true;
  }
  std::vector<double> levels;
  std::transform(
    tiles.begin(), tiles.end(), std::back_inserter(levels), [](const TileExcess & tile) { return tile.levelDn; });
  std::sort(levels.begin(), levels.end());
  for (std::size_t k = 1; k < InParts.levelsOfStep; ++k)
  {
    const double fraction = static_cast<double>(k) / static_cast<double>(InParts.levelsOfStep);
    if (FitUniform(tiles, SortedQuantile(levels, fraction)).Criterion(tiles, scale) < criterion)
    {
      return true;
    }
  }
  return false;
}

bool
DiffersInAll(const PartRegression & fit)
{
  return fit.gains > 1 && (fit.IsSmooth() || fit.darks > 1);
}

/** Returns whether the parts differ only in the dark and have a criterion that is clearly below the criterion of one
 * part (\a uniform), even if the curve of the levels is detailed. */
bool
IsClearlyDark(const PartRegression & fit, const std::vector<TileExcess> & tiles, double scale, double uniform)
{
  const double criterion = fit.Criterion(tiles, scale) + InCommon.strongEvidence;
  return fit.darks > 1 && criterion < uniform && !AreLevelsBetter(tiles, scale, criterion);
}

/** Returns the fit with the lowest criterion among the fits that \a isMeant accepts; null: none is below \a limit. */
template <typename TFunction>
const PartRegression *
FindLowest(const std::vector<PartRegression> & fits,
           const std::vector<TileExcess> &     tiles,
           double                              scale,
           double                              limit,
           TFunction                           isMeant)
{
  const PartRegression * lowest = nullptr;
  for (const PartRegression & fit : fits)
  {
    const double criterion = fit.Criterion(tiles, scale);
    if (fit.isDetermined && isMeant(fit) && criterion < limit)
    {
      limit = criterion;
      lowest = &fit;
    }
  }
  return lowest;
}

/** Adds fits of parts that differ only in the gain or only in the dark, for the partitions where such fits can be
 * clearly better than one part (\a uniform). A fit with fewer coefficients never has a smaller loss. */
void
AddSimplerFits(std::vector<PartRegression> & fits, const std::vector<TileExcess> & tiles, double scale, double uniform)
{
  const std::size_t partitions = fits.size();
  for (std::size_t i = 0; i < partitions; ++i)
  {
    const double    parts = static_cast<double>(fits[i].gains);
    const double    saved = std::log(static_cast<double>(tiles.size())) * (parts - 1.0);
    const Partition partition = fits[i].partition;
    if (fits[i].IsSmooth())
    {
      fits.push_back(FitParts(partition, PartsDiffer::InTheDark, tiles));
    }
    else if (fits[i].Criterion(tiles, scale) - saved + InCommon.strongEvidence < uniform)
    {
      fits.push_back(FitParts(partition, PartsDiffer::InGain, tiles));
      fits.push_back(FitParts(partition, PartsDiffer::InTheDark, tiles));
    }
  }
}

/** Returns the partition by \a divided that describes the tiles best. Null if none is better than one part, or if its
 * parts do not differ. */
std::optional<PartGains>
FindBest(const std::vector<TileExcess> & tiles, Divided divided)
{
  if (tiles.size() < InParts.fewestTiles)
  {
    return std::nullopt;
  }
  std::vector<PartRegression> fits;
  double                      scale = std::numeric_limits<double>::infinity();
  for (const PartitionKind & kind : PartitionTable)
  {
    if (kind.divided == divided)
    {
      const bool isSmooth = kind.partition == Partition::SmoothField;
      fits.push_back(FitParts(kind.partition, isSmooth ? PartsDiffer::InGain : PartsDiffer::InBoth, tiles));
      scale = std::min(scale, fits.back().scale);
    }
  }
  const double limit = FitUniform(tiles).Criterion(tiles, scale);
  AddSimplerFits(fits, tiles, scale, limit);
  const auto             any = [](const PartRegression &) { return true; };
  const PartRegression * chosen = FindLowest(fits, tiles, scale, limit, any);
  // A camera changes its gain from frame to frame, and hardly its read noise alone.
  const bool isGainOfFrames = chosen != nullptr && divided == Divided::Frames && chosen->gains > 1;
  if (chosen != nullptr && !isGainOfFrames && !DiffersInAll(*chosen) && !IsClearlyDark(*chosen, tiles, scale, limit))
  {
    chosen = FindLowest(fits, tiles, scale, limit, DiffersInAll);
  }
  if (chosen == nullptr)
  {
    return std::nullopt;
  }
  PartGains  gains = GainsOf(*chosen, tiles);
  const bool isIdentifiable = gains.Differ() || gains.DarkVariancesDiffer();
  return isIdentifiable ? std::optional<PartGains>(std::move(gains)) : std::nullopt;
}
} // namespace

GainByParts
CompareParts(const PartTiles & tiles)
{
  GainByParts found;
  found.places = FindBest(tiles.places, Divided::Places);
  std::vector<TileExcess> phases = tiles.phases;
  if (found.places)
  {
    for (TileExcess & tile : phases)
    {
      const double ratio = found.places->RatioAt(tile.x, tile.y, tile.phase, tile.shotFraction, tile.levelDn);
      tile.excess = (1.0 + tile.excess) / ratio - 1.0;
    }
  }
  found.phases = FindBest(phases, Divided::Phases);
  return found;
}

std::vector<PartGains>
FindPossibleParts(const std::vector<TileExcess> & tiles)
{
  if (tiles.size() < InParts.fewestTiles)
  {
    return {};
  }
  const PartRegression   uniform = FitUniform(tiles);
  const double           criterion = uniform.Criterion(tiles, uniform.scale);
  std::vector<PartGains> possible;
  std::vector<double>    odds; // odds of each partition against one part
  for (const Partition partition : { Partition::LeftRight, Partition::UpperLower, Partition::Quadrants })
  {
    const PartRegression fit = FitParts(partition, PartsDiffer::InTheDark, tiles);
    const double         more = criterion - fit.Criterion(tiles, uniform.scale);
    if (fit.isDetermined)
    {
      const Eigen::VectorXd dark = fit.theta.segment(fit.gains, fit.darks);
      possible.push_back(GainsOf(fit, tiles));
      possible.back().darkCovariance = dark * dark.transpose() - possible.back().darkCovariance;
      odds.push_back(InParts.priorOfUnlikeParts * std::exp(0.5 * std::min(more, InCommon.strongEvidence)));
    }
  }
  const double all = std::accumulate(odds.begin(), odds.end(), 1.0);
  for (std::size_t k = 0; k < odds.size(); ++k)
  {
    possible[k].darkCovariance *= odds[k] / all;
  }
  return possible;
}

std::optional<PartGains>
CompareFrameParts(const std::vector<TileExcess> & tiles)
{
  std::optional<PartGains> found = FindBest(tiles, Divided::Frames);
  return found && found->Differ() ? found : std::nullopt;
}

} // namespace sensornoise
