// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "pixels/GainByParts.h"

#include "base/Constants.h"
#include "base/Quantiles.h"
#include "pixels/Constants.h"
#include "pixels/ProjectedVariance.h"
#include "pixels/StaticVariance.h"
#include "sensornoise/FrameGeometry.h"
#include "sensornoise/Parallel.h"
#include "sensornoise/Report.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

namespace sensornoise
{

namespace
{
/** Returns the phase of a pixel in the pattern, see PartOf(). */
std::size_t
PhaseOf(std::size_t x, std::size_t y)
{
  return LargestPeriod * (y % LargestPeriod) + x % LargestPeriod;
}

/** Returns the value at \a x between \a values at \a knots, and the outermost value beyond them; 0 without knots. */
double
Interpolate(const std::vector<double> & knots, const std::vector<double> & values, double x)
{
  const auto next = std::upper_bound(knots.begin(), knots.end(), x);
  if (next == knots.begin() || next == knots.end())
  {
    return values.empty() ? 0.0 : next == knots.begin() ? values.front() : values.back();
  }
  const auto   k = static_cast<std::size_t>(next - knots.begin());
  const double part = (x - knots[k - 1]) / (knots[k] - knots[k - 1]);
  return values[k - 1] + part * (values[k] - values[k - 1]);
}

/** Returns the fraction of the line's variance at a level that is shot noise [1]. */
double
ShotFractionAt(const PartReference & reference, double meanDn)
{
  const double expected = reference.line.At(meanDn);
  return expected > 0.0 ? std::clamp(reference.line.gain * (meanDn - reference.blackDn) / expected, 0.0, 1.0) : 0.0;
}
} // namespace

double
PartGains::RatioAt(double x, double y, std::size_t phase, double shotFraction, double levelDn) const
{
  const std::size_t part = PartOf(partition, x, y, phase);
  const auto        at = [&](const Eigen::VectorXd & smooth, const std::vector<double> & ofParts) {
    return smooth.size() > 0 ? PartRegression::FieldAt(x, y).dot(smooth) : ofParts[part];
  };
  // The line is the reference; where parts differ much, their mean differs from it, too.
  const double mean =
    1.0 + shotFraction * meanExcess + (1.0 - shotFraction) * meanDark + Interpolate(knotsDn, curve, levelDn);
  const double more =
    shotFraction * (1.0 + meanExcess) * at(field, excess) + (1.0 - shotFraction) * at(darkField, dark);
  return std::max(InCommon.leastVarianceRatio, 1.0 + more / std::max(InCommon.leastVarianceRatio, mean));
}

void
PartGains::CentreOn(const std::vector<std::uint8_t> & mask, const FrameGeometry & geometry)
{
  if (partition == Partition::SmoothField)
  {
    return;
  }
  std::vector<double> counts(excess.size(), 0.0);
  for (std::size_t p = 0; p < mask.size(); ++p)
  {
    const std::size_t column = p % geometry.width;
    const std::size_t row = p / geometry.width;
    const double      x = (static_cast<double>(column) + 0.5) / static_cast<double>(geometry.width);
    const double      y = (static_cast<double>(row) + 0.5) / static_cast<double>(geometry.height);
    counts[PartOf(partition, x, y, PhaseOf(column, row))] += mask[p] != 0 ? 1.0 : 0.0;
  }
  const double all = std::max(1.0, std::accumulate(counts.begin(), counts.end(), 0.0));
  const double ofGains = std::inner_product(counts.begin(), counts.end(), excess.begin(), 0.0) / all;
  const double ofDark = std::inner_product(counts.begin(), counts.end(), dark.begin(), 0.0) / all;
  for (std::size_t k = 0; k < excess.size(); ++k)
  {
    excess[k] = (1.0 + excess[k]) / (1.0 + ofGains) - 1.0;
    dark[k] -= ofDark;
  }
  meanExcess = (1.0 + meanExcess) * (1.0 + ofGains) - 1.0;
  meanDark += ofDark;
}

void
PartGains::AddDarkTerms(double x, double y, std::size_t phase, const Eigen::Vector2d & weights, Eigen::MatrixXd & sums)
  const
{
  if (darkField.size() > 0)
  {
    sums += weights * PartRegression::FieldAt(x, y).transpose();
    return;
  }
  sums.col(sums.cols() == 1 ? 0 : static_cast<Eigen::Index>(PartOf(partition, x, y, phase))) += weights;
}

bool
DoGainsDiffer(double size, double z)
{
  return size > InParts.leastDifference && z > Significance.manyTests;
}

bool
PartGains::Differ() const
{
  return DoGainsDiffer(size, z);
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

std::vector<float>
MapOfRatios(const GainByParts &         parts,
            const std::vector<double> & mean,
            const FrameGeometry &       geometry,
            const PartReference &       reference,
            const ParallelFor &         parallelFor)
{
  std::vector<float>           ratios(mean.size(), 1.0F);
  const std::vector<PartGains> ofPixels = parts.OfPixels();
  const auto                   width = static_cast<double>(geometry.width);
  const auto                   height = static_cast<double>(geometry.height);
  parallelFor(geometry.height, [&](std::size_t row) {
    const double y = (static_cast<double>(row) + 0.5) / height;
    for (std::size_t column = 0; column < geometry.width; ++column)
    {
      const std::size_t p = row * geometry.width + column;
      const double      x = (static_cast<double>(column) + 0.5) / width;
      const double      shot = ShotFractionAt(reference, mean[p]);
      double            ratio = 1.0;
      for (const PartGains & own : ofPixels)
      {
        ratio *= own.RatioAt(x, y, PhaseOf(column, row), shot, mean[p]);
      }
      ratios[p] = static_cast<float>(ratio);
    }
  });
  return ratios;
}

namespace
{
/** Sums over pixels for the line's value at the pivot and for its gain. */
struct SumsOfParts
{
  Eigen::MatrixXd terms;                           ///< terms of the variance without signal, over the variance
  Eigen::Vector2d dark{ Eigen::Vector2d::Zero() }; ///< fraction of the variance without signal, over the variance
  Eigen::Vector2d weights{ Eigen::Vector2d::Zero() };
};

/** Computes CovarianceByRatios() of one partition. */
Eigen::Matrix2d
CovarianceByOne(const PartGains &     own,
                const VarianceData &  data,
                const FrameGeometry & geometry,
                const PartReference & reference,
                const ParallelFor &   parallelFor)
{
  const VarianceLine & line = reference.line;
  const auto           width = static_cast<double>(geometry.width);
  const auto           height = static_cast<double>(geometry.height);
  // By rows, so that no sum depends on the threads. Groups of rows with all phases are left out of large frames.
  SumsOfParts none;
  none.terms = Eigen::MatrixXd::Zero(2, own.darkCovariance.rows());
  std::vector<SumsOfParts> ofRows(geometry.height, none);
  const std::size_t        every = std::max<std::size_t>(1, geometry.Pixels() / InParts.pixelsOfDerivatives);
  parallelFor(geometry.height, [&](std::size_t row) {
    SumsOfParts & sums = ofRows[row];
    const double  y = (static_cast<double>(row) + 0.5) / height;
    for (std::size_t column = 0; column < geometry.width && row / LargestPeriod % every == 0; ++column)
    {
      const std::size_t p = row * geometry.width + column;
      if (data.mask[p] != 0)
      {
        const double          x = (static_cast<double>(column) + 0.5) / width;
        const double          inverse = 1.0 / line.At(data.mean[p]);
        const double          beside = data.mean[p] - line.pivotDn;
        const Eigen::Vector2d dark =
          (1.0 - ShotFractionAt(reference, data.mean[p])) * inverse * Eigen::Vector2d(1.0, beside);
        own.AddDarkTerms(x, y, PhaseOf(column, row), dark, sums.terms);
        sums.dark += dark;
        sums.weights += Eigen::Vector2d(1.0, beside * beside) * inverse * inverse;
      }
    }
  });
  SumsOfParts all = none;
  for (const SumsOfParts & sums : ofRows)
  {
    all.terms += sums.terms;
    all.dark += sums.dark;
    all.weights += sums.weights;
  }
  if (!(all.weights.minCoeff() > 0.0))
  {
    return Eigen::Matrix2d::Zero();
  }
  Eigen::Matrix2d toLine; // gain and intercept, from the value at the pivot and the gain
  toLine << 0.0, 1.0, 1.0, -line.pivotDn;
  const Eigen::MatrixXd derivatives =
    toLine * all.weights.cwiseInverse().asDiagonal() * (all.terms - all.dark * own.meanOfTerms.transpose());
  const Eigen::Matrix2d covariance = derivatives * own.darkCovariance * derivatives.transpose();
  // The squared differences minus their expectation by chance may be negative.
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> eigen(covariance);
  return eigen.eigenvectors() * eigen.eigenvalues().cwiseMax(0.0).asDiagonal() * eigen.eigenvectors().transpose();
}
} // namespace

Eigen::Matrix2d
CovarianceByRatios(const std::vector<PartGains> & parts,
                   const VarianceData &           data,
                   const FrameGeometry &          geometry,
                   const PartReference &          reference,
                   const ParallelFor &            parallelFor)
{
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();
  for (const PartGains & own : parts)
  {
    covariance += CovarianceByOne(own, data, geometry, reference, parallelFor);
  }
  return covariance;
}

PartTiles
TilesOfMeasured(const ProjectedVariance &         projected,
                const PartReference &             reference,
                const std::vector<std::uint8_t> & mask,
                const ParallelFor &               parallelFor)
{
  VarianceData data = projected.GetData(mask);
  data.variance.ratios = nullptr;
  return MakePartTiles(data, projected.GetFrame().geometry, reference, parallelFor);
}

namespace
{
/** The excess of tiles: median, scatter beyond chance, and mean over the mean fraction of shot noise [1]. */
struct ExcessOfTiles
{
  double median{ 0.0 };
  double spread{ 0.0 };
  double ofShot{ 0.0 };
};

/** Returns the excess of \a tiles. Null: there are too few of them. */
std::optional<ExcessOfTiles>
SummariseExcess(const std::vector<TileExcess> & tiles)
{
  std::vector<double> excess;
  std::vector<double> errors;
  double              sum = 0.0;
  double              shot = 0.0;
  for (const TileExcess & tile : tiles)
  {
    excess.push_back(tile.excess);
    errors.push_back(tile.error);
    sum += tile.pixels * tile.excess;
    shot += tile.pixels * tile.shotFraction;
  }
  if (excess.size() < InParts.fewestTiles || !(shot > 0.0))
  {
    return std::nullopt;
  }
  const RobustCentre centre = CentreOf(std::move(excess));
  const double       chance = QuantileOf(std::move(errors), 0.5);
  return ExcessOfTiles{ centre.median, std::sqrt(std::max(0.0, centre.sd * centre.sd - chance * chance)), sum / shot };
}

/** Returns the pixels that are left out as not static, and have no used pixel beyond a neighbourhood, at eight places
 * around them: neighbourhoods at the edge of a region reach into it and out of it. */
std::vector<std::uint8_t>
InnerPixels(const std::vector<std::uint8_t> & pixelUse, const FrameGeometry & geometry, const ParallelFor & parallelFor)
{
  const std::size_t reach = InPixels.neighbourhoodRadius + 1;
  const auto        around = [reach](std::size_t at, std::size_t size) {
    return std::array<std::size_t, 3>{ at - std::min(at, reach), at, std::min(size - 1, at + reach) };
  };
  std::vector<std::uint8_t> inner(pixelUse.size());
  ForPixels(inner.size(), parallelFor, [&](std::size_t p) {
    bool isInner = pixelUse[p] == static_cast<std::uint8_t>(PixelUse::NotStatic);
    for (const std::size_t y : around(p / geometry.width, geometry.height))
    {
      for (const std::size_t x : around(p % geometry.width, geometry.width))
      {
        isInner = isInner && pixelUse[y * geometry.width + x] != static_cast<std::uint8_t>(PixelUse::Used);
      }
    }
    inner[p] = isInner ? 1 : 0;
  });
  return inner;
}
} // namespace

double
ExcessOfLeftOut(const ProjectedVariance &         projected,
                const PartReference &             reference,
                const std::vector<std::uint8_t> & pixelUse,
                const ParallelFor &               parallelFor)
{
  const auto numberOf = [&](PixelUse use) {
    return static_cast<double>(std::count(pixelUse.begin(), pixelUse.end(), static_cast<std::uint8_t>(use)));
  };
  const double leftOut = numberOf(PixelUse::NotStatic);
  if (leftOut < InParts.leastLeftOut * (numberOf(PixelUse::Used) + leftOut))
  {
    return 0.0;
  }
  const std::vector<std::uint8_t> inner = InnerPixels(pixelUse, projected.GetFrame().geometry, parallelFor);
  const std::uint8_t * const      classOf = projected.GetSquares().GetClasses().data();
  std::vector<double>             classes;
  for (std::size_t p = 0; p < inner.size(); ++p)
  {
    if (inner[p] != 0)
    {
      classes.push_back(classOf[p]);
    }
  }
  if (classes.empty())
  {
    return 0.0;
  }
  const auto excessBetween = [&](double low, double high) {
    std::vector<std::uint8_t> part(inner.size());
    ForPixels(part.size(), parallelFor, [&](std::size_t p) {
      part[p] = classOf[p] > low && classOf[p] <= high ? inner[p] : std::uint8_t{ 0 };
    });
    return SummariseExcess(TilesOfMeasured(projected, reference, part, parallelFor).places);
  };
  const double middle = Quantile(classes, 0.5);
  const double upper = Quantile(classes, 0.75);
  const double highest = Quantile(classes, 1.0);
  const auto   rough = excessBetween(middle, highest);
  if (!(rough && rough->spread < InParts.largestSpread * rough->median))
  {
    return 0.0;
  }
  // Motion adds the more variance, the rougher the scene is. The smoother half may lie between edges that are processed
  // in another way, so the quarters of the rougher half are compared, if they have tiles enough.
  const auto roughest = excessBetween(upper, highest);
  const auto third = excessBetween(middle, upper);
  const bool areQuarters = roughest && third;
  const auto smoother = areQuarters ? third : excessBetween(-1.0, middle);
  const auto rougher = areQuarters ? roughest : rough;
  return smoother && smoother->median > (1.0 - InParts.largestSpread) * rougher->median ? rough->ofShot : 0.0;
}

} // namespace sensornoise
