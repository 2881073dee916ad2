// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "correlation/LagSums.h"

#include "base/Simd.h"
#include "correlation/Constants.h"

#include <array>
#include <cstddef>
#include <cstdlib>
#include <numeric>

namespace sensornoise
{

namespace
{
/** Number of segments in a row or column of a tile, and of square cells along its side. Segments or cells that are
 * neither equal nor adjacent are far apart. */
constexpr std::size_t Segments = 4;

/** Sums of segments, [segment][line]: the values of adjacent lines are adjacent in memory. */
template <std::size_t VSide>
using LineSums = std::array<std::array<double, VSide>, Segments>;
using CellSums = std::array<double, Segments * Segments>;

/** Sums over the segments of a tile's rows, over the segments of its columns, and over its cells. */
template <std::size_t VSide>
struct SegmentSums
{
  static constexpr std::size_t Length = VSide / Segments; // length of a segment [pixels]
  using Line = std::array<double, VSide>;

  LineSums<VSide> rows;
  LineSums<VSide> columns;
  CellSums        cells;

  template <typename TFunction>
  void
  Sum(TFunction valueOf)
  {
    columns = {};
    for (std::size_t y = 0; y < VSide; ++y)
    {
      Line   values;
      Line & column = columns[y / Length];
      for (std::size_t x = 0; x < VSide; ++x)
      {
        values[x] = valueOf(y * VSide + x);
        column[x] += values[x];
      }
      this->SumRow(values, y);
    }
    this->SumCells();
  }

  /** Computes the sums of the cells alone. */
  template <typename TFunction>
  void
  SumOfCells(TFunction valueOf)
  {
    columns = {};
    for (std::size_t y = 0; y < VSide; ++y)
    {
      Line & column = columns[y / Length];
      for (std::size_t x = 0; x < VSide; ++x)
      {
        column[x] += valueOf(y * VSide + x);
      }
    }
    this->SumCells();
  }

private:
  /** Adds four values of a segment side by side: a single sum would wait for each addition before the next. */
  void
  SumRow(const Line & values, std::size_t y)
  {
    for (std::size_t s = 0; s < Segments; ++s)
    {
      std::array<double, 4> own{};
      for (std::size_t x = s * Length; x < (s + 1) * Length; x += own.size())
      {
        for (std::size_t k = 0; k < own.size(); ++k)
        {
          own[k] += values[x + k];
        }
      }
      rows[s][y] = (own[0] + own[1]) + (own[2] + own[3]);
    }
  }
  void
  SumCells()
  {
    for (std::size_t k = 0; k < cells.size(); ++k)
    {
      const double * const first = columns[k / Segments].data() + k % Segments * Length;
      cells[k] = std::accumulate(first, first + Length, 0.0);
    }
  }
};

double
CellProduct(const CellSums & cells)
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

/** Sums of products of segments that are far apart along two lines, by the distance of the lines: [distance][line]. */
template <std::size_t VSide>
struct LineProducts
{
  std::array<std::array<double, VSide>, DistantCovariance::Lines> sums{};

  void
  Add(const LineSums<VSide> & lines)
  {
    std::array<double, VSide> last{}; // sum of the last two segments
    for (std::size_t y = 0; y < VSide; ++y)
    {
      last[y] = lines[2][y] + lines[3][y];
    }
    for (std::size_t d = 0; d < DistantCovariance::Lines; ++d)
    {
      for (std::size_t y = 0; y < VSide - d; ++y)
      {
        sums[d][y] += lines[0][y] * last[y + d] + lines[1][y] * lines[3][y + d] + lines[0][y + d] * last[y] +
                      lines[1][y + d] * lines[3][y];
      }
    }
  }
  double
  Total(std::size_t d) const
  {
    return std::accumulate(sums[d].begin(), sums[d].end(), 0.0);
  }
};

/** Products of all segments and cells that are far apart. */
template <std::size_t VSide>
struct SegmentProducts
{
  LineProducts<VSide> rows;
  LineProducts<VSide> columns;
  double              cells{ 0.0 };

  void
  Add(const SegmentSums<VSide> & sums)
  {
    rows.Add(sums.rows);
    columns.Add(sums.columns);
    cells += CellProduct(sums.cells);
  }
  /** Adds the products, times \a factor, to one member of every DistantSums of \a signal. */
  void
  AddTo(DistantCovariance & to, double DistantSums::* member, double factor) const
  {
    for (std::size_t d = 0; d < DistantCovariance::Lines; ++d)
    {
      to.rows[d].*member += factor * rows.Total(d);
      to.columns[d].*member += factor * columns.Total(d);
    }
    to.far.*member += factor * cells;
  }
};

template <std::size_t VSide>
DistantCovariance
SumTile(const NoiseResiduals & residuals, std::size_t i)
{
  constexpr std::size_t size = VSide * VSide;
  const std::size_t     frames = residuals.GetTiles().frames;
  const float *         w = residuals.WeightOf(i);
  const float *         z = residuals.SignalOf(i);
  const double          factor = 1.0 / residuals.GetDof();
  DistantCovariance     distant;
  const auto            addOnce = [&distant](double DistantSums::* member, auto valueOf) {
    SegmentSums<VSide>     sums{};
    SegmentProducts<VSide> products;
    sums.Sum(valueOf);
    products.Add(sums);
    products.AddTo(distant, member, 1.0);
  };
  addOnce(&DistantSums::constant, [=](std::size_t p) { return w[p]; });
  addOnce(&DistantSums::signal, [=](std::size_t p) { return static_cast<double>(w[p]) * z[p]; });
  addOnce(&DistantSums::signalSquare, [=](std::size_t p) { return static_cast<double>(w[p]) * z[p] * z[p]; });
  CallWithAvx2([&] {
    SegmentSums<VSide>     sums{};
    SegmentProducts<VSide> products;
    double                 ofSignal = 0.0;
    for (std::size_t t = 0; t < frames; ++t)
    {
      const float * values = residuals.OfTile(i) + t * size;
      sums.Sum([=](std::size_t p) { return static_cast<double>(w[p] * values[p]); });
      products.Add(sums);
      sums.SumOfCells([=](std::size_t p) { return static_cast<double>(w[p] * z[p] * values[p]); });
      ofSignal += CellProduct(sums.cells);
    }
    products.AddTo(distant, &DistantSums::covariance, factor);
    distant.far.signalCovariance += factor * ofSignal;
  });
  for (const float * const projection : residuals.WaveProjectionsOf(i)) // restores what the waves removed
  {
    SegmentSums<VSide>     sums{};
    SegmentProducts<VSide> products;
    sums.Sum([=](std::size_t p) { return static_cast<double>(w[p] * projection[p]); });
    products.Add(sums);
    products.AddTo(distant, &DistantSums::covariance, 1.0);
    sums.SumOfCells([=](std::size_t p) { return static_cast<double>(w[p] * z[p] * projection[p]); });
    distant.far.signalCovariance += CellProduct(sums.cells);
  }
  if (residuals.GetSubtractedLines())
  {
    const bool areRows = *residuals.GetSubtractedLines() == LineAxis::Rows;
    for (const float * const projection : residuals.LineProjectionsOf(i)) // restores what the regression removed
    {
      SegmentSums<VSide>  sums{};
      LineProducts<VSide> products;
      sums.Sum([=](std::size_t p) { return static_cast<double>(w[p] * projection[p]); });
      products.Add(areRows ? sums.rows : sums.columns);
      (areRows ? distant.rows : distant.columns)[0].covariance += products.Total(0);
    }
  }
  return distant;
}
} // namespace

DistantSums &
DistantSums::operator+=(const DistantSums & other)
{
  covariance += other.covariance;
  constant += other.constant;
  signal += other.signal;
  signalCovariance += other.signalCovariance;
  signalSquare += other.signalSquare;
  return *this;
}

DistantCovariance &
DistantCovariance::operator+=(const DistantCovariance & other)
{
  for (std::size_t d = 0; d < Lines; ++d)
  {
    rows[d] += other.rows[d];
    columns[d] += other.columns[d];
  }
  far += other.far;
  return *this;
}

DistantCovariance
SumDistantCovariance(const NoiseResiduals & residuals, std::size_t i)
{
  return residuals.GetTiles().side == SampleTiles::Side ? SumTile<SampleTiles::Side>(residuals, i)
                                                        : SumTile<SampleTiles::SmallSide>(residuals, i);
}

namespace
{
/** Returns the coefficient of the squared signal in the covariance of pixels that are far apart along both axes [1]. A
 * constant is fitted beside it. Where the signals differ too little to separate both, as in a flat field, the
 * covariance is attributed to the signal alone. */
double
IlluminationOf(const DistantSums & far)
{
  const double squares = far.constant * far.signalSquare;
  const double determinant = squares - far.signal * far.signal;
  if (determinant > InCorrelation.leastSpread * squares)
  {
    return (far.constant * far.signalCovariance - far.signal * far.covariance) / determinant;
  }
  return far.signal > 0.0 ? far.covariance / far.signal : 0.0;
}

double
ConstantOf(const DistantSums & line, double illumination)
{
  return line.constant > 0.0 ? (line.covariance - illumination * line.signal) / line.constant : 0.0;
}
} // namespace

double
CommonNoise::OfLines(const Lag & lag) const
{
  const auto row = static_cast<std::size_t>(std::abs(lag.y));
  const auto column = static_cast<std::size_t>(std::abs(lag.x));
  return (row < rows.size() ? rows[row] : 0.0) + (column < columns.size() ? columns[column] : 0.0);
}

LagSums
CommonNoise::Subtract(LagSums sums, const Lag & lag) const
{
  const double lines = this->OfLines(lag);
  for (PairSums & bin : sums.bins)
  {
    bin.covariance -= lines * bin.constant + illumination * bin.square;
  }
  return sums;
}

CommonNoise
FindCommonNoise(const DistantCovariance & sums)
{
  CommonNoise common;
  common.illumination = IlluminationOf(sums.far);
  for (std::size_t d = 0; d < DistantCovariance::Lines; ++d)
  {
    common.rows[d] = ConstantOf(sums.rows[d], common.illumination);
    common.columns[d] = ConstantOf(sums.columns[d], common.illumination);
  }
  return common;
}

} // namespace sensornoise
