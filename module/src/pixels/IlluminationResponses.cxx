// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "pixels/IlluminationResponses.h"

#include "base/Constants.h"
#include "base/Eigen.h"
#include "base/Stencils.h"
#include "pixels/Constants.h"
#include "pixels/ProjectionSums.h"
#include "pixels/VarianceLine.h"
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
constexpr std::size_t Derivatives = 5;
constexpr std::size_t Side = 8; // side of a tile [pixel]

/** Division of the frame into bands, each one row of tiles. The variables of a pixel are its derivatives and its
 * responses to the illumination. */
class Bands
{
public:
  explicit Bands(const IlluminationResponses & data)
    : m_Data(data)
    , m_Frame(data.frame)
    , m_Factors(data.factors)
  {}

  std::size_t
  Size() const
  {
    return (m_Frame.geometry.height + Side - 1) / Side;
  }
  std::size_t
  Tiles() const
  {
    return (m_Frame.geometry.width + Side - 1) / Side;
  }
  std::size_t
  TileOf(std::size_t p) const
  {
    return p % m_Frame.geometry.width / Side;
  }
  /** Returns the terms of a surface at pixel \a p: 1 and I, and both times the place in the tile; of a curved one, both
   * times the squares and the product of the place, too. */
  template <int Terms>
  Eigen::Matrix<double, Terms, 1>
  SurfaceAt(std::size_t p, double centred) const
  {
    Surface linear = sensornoise::Tiles{ Side, Side, this->Tiles() }.SurfaceAt(p, m_Frame.geometry.width, centred);
    if constexpr (Terms == LinearTerms)
    {
      return linear;
    }
    else
    {
      return WithCurvature(linear, linear(2), linear(3));
    }
  }
  std::size_t
  Variables() const
  {
    return Derivatives + m_Factors;
  }
  std::size_t
  Factors() const
  {
    return m_Factors;
  }
  std::size_t
  Frames() const
  {
    return m_Frame.frames;
  }
  /** Calls function(pixel, weight, mean minus the centre, variables) for the pixels of a band. */
  template <typename TFunction>
  void
  ForPixels(std::size_t band, TFunction function) const
  {
    const std::size_t   width = m_Frame.geometry.width;
    std::vector<double> z(this->Variables());
    for (std::size_t p = Side * band * width; p < std::min(m_Data.mask.size(), Side * (band + 1) * width); ++p)
    {
      if (m_Data.mask[p] != 0)
      {
        std::copy_n(ApplyStencils(m_Frame.mean.data(), width, p).begin(), Derivatives, z.begin());
        for (std::size_t j = 0; j < m_Factors; ++j)
        {
          z[Derivatives + j] = m_Data.coordinates.At(p, j);
        }
        function(p, 1.0 / m_Data.line.At(m_Frame.neighbourMean[p]), m_Frame.mean[p] - m_Data.centreDn, z);
      }
    }
  }

private:
  const IlluminationResponses & m_Data;
  const ReferenceFrame &        m_Frame;
  std::size_t                   m_Factors;
};

/** Sums over a tile, after its surface was subtracted: a line in I whose coefficients vary linearly over the tile, as
 * the illumination may. They are 0 in a tile of few pixels. */
struct TileProducts
{
  double          pixels{ 0.0 };
  Eigen::MatrixXd ofDerivatives; ///< products of the derivatives with themselves and with the responses
  Eigen::VectorXd squares;       ///< squares of the responses
};

/** Returns the products for each tile of a band, after surfaces of \a Terms terms were subtracted. */
template <int Terms>
std::vector<TileProducts>
ProductsOfTiles(const Bands & bands, std::size_t band)
{
  /** Sums over a tile. */
  struct TileSums
  {
    double          pixels{ 0.0 };
    Eigen::MatrixXd gram;     // products of the terms of the surface
    Eigen::MatrixXd products; // products of these terms and the variables
  };
  const auto            variables = static_cast<Eigen::Index>(bands.Variables());
  std::vector<TileSums> tiles(bands.Tiles(),
                              { 0.0, Eigen::MatrixXd::Zero(Terms, Terms), Eigen::MatrixXd::Zero(Terms, variables) });
  bands.ForPixels(band, [&](std::size_t p, double w, double centred, const std::vector<double> & z) {
    TileSums & s = tiles[bands.TileOf(p)];
    const auto own = bands.SurfaceAt<Terms>(p, centred);
    s.pixels += 1.0;
    s.gram.noalias() += w * own * own.transpose();
    s.products.noalias() += w * own * Eigen::Map<const Eigen::RowVectorXd>(z.data(), variables);
  });
  for (TileSums & s : tiles)
  {
    Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> solver;
    solver.setThreshold(1e-9);
    const Eigen::VectorXd unit = (s.gram.diagonal().array() + 1e-300).rsqrt();
    solver.compute(unit.asDiagonal() * s.gram * unit.asDiagonal());
    s.products = (unit.asDiagonal() * solver.solve(unit.asDiagonal() * s.products)).eval(); // coefficients
  }
  const auto                factors = static_cast<Eigen::Index>(bands.Factors());
  std::vector<TileProducts> result(
    bands.Tiles(), { 0.0, Eigen::MatrixXd::Zero(Derivatives, variables), Eigen::VectorXd::Zero(factors) });
  bands.ForPixels(band, [&](std::size_t p, double w, double centred, const std::vector<double> & z) {
    const TileSums & s = tiles[bands.TileOf(p)];
    if (s.pixels > InPattern.leastLeakagePixels)
    {
      const Eigen::VectorXd free = Eigen::Map<const Eigen::VectorXd>(z.data(), variables) -
                                   s.products.transpose() * bands.SurfaceAt<Terms>(p, centred);
      TileProducts & own = result[bands.TileOf(p)];
      own.pixels += 1.0;
      own.ofDerivatives.noalias() += w * free.head<Derivatives>() * free.transpose();
      own.squares += w * free.tail(factors).cwiseAbs2();
    }
  });
  return result;
}

/** Returns kappa, with a row for each derivative and a column for each illumination component. */
Eigen::MatrixXd
EstimateLeakage(const Bands & bands, const ParallelFor & parallelFor)
{
  const Eigen::MatrixXd        none = Eigen::MatrixXd::Zero(Derivatives, static_cast<Eigen::Index>(bands.Variables()));
  std::vector<Eigen::MatrixXd> parts(bands.Size());
  parallelFor(bands.Size(), [&](std::size_t band) {
    parts[band] = none;
    for (const TileProducts & tile : ProductsOfTiles<LinearTerms>(bands, band))
    {
      parts[band] += tile.ofDerivatives;
    }
  });
  Eigen::MatrixXd products = none;
  for (const Eigen::MatrixXd & part : parts)
  {
    products += part;
  }
  const Eigen::MatrixXd gram = products.leftCols<Derivatives>();
  const Eigen::MatrixXd right = products.rightCols(static_cast<Eigen::Index>(bands.Factors()));
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

/** Returns the squares over the tiles of a band, after the leakage \a leak of the whole frame was subtracted. */
MotionSquares
SumMotionOfBand(const Bands & bands, std::size_t band, const Eigen::MatrixXd & leak)
{
  // The noise of the mean in the products of a derivative along x or y, whose stencil has the squares 1/4 and 1/4.
  const double  noise = 0.5 * Side * Side / static_cast<double>(bands.Frames());
  MotionSquares sums;
  for (const TileProducts & tile : ProductsOfTiles<CurvedTerms>(bands, band))
  {
    const Eigen::MatrixXd gram = tile.ofDerivatives.leftCols<Derivatives>();
    const Eigen::MatrixXd right = tile.ofDerivatives.rightCols(leak.cols()) - gram * leak; // without the leakage
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes(gram.topLeftCorner<2, 2>());
    const Eigen::MatrixXd                                own = axes.eigenvectors().transpose() * right.topRows<2>();
    MotionSquares                                        found;
    for (Eigen::Index k = 0; k < 2; ++k)
    {
      if (axes.eigenvalues()(k) > InPattern.leastTileContrast * noise)
      {
        found.explained += own.row(k).squaredNorm() / axes.eigenvalues()(k);
        found.number += static_cast<double>(own.cols());
      }
    }
    if (found.number > 0.0)
    {
      const Eigen::MatrixXd both = right + tile.ofDerivatives.rightCols(leak.cols());
      found.left = tile.squares.sum() - (both.array() * leak.array()).sum() - found.explained;
      found.dof = (tile.pixels - CurvedTerms) * static_cast<double>(own.cols()) - found.number;
      sums += found;
    }
  }
  return sums;
}

/** Returns whether single tiles move by themselves: whether the derivatives explain more of their responses than
 * chance, by the noise that the other squares show: frames of unequal illumination have unequal noise. */
bool
IsMotionLocal(const Bands & bands, const Eigen::MatrixXd & leak, const ParallelFor & parallelFor)
{
  std::vector<MotionSquares> parts(bands.Size());
  parallelFor(bands.Size(), [&](std::size_t band) { parts[band] = SumMotionOfBand(bands, band, leak); });
  MotionSquares sums;
  for (const MotionSquares & part : parts)
  {
    sums += part;
  }
  if (!(sums.dof > 0.0 && sums.left > 0.0))
  {
    return false;
  }
  const double excess = sums.explained * sums.dof / sums.left - sums.number;
  return excess > InPattern.leastLocalMotion * sums.number &&
         excess > Significance.oneTest * std::sqrt(2.0 * sums.number);
}
} // namespace

ResponsesWithoutMotion
RemoveMotionLeakage(const IlluminationResponses & data, const ParallelFor & parallelFor)
{
  const Bands                      bands(data);
  const Eigen::MatrixXd            leak = EstimateLeakage(bands, parallelFor);
  std::vector<std::vector<double>> responses(bands.Factors(), std::vector<double>(data.mask.size(), 0.0));
  parallelFor(bands.Size(), [&](std::size_t band) {
    bands.ForPixels(band, [&](std::size_t p, double, double, const std::vector<double> & z) {
      for (std::size_t j = 0; j < bands.Factors(); ++j)
      {
        responses[j][p] = z[Derivatives + j];
        for (std::size_t k = 0; k < Derivatives; ++k)
        {
          responses[j][p] -= leak(static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(j)) * z[k];
        }
      }
    });
  });
  return { std::move(responses), IsMotionLocal(bands, leak, parallelFor) };
}

namespace
{
/** Sums of the weight w times powers of I, the mean minus the centre, and times z, the response. */
struct LineSums
{
  double w{ 0.0 };
  double wI{ 0.0 };
  double wII{ 0.0 };
  double wZ{ 0.0 };
  double wIZ{ 0.0 };
};
} // namespace

bool
IsOffsetDrift(const IlluminationResponses & data)
{
  const std::size_t      side = InPattern.driftTileSide;
  const ReferenceFrame & frame = data.frame;
  const std::size_t      width = frame.geometry.width;
  const std::size_t      factors = data.factors;
  const Tiles            tiles{ side, side, (width + side - 1) / side };
  const std::size_t      count = tiles.across * ((frame.geometry.height + side - 1) / side);
  for (std::size_t j = 1; j < factors; ++j)
  {
    std::vector<LineSums> parts(count);
    LineSums              whole;
    for (std::size_t p = 0; p < data.mask.size(); ++p)
    {
      if (data.mask[p] != 0)
      {
        const double w = 1.0 / data.line.At(frame.neighbourMean[p]);
        const double centred = frame.mean[p] - data.centreDn;
        const double z = data.coordinates.At(p, j);
        for (LineSums * s : { &parts[tiles.Of(p, width)], &whole })
        {
          s->w += w;
          s->wI += w * centred;
          s->wII += w * centred * centred;
          s->wZ += w * z;
          s->wIZ += w * centred * z;
        }
      }
    }
    const double determinant = whole.w * whole.wII - whole.wI * whole.wI;
    const double level = (whole.wII * whole.wZ - whole.wI * whole.wIZ) / determinant;
    const double slope = (whole.w * whole.wIZ - whole.wI * whole.wZ) / determinant;
    const double explained = level * whole.wZ + slope * whole.wIZ;
    double       chi2 = 0.0;
    double       used = 0.0;
    for (const LineSums & s : parts)
    {
      if (s.w > 0.0)
      {
        chi2 += std::pow(s.wZ - level * s.w - slope * s.wI, 2) / s.w;
        used += 1.0;
      }
    }
    if (chi2 > InPattern.largestDriftChi2 * std::max(1.0, used - 2.0) ||
        explained < InPattern.leastDriftExplained * chi2)
    {
      return false;
    }
  }
  return factors > 1;
}

double
Explained(const std::vector<TileLines> & tiles, double m)
{
  double sum = 0.0;
  for (const TileLines & s : tiles)
  {
    for (std::size_t j = 0; j < s.r1.size(); ++j)
    {
      sum += std::pow(s.r2[j] - m * s.r1[j], 2) / s.Precision(m);
    }
  }
  return sum;
}

namespace
{
/** Returns the derivative of Explained() by \a m. */
double
SlopeOfExplained(const std::vector<TileLines> & tiles, double m)
{
  double sum = 0.0;
  for (const TileLines & s : tiles)
  {
    const double precision = s.Precision(m);
    for (std::size_t j = 0; j < s.r1.size(); ++j)
    {
      const double slope = (s.r2[j] - m * s.r1[j]) / precision;
      sum += 2.0 * slope * (slope * (s.g12 - m * s.g11) - s.r1[j]);
    }
  }
  return sum;
}
} // namespace

double
FindCommonZero(const std::vector<TileLines> & tiles, double start, double range)
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
  // The derivative is positive below the maximum. Its root is exact to the last bits, which the maximum is not.
  double low = best - step;
  double high = best + step;
  for (int i = 0; i < 60; ++i)
  {
    const double middle = 0.5 * (low + high);
    (SlopeOfExplained(tiles, middle) > 0.0 ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

ZeroErrors
SumErrors(const std::vector<TileLines> & tiles, double zero)
{
  ZeroErrors sums;
  for (const TileLines & s : tiles)
  {
    const double precision = s.Precision(zero);
    const double across = s.g12 - zero * s.g11;
    const double leverage = (s.g11 - across * across / precision) / precision;
    for (std::size_t j = 0; j < s.r1.size(); ++j)
    {
      const double r = s.r2[j] - zero * s.r1[j];
      const double signal = r * r / precision - 1.0; // square of the slope over its variance, without its noise
      sums.full +=
        (s.g22 * s.r1[j] * s.r1[j] - 2.0 * s.g12 * s.r1[j] * s.r2[j] + s.g11 * s.r2[j] * s.r2[j]) / s.Determinant();
      sums.information += signal * leverage;
      sums.scatter += (2.0 + 4.0 * std::max(0.0, signal)) * leverage * leverage; // noncentral chi-square
      sums.number += 1.0;
    }
  }
  return sums;
}

} // namespace sensornoise
