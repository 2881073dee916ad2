// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "pixels/IlluminationResponses.h"

#include "base/ChiSquare.h"
#include "base/Eigen.h"
#include "base/Constants.h"
#include "sensornoise/Parallel.h"
#include "pixels/Constants.h"
#include "pixels/VarianceLine.h"
#include "scene/ReferenceFrame.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <optional>
#include <vector>

namespace sensornoise
{

namespace
{
/** Sums over a tile: the Gram matrix of 1 and I, the mean minus the centre, corrected for the noise of the means, and
 * for each response z the sums r1 = sum w z and r2 = sum w I z. */
struct TileSums
{
  double              n{ 0.0 };
  double              g11{ 0.0 };
  double              g12{ 0.0 };
  double              g22{ 0.0 };
  std::vector<double> r1;
  std::vector<double> r2;
  // The same sums with the place in the tile, which PartialOutPlaces() removes from the others.
  Eigen::Matrix2d              places{ Eigen::Matrix2d::Zero() };       ///< sum w (x, y)(x, y)'
  Eigen::Matrix2d              placesLevels{ Eigen::Matrix2d::Zero() }; ///< sum w (x, y)(1, I)'
  std::vector<Eigen::Vector2d> placesResponses;                         ///< sum w (x, y) z

  /** Removes what increases linearly over the tile from the other sums: a gradient of the illumination and a gradient
   * of the scene look alike. */
  void
  PartialOutPlaces()
  {
    const Eigen::Matrix2d slopes = places.ldlt().solve(placesLevels);
    if (!slopes.allFinite())
    {
      return;
    }
    g11 -= placesLevels.col(0).dot(slopes.col(0));
    g12 -= placesLevels.col(0).dot(slopes.col(1));
    g22 -= placesLevels.col(1).dot(slopes.col(1));
    for (std::size_t j = 0; j < r1.size(); ++j)
    {
      r1[j] -= slopes.col(0).dot(placesResponses[j]);
      r2[j] -= slopes.col(1).dot(placesResponses[j]);
    }
  }
  double
  Determinant() const
  {
    return g11 * g22 - g12 * g12;
  }
  /** Returns the inverse variance of the slope of a line that crosses zero at \a m. */
  double
  Precision(double m) const
  {
    return g22 - 2.0 * m * g12 + m * m * g11;
  }
};

/** Returns the sum of squares of the responses that lines through zero at \a m explain. */
double
Explained(const std::vector<TileSums> & tiles, double m)
{
  double sum = 0.0;
  for (const TileSums & s : tiles)
  {
    for (std::size_t j = 0; j < s.r1.size(); ++j)
    {
      sum += std::pow(s.r2[j] - m * s.r1[j], 2) / s.Precision(m);
    }
  }
  return sum;
}

/** Returns the zero that explains most, within \a range of \a start. */
double
FindCommonZero(const std::vector<TileSums> & tiles, double start, double range)
{
  double        best = start;
  double        highest = -1.0;
  constexpr int steps = 60;
  const double  step = 2.0 * range / steps;
  for (int i = 0; i <= steps; ++i)
  {
    const double m = start - 1.5 * range + i * step;
    const double value = Explained(tiles, m);
    if (value > highest)
    {
      highest = value;
      best = m;
    }
  }
  // Golden-section search between the neighbours of the best point of the grid.
  constexpr double ratio = 0.6180339887498949;
  double           low = best - step;
  double           high = best + step;
  for (int i = 0; i < 60; ++i)
  {
    const double a = high - ratio * (high - low);
    const double b = low + ratio * (high - low);
    const bool   isLeft = Explained(tiles, a) > Explained(tiles, b);
    (isLeft ? high : low) = isLeft ? b : a;
  }
  return 0.5 * (low + high);
}

/** Sums for the error of a common zero. */
struct ZeroErrors
{
  double full{ 0.0 };        // sum of squares that free lines explain
  double information{ 0.0 }; // information on the zero [1/DN^2]
  double number{ 0.0 };      // number of lines
};

ZeroErrors
SumErrors(const std::vector<TileSums> & tiles, double zero)
{
  ZeroErrors sums;
  for (const TileSums & s : tiles)
  {
    const double precision = s.Precision(zero);
    const double across = s.g12 - zero * s.g11;
    for (std::size_t j = 0; j < s.r1.size(); ++j)
    {
      const double r = s.r2[j] - zero * s.r1[j];
      sums.full +=
        (s.g22 * s.r1[j] * s.r1[j] - 2.0 * s.g12 * s.r1[j] * s.r2[j] + s.g11 * s.r2[j] * s.r2[j]) / s.Determinant();
      sums.information += (r * r / (precision * precision) - 1.0 / precision) * (s.g11 - across * across / precision);
      sums.number += 1.0;
    }
  }
  return sums;
}

std::optional<LocalOffset>
FitTiles(const std::vector<TileSums> & tiles, const IlluminationResponses & data)
{
  const double start = data.darkestDn - data.centreDn;
  LocalOffset  result;
  result.offset = FindCommonZero(tiles, start, data.rangeDn);
  result.tiles = tiles.size();
  const ZeroErrors errors = SumErrors(tiles, result.offset);
  const double     top = Explained(tiles, result.offset);
  result.phi = errors.number > 1.0 ? (errors.full - top) / (errors.number - 1.0) : 1.0;
  const double widening = std::max(1.0, result.phi);
  if (!(errors.information > 0.0))
  {
    return std::nullopt;
  }
  result.standardError = std::sqrt(widening / errors.information);
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

/** Returns the place of pixel \a p in its tile, from -1/2 to 1/2 along x and y [1]. */
Eigen::Vector2d
PlaceIn(const Tiles & tiles, std::size_t p, std::size_t frameWidth)
{
  const auto part = [](std::size_t at, std::size_t size) {
    return (static_cast<double>(at % size) + 0.5) / static_cast<double>(size) - 0.5;
  };
  return { part(p % frameWidth, tiles.width), part(p / frameWidth, tiles.height) };
}

/** Returns the sums of the tiles that determine a line: those with enough pixels whose levels differ by more than their
 * noise. */
std::vector<TileSums>
SumTiles(const IlluminationResponses &            data,
         const std::vector<std::vector<double>> & responses,
         std::size_t                              tileHeight,
         std::size_t                              tileWidth)
{
  const ReferenceFrame & frame = data.frame;
  const std::size_t      width = frame.geometry.width;
  const std::size_t      factors = responses.size();
  const auto             frames = static_cast<double>(frame.frames);
  const Tiles            tiles{ tileHeight, tileWidth, (width + tileWidth - 1) / tileWidth };
  std::vector<TileSums>  sums(tiles.across * ((frame.geometry.height + tileHeight - 1) / tileHeight));
  for (TileSums & s : sums)
  {
    s.r1.assign(factors, 0.0);
    s.r2.assign(factors, 0.0);
    s.placesResponses.assign(factors, Eigen::Vector2d::Zero());
  }
  for (std::size_t p = 0; p < data.mask.size(); ++p)
  {
    if (data.mask[p] != 0)
    {
      const double noise = data.line.At(frame.neighbourMean[p]);
      const double w = 1.0 / noise;
      const double centred = frame.mean[p] - data.centreDn;
      TileSums &   s = sums[tiles.Of(p, width)];
      s.n += 1.0;
      s.g11 += w;
      s.g12 += w * centred;
      s.g22 += w * (centred * centred - noise / frames);
      const Eigen::Vector2d place = PlaceIn(tiles, p, width);
      s.places += w * place * place.transpose();
      s.placesLevels += w * place * Eigen::RowVector2d(1.0, centred);
      for (std::size_t j = 0; j < factors; ++j)
      {
        s.r1[j] += w * responses[j][p];
        s.r2[j] += w * (centred - data.line.gain / frames) * responses[j][p];
        s.placesResponses[j] += w * responses[j][p] * place;
      }
    }
  }
  std::vector<TileSums> good;
  for (TileSums & s : sums)
  {
    s.PartialOutPlaces();
    const double determinant = s.Determinant();
    if (s.n > InPattern.leastTilePixels && determinant > InPattern.leastTileContrast * s.g11 * s.n / frames &&
        determinant > 1e-6 * s.g11 * std::abs(s.g22))
    {
      good.push_back(s);
    }
  }
  return good;
}

/** Returns the fit of the smallest standard error of those whose lines cross zero at one level, and whose offset agrees
 * with all of these fits of larger errors, within two errors. Where no partition has such lines, returns the fit of the
 * smallest error. \a factors is the number of lines of a tile. */
template <typename TFits>
std::optional<LocalOffset>
ChoosePartition(const TFits & fits, std::size_t factors)
{
  std::vector<LocalOffset> all;
  for (const std::optional<LocalOffset> & fit : fits)
  {
    if (fit)
    {
      all.push_back(*fit);
    }
  }
  std::sort(all.begin(), all.end(), [](const LocalOffset & a, const LocalOffset & b) {
    return a.standardError < b.standardError;
  });
  std::vector<LocalOffset> meeting;
  std::copy_if(all.begin(), all.end(), std::back_inserter(meeting), [factors](const LocalOffset & fit) {
    return fit.phi - 1.0 < Significance.oneTest * std::sqrt(2.0 / static_cast<double>(fit.tiles * factors));
  });
  const auto agrees = [&meeting](const LocalOffset & fit) {
    return std::all_of(meeting.begin(), meeting.end(), [&fit](const LocalOffset & other) {
      return other.standardError <= fit.standardError ||
             std::abs(fit.offset - other.offset) <= Significance.hint * other.standardError;
    });
  };
  const auto chosen = std::find_if(meeting.begin(), meeting.end(), agrees);
  return chosen != meeting.end() ? std::optional<LocalOffset>(*chosen)
         : all.empty()           ? std::nullopt
                                 : std::optional<LocalOffset>(all.front());
}
} // namespace

std::optional<LocalOffset>
FindLocalOffset(const IlluminationResponses & data, const ParallelFor & parallelFor)
{
  const std::size_t                                    width = data.frame.geometry.width;
  const auto                                           responses = RemoveMotionLeakage(data, parallelFor);
  constexpr std::size_t                                trials = 6;
  const std::array<std::array<std::size_t, 2>, trials> sizes{
    { { 64, 64 }, { 32, 32 }, { 16, 16 }, { 8, 8 }, { 4, width }, { 16, width } }
  };
  std::array<std::optional<LocalOffset>, trials> fits;
  parallelFor(trials, [&](std::size_t trial) {
    const auto [tileHeight, tileWidth] = sizes[trial];
    const std::vector<TileSums> tiles = SumTiles(data, responses, tileHeight, tileWidth);
    if (!tiles.empty())
    {
      fits[trial] = FitTiles(tiles, data);
    }
  });
  return ChoosePartition(fits, responses.size());
}

} // namespace sensornoise
