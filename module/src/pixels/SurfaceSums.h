// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_pixels_SurfaceSums_h
#define sensornoise_pixels_SurfaceSums_h

#include "base/Eigen.h"
#include "pixels/IlluminationResponses.h"

#include <array>
#include <cstddef>
#include <functional>
#include <utility>
#include <vector>

/** \file
 * Sums over tiles for surfaces in the place and the level of a pixel, and their union to sums over larger tiles. */

namespace sensornoise
{

/** Highest order of the place in the terms of a surface, and in the products of two terms. */
inline constexpr std::size_t OrderOfTerms = 2;
inline constexpr std::size_t OrderOfProducts = 2 * OrderOfTerms;

/** Powers 0, 1, ... of one coordinate of a place. */
using Powers = std::array<double, OrderOfProducts + 1>;

/** Returns the powers of \a place. */
Powers
PowersOf(double place);

/** Returns the place of the middle of element \a i of \a size, which reach from -1/2 to 1/2 [1]. */
inline double
PlaceOf(std::size_t i, std::size_t size)
{
  return (static_cast<double>(i) + 0.5) / static_cast<double>(size) - 0.5;
}

/** The powers of a coordinate in a larger tile, as sums of its powers in a part of this tile: row i has the
 * coefficients of (scale x + shift)^i. */
class Move
{
public:
  /** The part is number \a i of \a parts equal parts. */
  Move(std::size_t i, double parts);

  double
  At(std::size_t i, std::size_t k) const
  {
    return m_Coefficients[i][k];
  }

private:
  std::array<Powers, OrderOfProducts + 1> m_Coefficients;
};

/** Sums over a tile of a quantity times x^i y^j, i + j <= Order, where (x, y) is the place in the tile. */
template <std::size_t Order>
class PlaceSums
{
public:
  double
  At(std::size_t i, std::size_t j) const
  {
    return m_Sums[Index(i, j)];
  }
  /** Adds the pixels of a row of the tile: sums over them times the powers of x, at one y. */
  void
  AddRow(const double * sums, const Powers & y)
  {
    for (std::size_t j = 0; j <= Order; ++j)
    {
      for (std::size_t i = 0; i + j <= Order; ++i)
      {
        m_Sums[Index(i, j)] += y[j] * sums[i];
      }
    }
  }
  /** Adds the sums over a part of the tile. */
  void
  AddPart(const PlaceSums & part, const Move & x, const Move & y)
  {
    for (std::size_t l = 0; l <= Order; ++l) // power of y in the part
    {
      std::array<double, Order + 1> row{};
      for (std::size_t i = 0; i + l <= Order; ++i)
      {
        for (std::size_t k = 0; k <= i; ++k)
        {
          row[i] += x.At(i, k) * part.At(k, l);
        }
      }
      for (std::size_t j = l; j <= Order; ++j)
      {
        for (std::size_t i = 0; i + j <= Order; ++i)
        {
          m_Sums[Index(i, j)] += y.At(j, l) * row[i];
        }
      }
    }
  }

private:
  static constexpr std::size_t
  Index(std::size_t i, std::size_t j)
  {
    return (i + j) * (i + j + 1) / 2 + j;
  }
  std::array<double, (Order + 1) * (Order + 2) / 2> m_Sums{};
};

/** Sums over the pixels of a tile that determine the surfaces by which variables of the pixels are described. I is the
 * mean minus the centre, and w the inverse of the noise. */
class SurfaceSums
{
public:
  using Gram = Eigen::Matrix<double, CurvedTerms, CurvedTerms>;

  explicit SurfaceSums(std::size_t variables = 0)
    : m_OfVariables(variables)
  {}

  std::size_t
  NumberOfVariables() const
  {
    return m_OfVariables.size();
  }
  double
  NumberOfPixels() const
  {
    return m_Pixels.At(0, 0);
  }
  /** Returns the products w times two terms of CurvedSurface, without the part of the noise of I, whose variance is
   * \a noise / w. */
  Gram
  ProductsOfTerms(double noise) const;
  /** Returns the products of w, the terms of CurvedSurface and \a variable, whose noise has the covariance \a noise
   * with I. */
  CurvedSurface
  ProductsWith(std::size_t variable, double noise) const;
  /** Adds the sums over a part of the tile, whose place in it \a x and \a y give. */
  void
  AddPart(const SurfaceSums & part, const Move & x, const Move & y);

private:
  friend class SurfaceSumsOfRow;
  PlaceSums<OrderOfProducts>                          m_Pixels;      // 1
  std::array<PlaceSums<OrderOfProducts>, 3>           m_OfLevels;    // w, w I, w I^2
  std::vector<std::array<PlaceSums<OrderOfTerms>, 2>> m_OfVariables; // w z, w I z, for each variable z
};

/** A pixel of a row of tiles. */
struct PixelOfTile
{
  std::size_t index;  ///< index of the pixel in the frame
  std::size_t tile;   ///< its tile in the row of tiles
  double      weight; ///< inverse of its noise [1/DN^2]
};

/** Sets the variables of a pixel. */
using VariablesOfPixel = std::function<void(const PixelOfTile & pixel, double * variables)>;

/** Returns the sums over tiles of \a tileWidth columns, whose rows are \a firstRow to firstRow + \a tileHeight - 1, of
 * the pixels of the mask. A tile at the border of the frame has fewer pixels. */
std::vector<SurfaceSums>
SumRowOfTiles(const IlluminationResponses & data,
              std::size_t                   firstRow,
              std::size_t                   tileHeight,
              std::size_t                   tileWidth,
              std::size_t                   variables,
              const VariablesOfPixel &      variablesOfPixel);

/** Returns the sums over tiles of \a columns x \a rows of \a parts. \a across of them are in a row. */
std::vector<SurfaceSums>
JoinTiles(const std::vector<SurfaceSums> & parts, std::size_t across, std::size_t columns, std::size_t rows);

} // namespace sensornoise

#endif
