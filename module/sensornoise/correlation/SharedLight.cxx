// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/correlation/SharedLight.h"

#include "sensornoise/base/WideVectors.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

namespace sensornoise
{

namespace
{
/** Segments of a row or column of a tile, and cells along its side; those that are not the same nor neighbours are far
 * apart. */
constexpr std::size_t Segments = 4;

/** Sums over the segments of the tile's rows, of its columns, and over its cells. */
struct SegmentSums
{
  std::vector<std::array<double, Segments>> rows;
  std::vector<std::array<double, Segments>> columns;
  std::array<double, Segments * Segments>   cells;

  explicit SegmentSums(std::size_t side)
    : rows(side)
    , columns(side)
    , cells{}
  {}

  template <typename TFunction>
  void
  Sum(TFunction valueOf)
  {
    const std::size_t side = rows.size();
    const std::size_t length = side / Segments;
    using Line = std::array<double, SampleTiles::Side>;
    std::array<Line, Segments> ofColumns{};
    cells.fill(0.0);
    for (std::size_t y = 0; y < side; ++y)
    {
      Line   values;
      Line & column = ofColumns[y / length];
      for (std::size_t x = 0; x < side; ++x)
      {
        values[x] = valueOf(y * side + x);
        column[x] += values[x];
      }
      // Of all segments side by side: one after the other, every addition would wait for the one before.
      std::array<double, Segments> own{};
      for (std::size_t x = 0; x < length; ++x)
      {
        for (std::size_t s = 0; s < Segments; ++s)
        {
          own[s] += values[s * length + x];
        }
      }
      rows[y] = own;
      for (std::size_t s = 0; s < Segments; ++s)
      {
        cells[y / length * Segments + s] += own[s];
      }
    }
    for (std::size_t x = 0; x < side; ++x)
    {
      for (std::size_t s = 0; s < Segments; ++s)
      {
        columns[x][s] = ofColumns[s][x];
      }
    }
  }
};

double
FarProduct(const std::array<double, Segments> & a, const std::array<double, Segments> & b)
{
  return a[0] * (b[2] + b[3]) + a[1] * b[3] + b[0] * (a[2] + a[3]) + b[1] * a[3];
}

double
LineProduct(const std::vector<std::array<double, Segments>> & lines, std::size_t apart)
{
  double sum = 0.0;
  for (std::size_t y = 0; y + apart < lines.size(); ++y)
  {
    sum += FarProduct(lines[y], lines[y + apart]);
  }
  return sum;
}

double
CellProduct(const std::array<double, Segments * Segments> & cells)
{
  double sum = 0.0;
  for (std::size_t i = 0; i < cells.size(); ++i)
  {
    for (std::size_t j = i + 2 * Segments; j < cells.size(); ++j)
    {
      const std::size_t a = i % Segments;
      const std::size_t b = j % Segments;
      sum += a + 2 <= b || b + 2 <= a ? cells[i] * cells[j] : 0.0;
    }
  }
  return sum;
}

/** Adds the products of a tile's sums, times \a factor, to one member of all DistantSums. */
void
AddProducts(SharedLight & light, const SegmentSums & sums, double DistantSums::* member, double factor)
{
  for (std::size_t d = 0; d < SharedLight::Lines; ++d)
  {
    light.rows[d].*member += factor * LineProduct(sums.rows, d);
    light.columns[d].*member += factor * LineProduct(sums.columns, d);
  }
  light.far.*member += factor * CellProduct(sums.cells);
}

SharedLight
SumTile(const NoiseResiduals & residuals, std::size_t i)
{
  const SampleTiles & tiles = residuals.GetTiles();
  const std::size_t   size = tiles.Pixels();
  const float *       w = residuals.WeightOf(i);
  const float *       z = residuals.LightOf(i);
  const double        factor = 1.0 / residuals.GetFreedom();
  SharedLight         light;
  SegmentSums         sums(tiles.side);
  sums.Sum([&](std::size_t p) { return w[p]; });
  AddProducts(light, sums, &DistantSums::constant, 1.0);
  sums.Sum([&](std::size_t p) { return static_cast<double>(w[p]) * z[p]; });
  AddProducts(light, sums, &DistantSums::light, 1.0);
  sums.Sum([&](std::size_t p) { return static_cast<double>(w[p]) * z[p] * z[p]; });
  AddProducts(light, sums, &DistantSums::lightSquare, 1.0);
  WithWideVectors([&] {
    for (std::size_t t = 0; t < tiles.frames; ++t)
    {
      const float * values = residuals.OfTile(i) + t * size;
      sums.Sum([&](std::size_t p) { return static_cast<double>(w[p] * values[p]); });
      AddProducts(light, sums, &DistantSums::covariance, factor);
      sums.Sum([&](std::size_t p) { return static_cast<double>(w[p] * z[p] * values[p]); });
      light.far.lightCovariance += factor * CellProduct(sums.cells);
    }
  });
  return light;
}
} // namespace

DistantSums &
DistantSums::operator+=(const DistantSums & other)
{
  covariance += other.covariance;
  constant += other.constant;
  light += other.light;
  lightCovariance += other.lightCovariance;
  lightSquare += other.lightSquare;
  return *this;
}

SharedLight &
SharedLight::operator+=(const SharedLight & other)
{
  for (std::size_t d = 0; d < Lines; ++d)
  {
    rows[d] += other.rows[d];
    columns[d] += other.columns[d];
  }
  far += other.far;
  return *this;
}

std::vector<SharedLight>
SumSharedLight(const NoiseResiduals & residuals, const ParallelFor & parallelFor)
{
  std::vector<SharedLight> sums(residuals.GetTiles().origins.size());
  parallelFor(sums.size(), [&](std::size_t i) { sums[i] = SumTile(residuals, i); });
  return sums;
}

} // namespace sensornoise
