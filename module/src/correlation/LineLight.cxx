// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "correlation/LineLight.h"

#include "correlation/Constants.h"
#include "correlation/Jackknife.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace sensornoise
{

namespace
{
/** Parts of the line of a tile; those that are not neighbours share no noise of neighbours. */
constexpr std::size_t PartsOfTile = 4;
/** Blocks of lines, about, for the jackknife. */
constexpr std::size_t Blocks = 24;

/** Products of sums over two parts of a line, with y a residual, w = 1 / V, and z the light. */
struct LineLightProducts
{
  double noise{ 0.0 };      ///< of w y: a covariance that does not depend on the light ...
  double constant{ 0.0 };   ///< ... times this
  double mixed{ 0.0 };      ///< of w z: what each makes of the other
  double lightNoise{ 0.0 }; ///< of w z y: a covariance in proportion to the lights' product ...
  double square{ 0.0 };     ///< ... times this

  LineLightProducts &
  operator+=(const LineLightProducts & other)
  {
    noise += other.noise;
    constant += other.constant;
    mixed += other.mixed;
    lightNoise += other.lightNoise;
    square += other.square;
    return *this;
  }

  /** The part in proportion to the lights' product. */
  double
  OfLight() const
  {
    const double determinant = constant * square - mixed * mixed;
    return determinant > InCorrelation.leastSpread * constant * square
             ? (constant * lightNoise - mixed * noise) / determinant
             : std::numeric_limits<double>::quiet_NaN();
  }
};

/** The sum over all pairs of parts that are no neighbours. */
double
ProductOfParts(const std::vector<double> & sums)
{
  double product = 0.0;
  double before = 0.0; // of all parts but the last
  for (std::size_t s = 2; s < sums.size(); ++s)
  {
    before += sums[s - 2];
    product += sums[s] * before;
  }
  return product;
}

/** The pixels of one line of the tiles of a group, in the order of the frame. */
class LineOfTiles
{
public:
  LineOfTiles(const NoiseResiduals & residuals, const std::vector<std::size_t> & tiles, LineAxis axis, std::size_t line)
    : m_Residuals(residuals)
    , m_Tiles(tiles)
    , m_Axis(axis)
    , m_Line(line)
  {}

  /** The sums of valueOf(tile, place in the tile) over each part. */
  template <typename TFunction>
  std::vector<double>
  SumParts(TFunction valueOf) const
  {
    const SampleTiles & tiles = m_Residuals.GetTiles();
    const std::size_t   length = tiles.side / PartsOfTile;
    std::vector<double> sums(PartsOfTile * m_Tiles.size(), 0.0);
    for (std::size_t s = 0; s < sums.size(); ++s)
    {
      const std::size_t tile = m_Tiles[s / PartsOfTile];
      for (std::size_t k = s % PartsOfTile * length; k < (s % PartsOfTile + 1) * length; ++k)
      {
        sums[s] += valueOf(tile, tiles.InTile(m_Axis, m_Line, k));
      }
    }
    return sums;
  }

  LineLightProducts
  Products() const
  {
    const auto w = [this](std::size_t i, std::size_t p) { return static_cast<double>(m_Residuals.WeightOf(i)[p]); };
    const auto z = [this](std::size_t i, std::size_t p) { return static_cast<double>(m_Residuals.LightOf(i)[p]); };
    LineLightProducts products;
    products.constant = ProductOfParts(this->SumParts(w));
    products.mixed = ProductOfParts(this->SumParts([&](std::size_t i, std::size_t p) { return w(i, p) * z(i, p); }));
    products.square =
      ProductOfParts(this->SumParts([&](std::size_t i, std::size_t p) { return w(i, p) * z(i, p) * z(i, p); }));
    for (std::size_t t = 0; t < m_Residuals.GetTiles().frames; ++t)
    {
      const auto weighed = [&](std::size_t i, std::size_t p) {
        return w(i, p) * static_cast<double>(m_Residuals.OfTile(i)[t * m_Residuals.GetTiles().Pixels() + p]);
      };
      const auto light = [&](std::size_t i, std::size_t p) { return weighed(i, p) * z(i, p); };
      products.noise += ProductOfParts(this->SumParts(weighed)) / m_Residuals.GetFreedom();
      products.lightNoise += ProductOfParts(this->SumParts(light)) / m_Residuals.GetFreedom();
    }
    return products;
  }

private:
  const NoiseResiduals &           m_Residuals;
  const std::vector<std::size_t> & m_Tiles;
  LineAxis                         m_Axis;
  std::size_t                      m_Line;
};
} // namespace

MeasuredNumber
FindLineLight(const NoiseResiduals & residuals, LineAxis axis, const ParallelFor & parallelFor)
{
  // Every n-th line: the lines are all over the frame, and some tell enough.
  const SampleTiles & tiles = residuals.GetTiles();
  const auto          groups = TilesInLine(tiles, axis);
  const std::size_t   lines = groups.size() * tiles.side;
  const std::size_t   step =
    (tiles.origins.size() + InCorrelation.mostTilesOfLineLight - 1) / InCorrelation.mostTilesOfLineLight;
  std::vector<LineLightProducts> ofLines(lines > 0 ? (lines + step - 1) / step : 0);
  parallelFor(ofLines.size(), [&](std::size_t i) {
    const std::size_t line = i * step;
    ofLines[i] = LineOfTiles(residuals, groups[line / tiles.side], axis, line % tiles.side).Products();
  });
  std::vector<LineLightProducts> blocks(std::min(Blocks, ofLines.size()));
  for (std::size_t i = 0; i < ofLines.size(); ++i)
  {
    blocks[i * blocks.size() / ofLines.size()] += ofLines[i];
  }
  const JackknifeEstimate estimate =
    Jackknife(blocks, [](const LineLightProducts & sum) { return Eigen::VectorXd::Constant(1, sum.OfLight()); });
  const MeasuredNumber square{ estimate.value(0), estimate.StandardError(0) };
  return std::isfinite(square.value) && std::isfinite(square.standardError)
           ? square
           : MeasuredNumber{ 0.0, std::numeric_limits<double>::infinity() };
}

} // namespace sensornoise
