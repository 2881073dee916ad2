// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "pixels/GainByParts.h"

#include "base/Constants.h"
#include "base/Quantiles.h"
#include "pixels/Constants.h"
#include "pixels/PartRegression.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
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

/** Returns the standard deviations of chi-square by which \a count coefficients from \a first on differ from 0 or, with
 * \a fromTheLast, from the last of them. The \a count - 1 differences from the last are linearly independent. */
double
SignificanceOf(const PartRegression & fit, Eigen::Index first, Eigen::Index count, bool fromTheLast)
{
  const Eigen::Index rank = fromTheLast ? count - 1 : count;
  Eigen::MatrixXd    contrast = Eigen::MatrixXd::Zero(rank, fit.theta.size());
  for (Eigen::Index k = 0; k < rank; ++k)
  {
    contrast(k, first + k) = 1.0;
    contrast(k, first + count - 1) -= fromTheLast ? 1.0 : 0.0;
  }
  const Eigen::VectorXd difference = contrast * fit.theta;
  const Eigen::MatrixXd chance = contrast * fit.covariance * contrast.transpose();
  return StandardDeviationsOf(difference.dot(chance.ldlt().solve(difference)), static_cast<double>(rank));
}

/** Sets the gains of the parts relative to their pixel-weighted mean, and their significance. */
void
FillGains(PartGains & gains, const PartRegression & fit, const std::vector<TileExcess> & tiles)
{
  const auto            parts = static_cast<Eigen::Index>(KindOf(gains.partition).parts);
  const Eigen::MatrixXd ofParts = fit.ToParts(tiles); // parts from coefficients
  Eigen::VectorXd       share = Eigen::VectorXd::Zero(parts);
  for (const TileExcess & tile : tiles)
  {
    share(static_cast<Eigen::Index>(PartOf(gains.partition, tile.x, tile.y, tile.phase))) += tile.pixels;
  }
  gains.pixels.assign(share.data(), share.data() + parts);
  share /= share.sum();
  const Eigen::VectorXd relative = Eigen::VectorXd::Ones(parts) + ofParts * fit.theta;
  const double          mean = share.dot(relative);
  const Eigen::MatrixXd centred =
    (ofParts - Eigen::VectorXd::Ones(parts) * (share.transpose() * ofParts)) / mean; // to first order
  const Eigen::MatrixXd covariance = centred * fit.covariance * centred.transpose();
  double                square = 0.0;
  for (Eigen::Index k = 0; k < parts; ++k)
  {
    gains.excess.push_back(relative(k) / mean - 1.0);
    gains.error.push_back(std::sqrt(std::max(0.0, covariance(k, k))));
    square += share(k) * (gains.excess.back() * gains.excess.back() - covariance(k, k));
  }
  gains.size = std::sqrt(std::max(0.0, square));
  if (fit.gains > 1)
  {
    gains.z = fit.IsSmooth() ? SignificanceOf(fit, 1, fit.gains - 1, false) : SignificanceOf(fit, 0, parts, true);
  }
  if (fit.darks > 1)
  {
    const Eigen::VectorXd dark = fit.theta.segment(fit.gains, parts);
    const Eigen::VectorXd beyond =
      (dark.array() - share.dot(dark)).square() - fit.covariance.diagonal().segment(fit.gains, parts).array();
    gains.darkSize = std::sqrt(std::max(0.0, share.dot(beyond)));
    gains.darkZ = SignificanceOf(fit, fit.gains, parts, true);
  }
}

PartGains
GainsOf(const PartRegression & fit, const std::vector<TileExcess> & tiles)
{
  PartGains gains;
  gains.partition = fit.partition;
  gains.scale = fit.scale;
  FillGains(gains, fit, tiles);
  gains.dark.assign(fit.theta.data() + fit.gains, fit.theta.data() + fit.gains + fit.darks);
  if (fit.IsSmooth())
  {
    gains.field = fit.theta.head(fit.gains);
  }
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
  return fit.IsSmooth() || (fit.gains > 1 && fit.darks > 1);
}

/** Returns whether the parts differ only in the dark and have a criterion that is clearly below the criterion of one
 * part (\a uniform), even if the curve of the levels is detailed. */
bool
IsClearlyDark(const PartRegression & fit, const std::vector<TileExcess> & tiles, double scale, double uniform)
{
  const double criterion = fit.Criterion(tiles, scale) + InCommon.strongEvidence;
  return fit.darks > 1 && criterion < uniform && !AreLevelsBetter(tiles, scale, criterion);
}

/** Returns the fit of the lowest criterion among those that \a isMeant accepts; null: none is below \a limit. */
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
    const double parts = static_cast<double>(fits[i].gains);
    const double saved = std::log(static_cast<double>(tiles.size())) * (parts - 1.0);
    if (!fits[i].IsSmooth() && fits[i].Criterion(tiles, scale) - saved + InCommon.strongEvidence < uniform)
    {
      const Partition partition = fits[i].partition;
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
      fits.push_back(FitParts(kind.partition, PartsDiffer::InBoth, tiles));
      scale = std::min(scale, fits.back().scale);
    }
  }
  const double limit = FitUniform(tiles).Criterion(tiles, scale);
  AddSimplerFits(fits, tiles, scale, limit);
  const auto             any = [](const PartRegression &) { return true; };
  const PartRegression * chosen = FindLowest(fits, tiles, scale, limit, any);
  if (chosen != nullptr && !DiffersInAll(*chosen) && !IsClearlyDark(*chosen, tiles, scale, limit))
  {
    chosen = FindLowest(fits, tiles, scale, limit, DiffersInAll);
  }
  if (chosen == nullptr)
  {
    return std::nullopt;
  }
  PartGains  gains = GainsOf(*chosen, tiles);
  const bool isTold = gains.Differ() || gains.DarkVariancesDiffer();
  return isTold ? std::optional<PartGains>(std::move(gains)) : std::nullopt;
}

std::size_t
PhaseOf(std::size_t x, std::size_t y)
{
  return LargestPeriod * (y % LargestPeriod) + x % LargestPeriod;
}
} // namespace

double
PartGains::RatioAt(double x, double y, std::size_t phase, double shotFraction) const
{
  const std::size_t part = PartOf(partition, x, y, phase);
  const double      gain = field.size() > 0 ? PartRegression::FieldAt(x, y).dot(field) : excess[part];
  return std::max(InCommon.leastVarianceRatio,
                  1.0 + shotFraction * gain + (1.0 - shotFraction) * dark[part % dark.size()]);
}

bool
PartGains::Differ() const
{
  return size > InParts.leastDifference && z > Significance.manyTests;
}

bool
PartGains::DarkVariancesDiffer() const
{
  return darkSize > InCommon.leastDarkDifference && darkZ > Significance.severalTests;
}

bool
PartGains::DifferMuch() const
{
  return ((this->Differ() && size > InParts.largeDifference) || this->DarkVariancesDiffer()) &&
         scale < InParts.largestScatter;
}

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
      const double ratio = found.places->RatioAt(tile.x, tile.y, tile.phase, tile.shotFraction);
      tile.excess = (1.0 + tile.excess) / ratio - 1.0;
    }
  }
  found.phases = FindBest(phases, Divided::Phases);
  return found;
}

std::optional<PartGains>
CompareFrameParts(const std::vector<TileExcess> & tiles)
{
  std::optional<PartGains> found = FindBest(tiles, Divided::Frames);
  return found && found->Differ() ? found : std::nullopt;
}

std::vector<float>
MapOfRatios(const GainByParts &         parts,
            const std::vector<double> & mean,
            const FrameGeometry &       geometry,
            const PartReference &       reference,
            const ParallelFor &         parallelFor)
{
  std::vector<float> ratios(mean.size(), 1.0F);
  const auto         width = static_cast<double>(geometry.width);
  const auto         height = static_cast<double>(geometry.height);
  parallelFor(geometry.height, [&](std::size_t row) {
    const double y = (static_cast<double>(row) + 0.5) / height;
    for (std::size_t column = 0; column < geometry.width; ++column)
    {
      const std::size_t p = row * geometry.width + column;
      const double      x = (static_cast<double>(column) + 0.5) / width;
      const double      expected = reference.line.At(mean[p]);
      const double      shot =
        expected > 0.0 ? std::clamp(reference.line.gain * (mean[p] - reference.blackDn) / expected, 0.0, 1.0) : 0.0;
      double ratio = 1.0;
      for (const auto * const own : { &parts.places, &parts.phases })
      {
        ratio *= *own ? (*own)->RatioAt(x, y, PhaseOf(column, row), shot) : 1.0;
      }
      ratios[p] = static_cast<float>(ratio);
    }
  });
  return ratios;
}

} // namespace sensornoise
