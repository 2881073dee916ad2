// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "pixels/IlluminationResponses.h"

#include "base/Eigen.h"
#include "base/Stencils.h"
#include "sensornoise/Parallel.h"
#include "pixels/Constants.h"
#include "pixels/ProjectionSums.h"
#include "pixels/VarianceLine.h"
#include "scene/ReferenceFrame.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
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
  /** Returns the terms of a surface at pixel \a p: 1 and I, and both times the place in the tile. */
  Surface
  SurfaceAt(std::size_t p, double centred) const
  {
    return sensornoise::Tiles{ Side, Side, this->Tiles() }.SurfaceAt(p, m_Frame.geometry.width, centred);
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

/** Returns the products of the derivatives with themselves and with the responses over a band, after the surface of
 * each tile was subtracted: a line in I whose coefficients vary linearly over the tile, as the illumination may. */
Eigen::MatrixXd
ProductsOfBand(const Bands & bands, std::size_t band)
{
  /** Sums over a tile. */
  struct TileSums
  {
    double          pixels{ 0.0 };
    Eigen::MatrixXd gram;     // products of the terms of the surface
    Eigen::MatrixXd products; // products of these terms and the variables
  };
  constexpr Eigen::Index terms = Surface::SizeAtCompileTime;
  const auto             variables = static_cast<Eigen::Index>(bands.Variables());
  std::vector<TileSums>  tiles(bands.Tiles(),
                               { 0.0, Eigen::MatrixXd::Zero(terms, terms), Eigen::MatrixXd::Zero(terms, variables) });
  bands.ForPixels(band, [&](std::size_t p, double w, double centred, const std::vector<double> & z) {
    TileSums &    s = tiles[bands.TileOf(p)];
    const Surface own = bands.SurfaceAt(p, centred);
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
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(Derivatives, variables);
  bands.ForPixels(band, [&](std::size_t p, double w, double centred, const std::vector<double> & z) {
    const TileSums & s = tiles[bands.TileOf(p)];
    if (s.pixels > InPattern.leastLeakagePixels)
    {
      const Eigen::VectorXd free =
        Eigen::Map<const Eigen::VectorXd>(z.data(), variables) - s.products.transpose() * bands.SurfaceAt(p, centred);
      result.noalias() += w * free.head<Derivatives>() * free.transpose();
    }
  });
  return result;
}

/** Returns kappa, with a row for each derivative and a column for each illumination component. */
Eigen::MatrixXd
EstimateLeakage(const Bands & bands, const ParallelFor & parallelFor)
{
  std::vector<Eigen::MatrixXd> parts(bands.Size());
  parallelFor(bands.Size(), [&](std::size_t band) { parts[band] = ProductsOfBand(bands, band); });
  Eigen::MatrixXd products = Eigen::MatrixXd::Zero(Derivatives, static_cast<Eigen::Index>(bands.Variables()));
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
} // namespace

std::vector<std::vector<double>>
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
  return responses;
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

} // namespace sensornoise
