// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "pixels/IlluminationResponses.h"

#include "base/ChiSquare.h"
#include "base/Eigen.h"
#include "base/Constants.h"
#include "base/Stencils.h"
#include "sensornoise/Parallel.h"
#include "pixels/Constants.h"
#include "pixels/ProjectionSums.h"
#include "pixels/SurfaceSums.h"
#include "pixels/VarianceLine.h"
#include "scene/ReferenceFrame.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

namespace sensornoise
{

namespace
{
/** Matrices of at most the terms of a surface without 1 and I. */
struct OtherTerms
{
  static constexpr int Most = CurvedTerms - 2;
  using Square = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, Most, Most>;
  using Slopes = Eigen::Matrix<double, Eigen::Dynamic, 2, Eigen::ColMajor, Most, 2>;
};

/** Returns whether \a number lines of the dispersion \a phi fit a model: they do not disperse by more than chance makes
 * them, or little. A few lines that disperse twice as much as by chance do not fit, either. Where the noise of the
 * means explains more than all, the lines have no meaning. */
bool
DoLinesFit(double phi, double number)
{
  const double chance = Significance.oneTest * std::sqrt(2.0 / number);
  return phi - 1.0 < std::max(InPattern.smallDispersion, std::min(1.0, chance)) &&
         1.0 - phi < std::max(1.0 + InPattern.smallDispersion, chance);
}

/** Returns whether parallel lines, each with a zero of its own, explain more of the responses than lines through the
 * common zero do, whose squares leave \a rest. Both models have one number for each line and one more. */
bool
AreParallel(const std::vector<TileLines> & tiles, double rest)
{
  double            restOfParallels = 0.0;
  double            number = 0.0;
  const std::size_t responses = tiles.empty() ? 0 : tiles.front().r1.size();
  for (std::size_t j = 0; j < responses; ++j)
  {
    double w = 0.0;
    double slopes = 0.0;
    double squares = 0.0;
    for (const TileLines & s : tiles)
    {
      const double information = s.Determinant() / s.g11;
      const double slope = (s.g11 * s.r2[j] - s.g12 * s.r1[j]) / s.Determinant();
      w += information;
      slopes += information * slope;
      squares += information * slope * slope;
      number += 1.0;
    }
    restOfParallels += squares - slopes * slopes / w;
  }
  const double free = number - static_cast<double>(responses);
  return free > 1.0 && DoLinesFit(restOfParallels / free, number) &&
         rest - restOfParallels > Significance.severalTests * std::sqrt(4.0 * number);
}

/** Returns the common zero of \a tiles. Null: they determine none. The information on it is diminished by its own
 * scatter: many slopes of mere noise have a common zero by chance. */
std::optional<LocalOffset>
FitTiles(const std::vector<TileLines> & tiles, const IlluminationResponses & data)
{
  const double start = data.darkestDn - data.centreDn;
  LocalOffset  result;
  result.offset = FindCommonZero(tiles, start, data.rangeDn);
  result.tiles = tiles.size();
  const ZeroErrors errors = SumErrors(tiles, result.offset);
  const double     information = errors.information - Significance.oneTest * std::sqrt(errors.scatter);
  if (!(information > 0.0))
  {
    return std::nullopt;
  }
  const double top = Explained(tiles, result.offset);
  result.phi = errors.number > 1.0 ? (errors.full - top) / (errors.number - 1.0) : 1.0;
  const double widening = std::max(1.0, result.phi);
  result.doLinesMeet = DoLinesFit(result.phi, errors.number);
  result.areParallel = AreParallel(tiles, errors.full - top);
  result.standardError = std::sqrt(widening / information);
  const double far =
    std::max(Explained(tiles, start - 20.0 * data.rangeDn), Explained(tiles, start + 20.0 * data.rangeDn));
  const double student = StudentQuantile(0.975, std::max(1.0, errors.number - 1.0));
  if (far < top - student * student * widening)
  {
    result.low = result.offset - student * result.standardError;
    result.high = result.offset + student * result.standardError;
  }
  return result;
}

/** Numbers by which the noise of the means is subtracted from the products of a tile. */
struct NoiseOfMeans
{
  double      frames;    ///< number of frames T
  double      ofTerms;   ///< variance of I times the weight, 1 / T
  double      ofProduct; ///< covariance of I with a response, relative to the response: gain / T [1/DN]
  std::size_t responses; ///< number of responses

  explicit NoiseOfMeans(const IlluminationResponses & data)
    : frames(static_cast<double>(data.frame.frames))
    , ofTerms(1.0 / frames)
    , ofProduct(data.line.gain / frames)
    , responses(data.factors)
  {}
};

/** Returns the sums of 1 and I over \a tile after the regression of both on the other terms of the first \a terms
 * (Frisch & Waugh 1933). Null if the contrast of the tile does not determine I x and I y: they differ from x and y by
 * no more than the noise of the means. */
std::optional<TileLines>
WithoutPlace(const SurfaceSums & tile, const NoiseOfMeans & noise, Eigen::Index terms)
{
  const double n = tile.NumberOfPixels();
  if (!(n > InPattern.leastTilePixels))
  {
    return std::nullopt;
  }
  const SurfaceSums::Gram gram = tile.ProductsOfTerms(noise.ofTerms);
  const Eigen::Matrix2d   ofPlace = gram.block<2, 2>(2, 2);
  const Eigen::Matrix2d   both = gram.block<2, 2>(2, 4);
  const Eigen::Matrix2d   contrast = gram.block<2, 2>(4, 4) - both.transpose() * ofPlace.ldlt().solve(both);
  // The noise of the coefficient of I x: the mean square of x is 1/12.
  const double ofChance = n / (12.0 * noise.frames);
  if (!(Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(contrast).eigenvalues()(0) >
        InPattern.leastTileContrast * ofChance))
  {
    return std::nullopt;
  }
  const OtherTerms::Slopes slopes =
    OtherTerms::Square(gram.block(2, 2, terms - 2, terms - 2)).ldlt().solve(gram.block(2, 0, terms - 2, 2));
  const Eigen::Matrix2d left = gram.topLeftCorner<2, 2>() - gram.block(0, 2, 2, terms - 2) * slopes;
  TileLines             sums{ left(0, 0), left(0, 1), left(1, 1), {}, {} };
  for (std::size_t j = 0; j < noise.responses; ++j)
  {
    const CurvedSurface   product = tile.ProductsWith(j, noise.ofProduct);
    const Eigen::Vector2d own = product.head<2>() - slopes.transpose() * product.segment(2, terms - 2);
    sums.r1.push_back(own(0));
    sums.r2.push_back(own(1));
  }
  const double determinant = sums.Determinant();
  const bool   isLine = determinant > InPattern.leastTileContrast * sums.g11 * n / noise.frames &&
                      determinant > 1e-6 * sums.g11 * std::abs(sums.g22);
  return isLine ? std::optional<TileLines>(std::move(sums)) : std::nullopt;
}

/** Returns whether the illumination is curved within \a tiles: whether y^2, x^2 and x y times the signal above \a zero
 * explain more of the responses than chance does. In strips, y^2 does not count: rows behind a rolling shutter differ,
 * but all of a strip have nearly the same levels. */
bool
IsCurvedWithin(const std::vector<SurfaceSums> & tiles, const NoiseOfMeans & noise, double zero, bool areStrips)
{
  using OfSignal = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, LinearTerms, LinearTerms>;
  using Column = Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, LinearTerms, 1>;
  const Eigen::Index known = LinearTerms / 2 + (areStrips ? 1 : 0); // 1, x, y, and y^2 in strips
  const Eigen::Index tested = LinearTerms - known;
  Eigen::Matrix<double, CurvedTerms, LinearTerms> ofSignal =
    Eigen::Matrix<double, CurvedTerms, LinearTerms>::Zero(); // I minus the zero
  constexpr std::array<int, LinearTerms> unit{ 0, 2, 3, 8, 6, 7 };
  constexpr std::array<int, LinearTerms> mean{ 1, 4, 5, 11, 9, 10 };
  for (int k = 0; k < LinearTerms; ++k)
  {
    ofSignal(mean[static_cast<std::size_t>(k)], k) = 1.0;
    ofSignal(unit[static_cast<std::size_t>(k)], k) = -zero;
  }
  double explained = 0.0;
  double number = 0.0;
  for (const SurfaceSums & tile : tiles)
  {
    if (!(tile.NumberOfPixels() > InPattern.leastTilePixels))
    {
      continue;
    }
    const Eigen::Matrix<double, LinearTerms, LinearTerms> gram =
      ofSignal.transpose() * tile.ProductsOfTerms(noise.ofTerms) * ofSignal;
    const OfSignal slopes = OfSignal(gram.topLeftCorner(known, known)).ldlt().solve(gram.topRightCorner(known, tested));
    const OfSignal left = gram.bottomRightCorner(tested, tested) - gram.bottomLeftCorner(tested, known) * slopes;
    if (!(Eigen::SelfAdjointEigenSolver<OfSignal>(left, Eigen::EigenvaluesOnly).eigenvalues()(0) > 0.0))
    {
      continue;
    }
    const Eigen::LDLT<OfSignal> solver(left);
    for (std::size_t j = 0; j < noise.responses; ++j)
    {
      const Eigen::Matrix<double, LinearTerms, 1> all = ofSignal.transpose() * tile.ProductsWith(j, noise.ofProduct);
      const Column                                own = all.tail(tested) - slopes.transpose() * all.head(known);
      explained += own.dot(solver.solve(own));
      number += static_cast<double>(tested);
    }
  }
  return explained - number > Significance.oneTest * std::sqrt(2.0 * number);
}

/** Returns the fit of lines after the first \a terms of the surface of each tile. Null: there is none. */
std::optional<LocalOffset>
FitPartition(const std::vector<SurfaceSums> & tiles, const IlluminationResponses & data, int terms)
{
  const NoiseOfMeans     noise(data);
  std::vector<TileLines> lines;
  for (const SurfaceSums & tile : tiles)
  {
    if (std::optional<TileLines> line = WithoutPlace(tile, noise, terms))
    {
      lines.push_back(std::move(*line));
    }
  }
  return lines.empty() ? std::nullopt : FitTiles(lines, data);
}

/** Division of the frame into tiles that is tried. */
struct TriedTiles
{
  std::vector<SurfaceSums> tiles;
  bool                     isOfStrips;
  /** Whether the surfaces may be curved: not in a tile of few pixels, nor in a strip, where the illumination is no
   * curve of second order. */
  bool mayBeCurved;
};

/** Returns the fits of a partition: with linear surfaces, and with curved ones if they are allowed. */
std::vector<LocalOffset>
FitSurfaces(const TriedTiles & partition, const IlluminationResponses & data)
{
  std::vector<LocalOffset> fits;
  if (std::optional<LocalOffset> fit = FitPartition(partition.tiles, data, LinearTerms))
  {
    fit->doLinesMeet =
      fit->doLinesMeet && !IsCurvedWithin(partition.tiles, NoiseOfMeans(data), fit->offset, partition.isOfStrips);
    fits.push_back(*fit);
  }
  if (std::optional<LocalOffset> fit =
        partition.mayBeCurved ? FitPartition(partition.tiles, data, CurvedTerms) : std::nullopt)
  {
    fit->doLinesMeet = fit->doLinesMeet && fit->tiles > 1; // only the lines of other tiles test it
    fits.push_back(*fit);
  }
  return fits;
}

constexpr std::size_t SmallestSide = 8;               // side of the smallest squares [pixel]
constexpr std::size_t StripHeight = SmallestSide / 2; // height of the narrowest strips [pixel]

/** Squares and strips of the frame. */
struct SquaresAndStrips
{
  std::vector<SurfaceSums> squares; ///< row by row
  std::vector<SurfaceSums> strips;  ///< whole rows of the frame
};

/** Returns the sums over the smallest squares and the narrowest strips, which are added from the halves of squares. */
SquaresAndStrips
SumSquaresAndStrips(const IlluminationResponses & data, const Eigen::MatrixXd & kappa, const ParallelFor & parallelFor)
{
  const std::size_t width = data.frame.geometry.width;
  const std::size_t height = data.frame.geometry.height;
  const std::size_t across = (width + SmallestSide - 1) / SmallestSide;
  const double      ofStrip = static_cast<double>(width) / SmallestSide; // squares in a strip
  const auto        responsesOf = [&](const PixelOfTile & pixel, double * responses) {
    const auto derivatives = ApplyStencils(data.frame.mean.data(), width, pixel.index);
    for (std::size_t j = 0; j < data.factors; ++j)
    {
      responses[j] = data.coordinates.At(pixel.index, j);
      for (std::size_t k = 0; k < StencilsOfLowOrder; ++k)
      {
        responses[j] -= kappa(static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(j)) * derivatives[k];
      }
    }
  };
  SquaresAndStrips sums;
  sums.squares.assign(across * ((height + SmallestSide - 1) / SmallestSide), SurfaceSums(data.factors));
  sums.strips.assign((height + StripHeight - 1) / StripHeight, SurfaceSums(data.factors));
  parallelFor((height + SmallestSide - 1) / SmallestSide, [&](std::size_t row) {
    for (std::size_t half = 0; half < 2 && 2 * row + half < sums.strips.size(); ++half)
    {
      const std::size_t              strip = 2 * row + half;
      const std::vector<SurfaceSums> halves =
        SumRowOfTiles(data, strip * StripHeight, StripHeight, SmallestSide, data.factors, responsesOf);
      for (std::size_t x = 0; x < across; ++x)
      {
        sums.squares[row * across + x].AddPart(halves[x], Move(0, 1.0), Move(half, 2.0));
        sums.strips[strip].AddPart(halves[x], Move(x, ofStrip), Move(0, 1.0));
      }
    }
  });
  return sums;
}

/** Returns the partitions that are tried: squares of 8 to 64 pixels, and strips of 4 and 16 rows. */
std::vector<TriedTiles>
MakePartitions(const IlluminationResponses & data, const Eigen::MatrixXd & kappa, const ParallelFor & parallelFor)
{
  SquaresAndStrips         sums = SumSquaresAndStrips(data, kappa, parallelFor);
  std::vector<TriedTiles>  partitions;
  std::size_t              across = (data.frame.geometry.width + SmallestSide - 1) / SmallestSide;
  std::vector<SurfaceSums> squares = std::move(sums.squares);
  for (std::size_t side = SmallestSide; side <= 64; side *= 2)
  {
    std::vector<SurfaceSums> larger = JoinTiles(squares, across, 2, 2);
    partitions.push_back({ std::move(squares), false, side > SmallestSide });
    squares = std::move(larger);
    across = (across + 1) / 2;
  }
  std::vector<SurfaceSums> wide = JoinTiles(sums.strips, 1, 1, 4);
  partitions.push_back({ std::move(sums.strips), true, false });
  partitions.push_back({ std::move(wide), true, false });
  return partitions;
}

/** Returns the fit of the smallest standard error of those whose lines meet, and whose offset agrees with the weighted
 * mean of such fits of larger errors, within three errors of this mean. Where the lines of no partition meet, returns
 * the fit whose lines disperse least. Null: there is no fit. */
std::optional<LocalOffset>
ChoosePartition(std::vector<LocalOffset> fits)
{
  std::sort(fits.begin(), fits.end(), [](const LocalOffset & a, const LocalOffset & b) {
    return a.standardError < b.standardError;
  });
  for (auto fit = fits.begin(); fit != fits.end(); ++fit)
  {
    double weights = 0.0;
    double difference = 0.0; // to the weighted mean, times the weights
    for (auto other = fit + 1; other != fits.end(); ++other)
    {
      const double weight = other->doLinesMeet ? 1.0 / (other->standardError * other->standardError) : 0.0;
      weights += weight;
      difference += weight * (fit->offset - other->offset);
    }
    if (fit->doLinesMeet && std::abs(difference) <= Significance.oneTest * std::sqrt(weights))
    {
      return *fit;
    }
  }
  const auto least =
    std::min_element(fits.begin(), fits.end(), [](const auto & a, const auto & b) { return a.phi < b.phi; });
  return least == fits.end() ? std::nullopt : std::optional<LocalOffset>(*least);
}
} // namespace

std::optional<LocalOffset>
FindLocalOffset(const IlluminationResponses & data, const Eigen::MatrixXd & kappa, const ParallelFor & parallelFor)
{
  const std::vector<TriedTiles>         partitions = MakePartitions(data, kappa, parallelFor);
  std::vector<std::vector<LocalOffset>> fits(partitions.size());
  parallelFor(partitions.size(), [&](std::size_t trial) { fits[trial] = FitSurfaces(partitions[trial], data); });
  std::vector<LocalOffset> found;
  for (const std::vector<LocalOffset> & ofPartition : fits)
  {
    found.insert(found.end(), ofPartition.begin(), ofPartition.end());
  }
  const bool areParallel = std::any_of(found.begin(), found.end(), [](const auto & fit) { return fit.areParallel; });
  std::optional<LocalOffset> chosen = ChoosePartition(std::move(found));
  if (chosen && areParallel)
  {
    chosen->areParallel = true;
    chosen->doLinesMeet = false;
  }
  return chosen;
}

} // namespace sensornoise
