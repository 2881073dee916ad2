// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "pixels/IlluminationResponses.h"

#include "base/Constants.h"
#include "base/Eigen.h"
#include "base/Stencils.h"
#include "pixels/Constants.h"
#include "pixels/ProjectionSums.h"
#include "pixels/SurfaceSums.h"
#include "scene/ReferenceFrame.h"
#include "sensornoise/Parallel.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace sensornoise
{

namespace
{
constexpr std::size_t Side = 8; // side of a tile [pixel]
constexpr auto        Derivatives = static_cast<Eigen::Index>(StencilsOfLowOrder);

/** Products of the derivatives and the responses of a tile, with the weights of the pixels. */
struct TileProducts
{
  SurfaceSums     surface;  ///< products with the terms of surfaces
  Eigen::MatrixXd products; ///< products of the derivatives and the responses with each other
};

/** The products that are left after surfaces are subtracted: lines in I whose coefficients vary over the tile, as the
 * illumination may. They are 0 in a tile of few pixels. */
struct ProductsLeft
{
  double          pixels{ 0.0 };
  Eigen::MatrixXd products;
};

/** Returns the products of the tiles of row \a row of tiles. */
std::vector<TileProducts>
SumTileProducts(const IlluminationResponses & data, std::size_t row)
{
  const std::size_t            width = data.frame.geometry.width;
  const std::size_t            variables = StencilsOfLowOrder + data.factors;
  const auto                   size = static_cast<Eigen::Index>(variables);
  std::vector<Eigen::MatrixXd> products((width + Side - 1) / Side, Eigen::MatrixXd::Zero(size, size));
  std::vector<SurfaceSums>     surfaces =
    SumRowOfTiles(data, row * Side, Side, Side, variables, [&](const PixelOfTile & pixel, double * z) {
      std::copy_n(ApplyStencils(data.frame.mean.data(), width, pixel.index).begin(), StencilsOfLowOrder, z);
      for (std::size_t j = 0; j < data.factors; ++j)
      {
        z[StencilsOfLowOrder + j] = data.coordinates.At(pixel.index, j);
      }
      double * const own = products[pixel.tile].data();
      for (std::size_t j = 0; j < variables; ++j)
      {
        for (std::size_t k = 0; k <= j; ++k)
        {
          own[j * variables + k] += pixel.weight * z[j] * z[k]; // the upper half, column by column
        }
      }
    });
  std::vector<TileProducts> tiles(surfaces.size());
  for (std::size_t t = 0; t < tiles.size(); ++t)
  {
    tiles[t] = { std::move(surfaces[t]), products[t].selfadjointView<Eigen::Upper>() };
  }
  return tiles;
}

/** Returns what surfaces of \a Terms terms leave of the products of \a tile. */
template <int Terms>
ProductsLeft
WithoutSurface(const TileProducts & tile)
{
  const Eigen::Index variables = tile.products.cols();
  if (!(tile.surface.NumberOfPixels() > InPattern.leastLeakagePixels))
  {
    return { 0.0, Eigen::MatrixXd::Zero(variables, variables) };
  }
  using OfTerms = Eigen::Matrix<double, Terms, Terms>;
  const OfTerms                                gram = tile.surface.ProductsOfTerms(0.0).topLeftCorner<Terms, Terms>();
  Eigen::Matrix<double, Terms, Eigen::Dynamic> products(Terms, variables);
  for (Eigen::Index j = 0; j < variables; ++j)
  {
    products.col(j) = tile.surface.ProductsWith(static_cast<std::size_t>(j), 0.0).head<Terms>();
  }
  const Eigen::Matrix<double, Terms, 1>           unit = (gram.diagonal().array() + 1e-300).rsqrt();
  Eigen::CompleteOrthogonalDecomposition<OfTerms> solver;
  solver.setThreshold(1e-9);
  solver.compute(unit.asDiagonal() * gram * unit.asDiagonal());
  const Eigen::Matrix<double, Terms, Eigen::Dynamic> coefficients =
    unit.asDiagonal() * solver.solve(unit.asDiagonal() * products);
  const Eigen::MatrixXd explained = coefficients.transpose() * products;
  return { tile.surface.NumberOfPixels(),
           tile.products - explained - explained.transpose() + coefficients.transpose() * gram * coefficients };
}

/** Products left of a row of tiles, for the leakage and for the test of local motion. */
struct RowOfTiles
{
  Eigen::MatrixXd           products; ///< sum over the tiles, each without its linear surface
  std::vector<ProductsLeft> tiles;    ///< the tiles, each without its curved surface
};

RowOfTiles
SumRow(const IlluminationResponses & data, std::size_t row)
{
  const auto size = static_cast<Eigen::Index>(StencilsOfLowOrder + data.factors);
  RowOfTiles result{ Eigen::MatrixXd::Zero(size, size), {} };
  for (const TileProducts & tile : SumTileProducts(data, row))
  {
    result.products += WithoutSurface<LinearTerms>(tile).products;
    result.tiles.push_back(WithoutSurface<CurvedTerms>(tile));
  }
  return result;
}

/** Returns kappa from the products over the frame. */
Eigen::MatrixXd
SolveLeakage(const Eigen::MatrixXd & products)
{
  const Eigen::MatrixXd gram = products.topLeftCorner<Derivatives, Derivatives>();
  const Eigen::MatrixXd right = products.topRightCorner(Derivatives, products.cols() - Derivatives);
  const Eigen::VectorXd unit = (gram.diagonal().array() + 1e-300).rsqrt();
  Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> solver;
  solver.setThreshold(1e-6);
  solver.compute(unit.asDiagonal() * gram * unit.asDiagonal());
  return unit.asDiagonal() * solver.solve(unit.asDiagonal() * right);
}

/** Sum of squares that the derivatives along the main axes explain in single tiles, the number of these terms, and the
 * squares that are left with their degrees of freedom. */
struct MotionSquares
{
  double explained{ 0.0 };
  double number{ 0.0 };
  double left{ 0.0 };
  double dof{ 0.0 };

  MotionSquares &
  operator+=(const MotionSquares & other)
  {
    explained += other.explained;
    number += other.number;
    left += other.left;
    dof += other.dof;
    return *this;
  }
};

/** Returns the squares over \a tiles, after the leakage \a kappa of the whole frame was subtracted. */
MotionSquares
SumMotion(const std::vector<ProductsLeft> & tiles, std::size_t frames, const Eigen::MatrixXd & kappa)
{
  // The noise of the mean in the products of a derivative along x or y, whose stencil has the squares 1/4 and 1/4.
  const double       noise = 0.5 * Side * Side / static_cast<double>(frames);
  const Eigen::Index factors = kappa.cols();
  MotionSquares      sums;
  for (const ProductsLeft & tile : tiles)
  {
    const Eigen::MatrixXd                                gram = tile.products.topLeftCorner<Derivatives, Derivatives>();
    const Eigen::MatrixXd                                both = tile.products.topRightCorner(Derivatives, factors);
    const Eigen::MatrixXd                                right = both - gram * kappa; // without the leakage
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes(gram.topLeftCorner<2, 2>());
    const Eigen::MatrixXd                                own = axes.eigenvectors().transpose() * right.topRows<2>();
    MotionSquares                                        found;
    for (Eigen::Index k = 0; k < 2; ++k)
    {
      if (axes.eigenvalues()(k) > InPattern.leastTileContrast * noise)
      {
        found.explained += own.row(k).squaredNorm() / axes.eigenvalues()(k);
        found.number += static_cast<double>(factors);
      }
    }
    if (found.number > 0.0)
    {
      const double squares = tile.products.diagonal().tail(factors).sum();
      found.left = squares - ((right + both).array() * kappa.array()).sum() - found.explained;
      found.dof = (tile.pixels - CurvedTerms) * static_cast<double>(factors) - found.number;
      sums += found;
    }
  }
  return sums;
}

/** Returns whether single tiles move by themselves: whether the derivatives explain more of their responses than
 * chance, by the noise that the other squares show: frames of unequal illumination have unequal noise. */
bool
IsMotionLocal(const MotionSquares & sums)
{
  if (!(sums.dof > 0.0 && sums.left > 0.0))
  {
    return false;
  }
  const double excess = sums.explained * sums.dof / sums.left - sums.number;
  return excess > InPattern.leastLocalMotion * sums.number &&
         excess > Significance.oneTest * std::sqrt(2.0 * sums.number);
}
} // namespace

MotionLeakage
EstimateMotionLeakage(const IlluminationResponses & data, const ParallelFor & parallelFor)
{
  std::vector<RowOfTiles> rows((data.frame.geometry.height + Side - 1) / Side);
  parallelFor(rows.size(), [&](std::size_t row) { rows[row] = SumRow(data, row); });
  const auto      size = static_cast<Eigen::Index>(StencilsOfLowOrder + data.factors);
  Eigen::MatrixXd products = Eigen::MatrixXd::Zero(size, size);
  for (const RowOfTiles & row : rows)
  {
    products += row.products;
  }
  const Eigen::MatrixXd kappa = SolveLeakage(products);
  MotionSquares         sums;
  for (const RowOfTiles & row : rows)
  {
    sums += SumMotion(row.tiles, data.frame.frames, kappa);
  }
  return { kappa, IsMotionLocal(sums) };
}

} // namespace sensornoise
