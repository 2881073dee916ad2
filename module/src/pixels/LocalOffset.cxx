// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "pixels/IlluminationResponses.h"

#include "base/ChiSquare.h"
#include "base/Eigen.h"
#include "base/Constants.h"
#include "sensornoise/Parallel.h"
#include "pixels/Constants.h"
#include "pixels/ProjectionSums.h"
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

/** Sums over a tile of the products of the terms of its surface, and of these terms with each response. */
struct TileMoments
{
  double                                          n{ 0.0 };
  Eigen::Matrix<double, CurvedTerms, CurvedTerms> gram{ Eigen::Matrix<double, CurvedTerms, CurvedTerms>::Zero() };
  std::vector<CurvedSurface>                      products;

  /** Returns the sums of 1 and I after the regression of both on the other terms of the first \a terms (Frisch & Waugh
   * 1933). Null if the contrast of the tile does not determine I x and I y: they differ from x and y by no more than
   * the noise of the means of \a frames frames. */
  std::optional<TileLines>
  WithoutPlace(double frames, int terms) const
  {
    const Eigen::Matrix2d ofPlace = gram.block<2, 2>(2, 2);
    const Eigen::Matrix2d both = gram.block<2, 2>(2, 4);
    const Eigen::Matrix2d contrast = gram.block<2, 2>(4, 4) - both.transpose() * ofPlace.ldlt().solve(both);
    const double          noise = n / (12.0 * frames); // noise of the coefficient of I x: the mean square of x is 1/12
    if (!(n > InPattern.leastTilePixels && Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(contrast).eigenvalues()(0) >
                                             InPattern.leastTileContrast * noise))
    {
      return std::nullopt;
    }
    const Eigen::MatrixXd slopes = gram.block(2, 2, terms - 2, terms - 2).ldlt().solve(gram.block(2, 0, terms - 2, 2));
    const Eigen::Matrix2d left = gram.topLeftCorner<2, 2>() - gram.block(0, 2, 2, terms - 2) * slopes;
    TileLines             sums{ left(0, 0), left(0, 1), left(1, 1), {}, {} };
    for (const CurvedSurface & product : products)
    {
      const Eigen::Vector2d own = product.head<2>() - slopes.transpose() * product.segment(2, terms - 2);
      sums.r1.push_back(own(0));
      sums.r2.push_back(own(1));
    }
    const double determinant = sums.Determinant();
    const bool   isLine = determinant > InPattern.leastTileContrast * sums.g11 * n / frames &&
                        determinant > 1e-6 * sums.g11 * std::abs(sums.g22);
    return isLine ? std::optional<TileLines>(std::move(sums)) : std::nullopt;
  }
};

/** Returns the sums of the tiles of a partition. */
std::vector<TileMoments>
SumTiles(const IlluminationResponses &            data,
         const std::vector<std::vector<double>> & responses,
         std::size_t                              tileHeight,
         std::size_t                              tileWidth)
{
  const ReferenceFrame &   frame = data.frame;
  const std::size_t        width = frame.geometry.width;
  const std::size_t        factors = responses.size();
  const auto               frames = static_cast<double>(frame.frames);
  const Tiles              tiles{ tileHeight, tileWidth, (width + tileWidth - 1) / tileWidth };
  std::vector<TileMoments> moments(tiles.across * ((frame.geometry.height + tileHeight - 1) / tileHeight));
  for (TileMoments & own : moments)
  {
    own.products.assign(factors, CurvedSurface::Zero());
  }
  for (std::size_t p = 0; p < data.mask.size(); ++p)
  {
    if (data.mask[p] != 0)
    {
      const double        w = 1.0 / data.line.At(frame.neighbourMean[p]);
      const double        centred = frame.mean[p] - data.centreDn;
      const Surface       linear = tiles.SurfaceAt(p, width, centred);
      const Surface       ofLinear = (Surface() << 0.0, 1.0, 0.0, 0.0, linear.segment<2>(2)).finished();
      const CurvedSurface terms = WithCurvature(linear, linear(2), linear(3));
      const CurvedSurface ofMean = WithCurvature(ofLinear, linear(2), linear(3)); // derivative by I
      TileMoments &       own = moments[tiles.Of(p, width)];
      own.n += 1.0;
      own.gram += w * terms * terms.transpose() - ofMean * ofMean.transpose() / frames; // the noise of the mean
      for (std::size_t j = 0; j < factors; ++j)
      {
        own.products[j] += w * responses[j][p] * (terms - data.line.gain / frames * ofMean);
      }
    }
  }
  return moments;
}

/** Returns whether the illumination is curved within \a tiles: whether y^2, x^2 and x y times the signal above \a zero
 * explain more of the responses than chance does. In strips, y^2 does not count: rows behind a rolling shutter differ,
 * but all of a strip have nearly the same levels. */
bool
IsCurvedWithin(const std::vector<TileMoments> & tiles, double zero, bool areStrips)
{
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
  for (const TileMoments & tile : tiles)
  {
    if (!(tile.n > InPattern.leastTilePixels))
    {
      continue;
    }
    const Eigen::MatrixXd gram = ofSignal.transpose() * tile.gram * ofSignal;
    const Eigen::MatrixXd slopes = gram.topLeftCorner(known, known).ldlt().solve(gram.topRightCorner(known, tested));
    const Eigen::MatrixXd left = gram.bottomRightCorner(tested, tested) - gram.bottomLeftCorner(tested, known) * slopes;
    if (!(Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(left).eigenvalues()(0) > 0.0))
    {
      continue;
    }
    for (const CurvedSurface & product : tile.products)
    {
      const Eigen::VectorXd all = ofSignal.transpose() * product;
      const Eigen::VectorXd own = all.tail(tested) - slopes.transpose() * all.head(known);
      explained += own.dot(left.ldlt().solve(own));
      number += static_cast<double>(tested);
    }
  }
  return explained - number > Significance.oneTest * std::sqrt(2.0 * number);
}

/** Returns the fit of lines after the first \a terms of the surface of each tile. Null: there is none. */
std::optional<LocalOffset>
FitPartition(const std::vector<TileMoments> & moments, const IlluminationResponses & data, int terms)
{
  std::vector<TileLines> lines;
  for (const TileMoments & own : moments)
  {
    if (const std::optional<TileLines> line = own.WithoutPlace(static_cast<double>(data.frame.frames), terms))
    {
      lines.push_back(*line);
    }
  }
  return lines.empty() ? std::nullopt : FitTiles(lines, data);
}

/** Division of the frame into tiles that is tried. */
struct TriedTiles
{
  std::size_t height; ///< height of a tile [pixel]
  std::size_t width;  ///< width of a tile [pixel]
  bool        isOfStrips;
  /** Whether the surfaces may be curved: not in a tile of few pixels, nor in a strip, where the illumination is no
   * curve of second order. */
  bool mayBeCurved;
};

/** Returns the fits of a partition: with linear surfaces, and with curved ones if they are allowed. */
std::vector<LocalOffset>
FitSurfaces(const TriedTiles &                       partition,
            const IlluminationResponses &            data,
            const std::vector<std::vector<double>> & responses)
{
  const std::vector<TileMoments> tiles = SumTiles(data, responses, partition.height, partition.width);
  std::vector<LocalOffset>       fits;
  if (std::optional<LocalOffset> fit = FitPartition(tiles, data, LinearTerms))
  {
    fit->doLinesMeet = fit->doLinesMeet && !IsCurvedWithin(tiles, fit->offset, partition.isOfStrips);
    fits.push_back(*fit);
  }
  if (std::optional<LocalOffset> fit = partition.mayBeCurved ? FitPartition(tiles, data, CurvedTerms) : std::nullopt)
  {
    fit->doLinesMeet = fit->doLinesMeet && fit->tiles > 1; // only the lines of other tiles test it
    fits.push_back(*fit);
  }
  return fits;
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
FindLocalOffset(const IlluminationResponses &            data,
                const std::vector<std::vector<double>> & responses,
                const ParallelFor &                      parallelFor)
{
  const std::size_t                            width = data.frame.geometry.width;
  constexpr std::size_t                        trials = 6;
  const std::array<TriedTiles, trials>         partitions{ { { 64, 64, false, true },
                                                             { 32, 32, false, true },
                                                             { 16, 16, false, true },
                                                             { 8, 8, false, false },
                                                             { 4, width, true, false },
                                                             { 16, width, true, false } } };
  std::array<std::vector<LocalOffset>, trials> fits;
  parallelFor(trials, [&](std::size_t trial) { fits[trial] = FitSurfaces(partitions[trial], data, responses); });
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

double
LocalFlicker::Sd(double offset) const
{
  const double flux = wII - 2.0 * offset * wI + offset * offset * w;
  return std::sqrt(std::max(0.0, energy / (flux * (frames - 1.0))));
}

LocalFlicker
SumLocalFlicker(const IlluminationResponses & data)
{
  const ReferenceFrame & frame = data.frame;
  const std::size_t      factors = data.factors;
  LocalFlicker           sums;
  sums.frames = static_cast<double>(frame.frames);
  for (std::size_t p = 0; p < data.mask.size(); ++p)
  {
    if (data.mask[p] != 0)
    {
      const double noise = data.line.At(frame.neighbourMean[p]);
      const double centred = frame.mean[p] - data.centreDn;
      for (std::size_t j = 0; j < factors; ++j)
      {
        sums.energy += std::pow(data.coordinates.At(p, j), 2) / noise - 1.0;
      }
      sums.w += 1.0 / noise;
      sums.wI += centred / noise;
      sums.wII += centred * centred / noise;
    }
  }
  return sums;
}

} // namespace sensornoise
