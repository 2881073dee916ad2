// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "pixels/SurfaceSums.h"

#include "pixels/VarianceLine.h"
#include "scene/ReferenceFrame.h"

#include <algorithm>

namespace sensornoise
{

namespace
{
/** Exponents of the place (x, y) and of I in a term of CurvedSurface. */
struct Exponents
{
  std::size_t x;
  std::size_t y;
  std::size_t level;
};

constexpr std::array<Exponents, CurvedTerms> Terms{ { { 0, 0, 0 },
                                                      { 0, 0, 1 },
                                                      { 1, 0, 0 },
                                                      { 0, 1, 0 },
                                                      { 1, 0, 1 },
                                                      { 0, 1, 1 },
                                                      { 2, 0, 0 },
                                                      { 1, 1, 0 },
                                                      { 0, 2, 0 },
                                                      { 2, 0, 1 },
                                                      { 1, 1, 1 },
                                                      { 0, 2, 1 } } };
} // namespace

Powers
PowersOf(double place)
{
  Powers powers{ 1.0 };
  for (std::size_t i = 1; i < powers.size(); ++i)
  {
    powers[i] = powers[i - 1] * place;
  }
  return powers;
}

Move::Move(std::size_t i, double parts)
  : m_Coefficients{}
{
  const double scale = 1.0 / parts;
  const double shift = (static_cast<double>(i) + 0.5) * scale - 0.5;
  m_Coefficients[0][0] = 1.0;
  for (std::size_t power = 1; power <= OrderOfProducts; ++power)
  {
    for (std::size_t k = 0; k <= power; ++k)
    {
      m_Coefficients[power][k] = shift * m_Coefficients[power - 1][k];
      if (k > 0)
      {
        m_Coefficients[power][k] += scale * m_Coefficients[power - 1][k - 1];
      }
    }
  }
}

SurfaceSums::Gram
SurfaceSums::ProductsOfTerms(double noise) const
{
  Gram gram;
  for (std::size_t a = 0; a < CurvedTerms; ++a)
  {
    for (std::size_t b = 0; b <= a; ++b)
    {
      const std::size_t i = Terms[a].x + Terms[b].x;
      const std::size_t j = Terms[a].y + Terms[b].y;
      const std::size_t level = Terms[a].level + Terms[b].level;
      const double      ofNoise = level == 2 ? noise * m_Pixels.At(i, j) : 0.0;
      const auto        row = static_cast<Eigen::Index>(a);
      const auto        column = static_cast<Eigen::Index>(b);
      gram(row, column) = gram(column, row) = m_OfLevels[level].At(i, j) - ofNoise;
    }
  }
  return gram;
}

CurvedSurface
SurfaceSums::ProductsWith(std::size_t variable, double noise) const
{
  CurvedSurface products;
  const auto &  sums = m_OfVariables[variable];
  for (std::size_t a = 0; a < CurvedTerms; ++a)
  {
    const auto [i, j, level] = Terms[a];
    products(static_cast<Eigen::Index>(a)) = sums[level].At(i, j) - (level == 1 ? noise * sums[0].At(i, j) : 0.0);
  }
  return products;
}

void
SurfaceSums::AddPart(const SurfaceSums & part, const Move & x, const Move & y)
{
  m_Pixels.AddPart(part.m_Pixels, x, y);
  for (std::size_t level = 0; level < m_OfLevels.size(); ++level)
  {
    m_OfLevels[level].AddPart(part.m_OfLevels[level], x, y);
  }
  for (std::size_t j = 0; j < m_OfVariables.size(); ++j)
  {
    for (std::size_t level = 0; level < 2; ++level)
    {
      m_OfVariables[j][level].AddPart(part.m_OfVariables[j][level], x, y);
    }
  }
}

/** The sums of SurfaceSums over the pixels of one row of a tile, times powers of x. */
class SurfaceSumsOfRow
{
public:
  explicit SurfaceSumsOfRow(std::size_t variables)
    : m_OfVariables(variables)
  {}

  void
  Add(const Powers & x, double w, double level, const double * variables)
  {
    std::array<double, 3>                      weights{ w, w * level, w * level * level };
    std::array<double, 2 * (OrderOfTerms + 1)> weightsOfVariables{};
    for (std::size_t i = 0; i <= OrderOfTerms; ++i)
    {
      weightsOfVariables[i] = weights[0] * x[i];
      weightsOfVariables[OrderOfTerms + 1 + i] = weights[1] * x[i];
    }
    for (std::size_t i = 0; i <= OrderOfProducts; ++i)
    {
      m_Pixels[i] += x[i];
    }
    for (std::size_t k = 0; k < weights.size(); ++k)
    {
      for (std::size_t i = 0; i <= OrderOfProducts; ++i)
      {
        m_OfLevels[k][i] += weights[k] * x[i];
      }
    }
    for (std::size_t j = 0; j < m_OfVariables.size(); ++j)
    {
      for (std::size_t i = 0; i < weightsOfVariables.size(); ++i)
      {
        m_OfVariables[j][i] += variables[j] * weightsOfVariables[i];
      }
    }
  }
  /** Adds the row, at the place of \a y, to \a tile, and begins the next one. */
  void
  MoveTo(SurfaceSums & tile, const Powers & y)
  {
    tile.m_Pixels.AddRow(m_Pixels.data(), y);
    for (std::size_t k = 0; k < m_OfLevels.size(); ++k)
    {
      tile.m_OfLevels[k].AddRow(m_OfLevels[k].data(), y);
    }
    for (std::size_t j = 0; j < m_OfVariables.size(); ++j)
    {
      tile.m_OfVariables[j][0].AddRow(m_OfVariables[j].data(), y);
      tile.m_OfVariables[j][1].AddRow(m_OfVariables[j].data() + OrderOfTerms + 1, y);
      m_OfVariables[j] = {};
    }
    m_Pixels = {};
    m_OfLevels = {};
  }

private:
  Powers                                                  m_Pixels{};
  std::array<Powers, 3>                                   m_OfLevels{};
  std::vector<std::array<double, 2 * (OrderOfTerms + 1)>> m_OfVariables;
};

std::vector<SurfaceSums>
SumRowOfTiles(const IlluminationResponses & data,
              std::size_t                   firstRow,
              std::size_t                   tileHeight,
              std::size_t                   tileWidth,
              std::size_t                   variables,
              const VariablesOfPixel &      variablesOfPixel)
{
  const ReferenceFrame &   frame = data.frame;
  const std::size_t        width = frame.geometry.width;
  std::vector<SurfaceSums> tiles((width + tileWidth - 1) / tileWidth, SurfaceSums(variables));
  std::vector<Powers>      powersOfX(tileWidth);
  for (std::size_t x = 0; x < tileWidth; ++x)
  {
    powersOfX[x] = PowersOf(PlaceOf(x, tileWidth));
  }
  std::vector<double> values(variables);
  SurfaceSumsOfRow    sums(variables);
  for (std::size_t y = firstRow; y < std::min(firstRow + tileHeight, frame.geometry.height); ++y)
  {
    const Powers powersOfY = PowersOf(PlaceOf(y - firstRow, tileHeight));
    for (std::size_t tile = 0; tile < tiles.size(); ++tile)
    {
      for (std::size_t x = tile * tileWidth; x < std::min((tile + 1) * tileWidth, width); ++x)
      {
        const std::size_t p = y * width + x;
        if (data.mask[p] != 0)
        {
          const double w = 1.0 / data.line.At(frame.neighbourMean[p]);
          variablesOfPixel({ p, tile, w }, values.data());
          sums.Add(powersOfX[x - tile * tileWidth], w, frame.mean[p] - data.centreDn, values.data());
        }
      }
      sums.MoveTo(tiles[tile], powersOfY);
    }
  }
  return tiles;
}

std::vector<SurfaceSums>
JoinTiles(const std::vector<SurfaceSums> & parts, std::size_t across, std::size_t columns, std::size_t rows)
{
  const std::size_t        down = parts.size() / across;
  const std::size_t        acrossJoined = (across + columns - 1) / columns;
  std::vector<SurfaceSums> joined(acrossJoined * ((down + rows - 1) / rows),
                                  SurfaceSums(parts.empty() ? 0 : parts.front().NumberOfVariables()));
  for (std::size_t part = 0; part < parts.size(); ++part)
  {
    const std::size_t x = part % across;
    const std::size_t y = part / across;
    joined[y / rows * acrossJoined + x / columns].AddPart(
      parts[part], Move(x % columns, static_cast<double>(columns)), Move(y % rows, static_cast<double>(rows)));
  }
  return joined;
}

} // namespace sensornoise
