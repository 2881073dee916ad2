// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/correlation/NoiseResiduals.h"

#include "sensornoise/base/WideVectors.h"
#include "sensornoise/correlation/Constants.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace sensornoise
{

namespace
{
/** An orthonormal basis of the constant and what the series add to it. */
Eigen::MatrixXd
BasisOf(const Eigen::MatrixXd & series, std::size_t frames)
{
  const auto      rows = static_cast<Eigen::Index>(frames);
  Eigen::MatrixXd basis = Eigen::MatrixXd::Constant(rows, 1, 1.0 / std::sqrt(static_cast<double>(frames)));
  for (Eigen::Index j = 0; j < series.cols(); ++j)
  {
    Eigen::VectorXd column = series.col(j).head(rows);
    const double    size = column.norm();
    for (int twice = 0; twice < 2; ++twice)
    {
      column -= basis * (basis.transpose() * column);
    }
    if (column.norm() > 1e-6 * size)
    {
      basis.conservativeResize(rows, basis.cols() + 1);
      basis.rightCols(1) = column.normalized();
    }
  }
  return basis;
}

/** Rows of values that are added while a sum is in a register. */
constexpr std::size_t Together = 4;
using Weights = std::array<float, Together>;

/** Adds the first \a count of Together rows of \a size values, times their weights, to \a sum, one after the other. */
void
AddWeighed(const float * rows, const Weights & weights, std::size_t count, std::size_t size, float * sum)
{
  if (count < Together)
  {
    for (std::size_t k = 0; k < count; ++k)
    {
      for (std::size_t p = 0; p < size; ++p)
      {
        sum[p] += weights[k] * rows[k * size + p];
      }
    }
    return;
  }
  WithWideVectors([&] {
    for (std::size_t p = 0; p < size; ++p)
    {
      float own = sum[p];
      for (std::size_t k = 0; k < Together; ++k)
      {
        own += weights[k] * rows[k * size + p];
      }
      sum[p] = own;
    }
  });
}

/** A curve through points of growing x. */
class NoiseCurve
{
public:
  void
  Add(double x, double y)
  {
    m_Points.emplace_back(x, y);
  }
  double
  At(double x) const
  {
    const auto above = std::upper_bound(
      m_Points.begin(), m_Points.end(), x, [](double value, const auto & p) { return value < p.first; });
    if (above == m_Points.begin() || above == m_Points.end())
    {
      return above == m_Points.end() ? m_Points.back().second : m_Points.front().second;
    }
    const auto & a = *(above - 1);
    return a.second + (above->second - a.second) * (x - a.first) / (above->first - a.first);
  }

private:
  std::vector<std::pair<double, double>> m_Points;
};
} // namespace

NoiseResiduals::NoiseResiduals(NoiseSample             sample,
                               const Eigen::MatrixXd & series,
                               const SampledPixels &   pixels,
                               const ParallelFor &     parallelFor)
  : m_Sample(std::move(sample))
  , m_Basis(BasisOf(series, m_Sample.GetTiles().frames))
{
  const SampleTiles & tiles = m_Sample.GetTiles();
  const std::size_t   size = tiles.Pixels();
  m_Light.resize(tiles.origins.size() * size);
  m_Variance.assign(m_Light.size(), 0.0F);
  parallelFor(tiles.origins.size(), [&](std::size_t i) {
    for (std::size_t p = 0; p < size; ++p)
    {
      const double light = pixels.mean[m_Sample.PixelOf(i, p)] - pixels.blackDn;
      m_Light[i * size + p] = std::isfinite(light) ? static_cast<float>(light) : 0.0F;
    }
    this->ProjectTile(i);
    for (std::size_t t = 0; t < tiles.frames; ++t)
    {
      const float * values = this->OfTile(i) + t * size;
      for (std::size_t p = 0; p < size; ++p)
      {
        m_Variance[i * size + p] += values[p] * values[p];
      }
    }
  });
  this->Take(pixels.take, parallelFor);
}

void
NoiseResiduals::Take(const std::vector<std::uint8_t> & take, const ParallelFor & parallelFor)
{
  const std::size_t         size = this->GetTiles().Pixels();
  std::vector<std::uint8_t> ofSample(m_Light.size());
  parallelFor(this->GetTiles().origins.size(), [&](std::size_t i) {
    for (std::size_t p = 0; p < size; ++p)
    {
      ofSample[i * size + p] = take[m_Sample.PixelOf(i, p)];
    }
  });
  this->Weigh(ofSample);
}

void
NoiseResiduals::DropFirst(std::size_t frames, const ParallelFor & parallelFor)
{
  m_Sample.DropFirst(frames);
  m_Basis = BasisOf(m_Basis.bottomRows(m_Basis.rows() - static_cast<Eigen::Index>(frames)), this->GetTiles().frames);
  parallelFor(this->GetTiles().origins.size(), [this](std::size_t i) { this->ProjectTile(i); });
}

void
NoiseResiduals::ProjectTile(std::size_t i)
{
  const std::size_t  size = this->GetTiles().Pixels();
  const std::size_t  frames = this->GetTiles().frames;
  float *            values = m_Sample.OfTile(i);
  const auto         series = static_cast<std::size_t>(m_Basis.cols());
  std::vector<float> coordinates(series * size, 0.0F);
  for (std::size_t t = 0; t < frames; t += Together)
  {
    const std::size_t together = std::min(Together, frames - t);
    for (std::size_t j = 0; j < series; ++j)
    {
      Weights weights;
      for (std::size_t k = 0; k < together; ++k)
      {
        weights[k] = static_cast<float>(m_Basis(static_cast<Eigen::Index>(t + k), static_cast<Eigen::Index>(j)));
      }
      AddWeighed(values + t * size, weights, together, size, coordinates.data() + j * size);
    }
  }
  for (std::size_t t = 0; t < frames; ++t)
  {
    for (std::size_t j = 0; j < series; j += Together)
    {
      const std::size_t together = std::min(Together, series - j);
      Weights           weights;
      for (std::size_t k = 0; k < together; ++k)
      {
        weights[k] = -static_cast<float>(m_Basis(static_cast<Eigen::Index>(t), static_cast<Eigen::Index>(j + k)));
      }
      AddWeighed(coordinates.data() + j * size, weights, together, size, values + t * size);
    }
  }
}

void
NoiseResiduals::Weigh(const std::vector<std::uint8_t> & take)
{
  m_Weight.assign(take.size(), 0.0F);
  m_Bin.assign(take.size(), 0);
  std::vector<std::pair<float, std::uint32_t>> order; // light and pixel of those that are taken, by their light
  for (std::size_t k = 0; k < take.size(); ++k)
  {
    if (take[k] != 0)
    {
      order.emplace_back(m_Light[k], static_cast<std::uint32_t>(k));
    }
  }
  m_Pixels = order.size();
  std::sort(order.begin(), order.end());
  const std::size_t bins =
    std::clamp<std::size_t>(order.size() / InCorrelation.leastPixelsOfBin, 1, InCorrelation.noiseBins);
  NoiseCurve curve;
  for (std::size_t b = 0; b < bins; ++b)
  {
    const std::size_t first = b * order.size() / bins;
    const std::size_t last = (b + 1) * order.size() / bins;
    double            light = 0.0;
    double            sum = 0.0;
    for (std::size_t k = first; k < last; ++k)
    {
      light += order[k].first;
      sum += m_Variance[order[k].second];
    }
    const auto count = static_cast<double>(std::max<std::size_t>(1, last - first));
    curve.Add(light / count, sum / count / std::max(1.0, this->GetFreedom()));
  }
  for (std::size_t rank = 0; rank < order.size(); ++rank)
  {
    const auto [light, pixel] = order[rank];
    const double typical = curve.At(light);
    m_Weight[pixel] = typical > 0.0 ? static_cast<float>(1.0 / typical) : 0.0F;
    m_Bin[pixel] = static_cast<std::uint8_t>(rank * LightBins / order.size());
  }
}

} // namespace sensornoise
