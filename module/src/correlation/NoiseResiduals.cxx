// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "correlation/NoiseResiduals.h"

#include "base/Constants.h"
#include "base/Simd.h"
#include "correlation/Constants.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <utility>
#include <vector>

namespace sensornoise
{

UnequalFrames::UnequalFrames(const std::vector<double> & gamma, double gain, double offsetDn)
  : m_Gamma(Eigen::Map<const Eigen::VectorXd>(gamma.data(), static_cast<Eigen::Index>(gamma.size())).cwiseMax(-1.0))
  , m_Gain(gain)
  , m_OffsetDn(offsetDn)
{}

void
UnequalFrames::KeepLast(Eigen::Index frames)
{
  m_Gamma = Eigen::VectorXd(m_Gamma.tail(std::min(frames, m_Gamma.size())));
}

void
UnequalFrames::KeepFirst(Eigen::Index frames)
{
  m_Gamma = Eigen::VectorXd(m_Gamma.head(std::min(frames, m_Gamma.size())));
}

Eigen::VectorXd
UnequalFrames::Autocovariance(const Eigen::MatrixXd & basis, std::size_t lags, const FrameTimes & times) const
{
  const auto      last = static_cast<Eigen::Index>(lags);
  Eigen::VectorXd sums = Eigen::VectorXd::Zero(last + 1);
  if (this->AreEqual())
  {
    return sums;
  }
  // P Gamma P = Gamma - Q (Gamma Q)' - (Gamma Q) Q' + Q (Q' Gamma Q) Q'
  const Eigen::MatrixXd inTime = times.Expand(basis);
  const Eigen::MatrixXd weighted = times.Expand(m_Gamma.asDiagonal() * basis);
  const Eigen::MatrixXd both = inTime * (inTime.transpose() * weighted);
  for (Eigen::Index d = 0; d <= last; ++d)
  {
    const Eigen::Index rows = inTime.rows() - d;
    const auto         along = [&](const Eigen::MatrixXd & a, const Eigen::MatrixXd & b) {
      return a.topRows(rows).cwiseProduct(b.bottomRows(rows)).sum();
    };
    const double own = d == 0 ? m_Gamma.sum() : 0.0;
    sums(d) = own - along(inTime, weighted) - along(weighted, inTime) + along(both, inTime);
  }
  return sums;
}

namespace
{
/** Returns an orthonormal basis of the constant and the series. Series that are linear combinations are left out. */
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

/** Number of rows of values that are added while a sum is in a register. */
constexpr std::size_t Together = 4;
using Weights = std::array<float, Together>;

template <std::size_t VCount>
void
AddRows(const float * rows, const Weights & weights, std::size_t size, float * sum)
{
  for (std::size_t p = 0; p < size; ++p)
  {
    float own = sum[p];
    for (std::size_t k = 0; k < VCount; ++k)
    {
      own += weights[k] * rows[k * size + p];
    }
    sum[p] = own;
  }
}

/** Adds the first \a count of Together rows of \a size values, times their weights, to \a sum in the order of the rows.
 */
void
AddWeighed(const float * rows, const Weights & weights, std::size_t count, std::size_t size, float * sum)
{
  static_assert(Together == 4);
  CallWithAvx2([=, &weights] {
    switch (count)
    {
      case 1:
        return AddRows<1>(rows, weights, size, sum);
      case 2:
        return AddRows<2>(rows, weights, size, sum);
      case 3:
        return AddRows<3>(rows, weights, size, sum);
      default:
        return AddRows<Together>(rows, weights, size, sum);
    }
  });
}

/** Piecewise linear curve through points of increasing x, which is evaluated at increasing x. */
class NoiseCurve
{
public:
  void
  Add(double x, double y)
  {
    m_Points.emplace_back(x, y);
  }
  double
  AtNext(double x)
  {
    while (m_Above < m_Points.size() && !(x < m_Points[m_Above].first))
    {
      ++m_Above;
    }
    if (m_Above == 0 || m_Above == m_Points.size())
    {
      return m_Above == 0 ? m_Points.front().second : m_Points.back().second;
    }
    const auto & a = m_Points[m_Above - 1];
    const auto & b = m_Points[m_Above];
    return a.second + (b.second - a.second) * (x - a.first) / (b.first - a.first);
  }

private:
  std::vector<std::pair<double, double>> m_Points;
  std::size_t                            m_Above{ 0 }; // the first point above the last x
};
} // namespace

NoiseResiduals::NoiseResiduals(NoiseSample             sample,
                               const Eigen::MatrixXd & series,
                               const SampledPixels &   pixels,
                               const ParallelFor &     parallelFor)
  : m_Sample(std::move(sample))
  , m_Basis(BasisOf(series, m_Sample.GetTiles().frames))
{
  this->Project(pixels, parallelFor, [](std::size_t) {});
}

NoiseResiduals::NoiseResiduals(FrameSample             sample,
                               const Eigen::MatrixXd & series,
                               const SampledPixels &   pixels,
                               const ParallelFor &     parallelFor)
  : m_Sample(sample.StartNoise())
  , m_Basis(BasisOf(series, m_Sample.GetTiles().frames))
{
  this->Project(pixels, parallelFor, [&](std::size_t i) { sample.FillNoise(i, pixels.mean, m_Sample); });
}

namespace
{
/** Returns the means of the \a coordinates of \a size pixels over the pixels for which \a take is true, one for each
 * series; 0 if there are none. */
template <typename TTake>
Eigen::VectorXd
MeanCoordinates(const std::vector<float> & coordinates, std::size_t size, TTake take)
{
  Eigen::VectorXd sums = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(coordinates.size() / size));
  double          count = 0.0;
  for (std::size_t p = 0; p < size; ++p)
  {
    if (take(p))
    {
      count += 1.0;
      for (Eigen::Index j = 0; j < sums.size(); ++j)
      {
        sums(j) += static_cast<double>(coordinates[static_cast<std::size_t>(j) * size + p]);
      }
    }
  }
  return sums / std::max(1.0, count);
}
} // namespace

template <typename TFillTile>
void
NoiseResiduals::Project(const SampledPixels & pixels, const ParallelFor & parallelFor, TFillTile fillTile)
{
  const SampleTiles & tiles = m_Sample.GetTiles();
  const std::size_t   size = tiles.Pixels();
  m_Signal.resize(tiles.origins.size() * size);
  m_Variance.resize(m_Signal.size());
  m_MeanCoordinates.resize(m_Basis.cols(), static_cast<Eigen::Index>(tiles.origins.size()));
  m_BlackDn = pixels.blackDn;
  m_IsBlackKnown = pixels.isBlackKnown;
  parallelFor(tiles.origins.size(), [&](std::size_t i) {
    for (std::size_t p = 0; p < size; ++p)
    {
      const double signal = pixels.mean[m_Sample.PixelOf(i, p)] - pixels.blackDn;
      m_Signal[i * size + p] = std::isfinite(signal) ? static_cast<float>(signal) : 0.0F;
    }
    fillTile(i);
    const std::vector<float> coordinates = this->ProjectTile(i);
    m_MeanCoordinates.col(static_cast<Eigen::Index>(i)) =
      MeanCoordinates(coordinates, size, [&](std::size_t p) { return pixels.take[m_Sample.PixelOf(i, p)] != 0; });
    this->SumSquares(i);
  });
  this->Take(pixels.take, parallelFor);
}

void
NoiseResiduals::Take(const std::vector<std::uint8_t> & take, const ParallelFor & parallelFor)
{
  const std::size_t         size = this->GetTiles().Pixels();
  std::vector<std::uint8_t> ofSample(m_Signal.size());
  parallelFor(this->GetTiles().origins.size(), [&](std::size_t i) {
    for (std::size_t p = 0; p < size; ++p)
    {
      ofSample[i * size + p] = take[m_Sample.PixelOf(i, p)];
    }
  });
  this->Weigh(ofSample);
}

void
NoiseResiduals::SetUnequalFrames(UnequalFrames frames)
{
  m_Unequal = std::move(frames);
  m_Unequal.KeepFirst(m_Basis.rows());
}

void
NoiseResiduals::DropFirst(std::size_t frames, const ParallelFor & parallelFor)
{
  m_Sample.DropFirst(frames);
  m_Times.DropFirst(frames);
  m_Unequal.KeepLast(static_cast<Eigen::Index>(this->GetTiles().frames));
  m_Basis = BasisOf(m_Basis.bottomRows(m_Basis.rows() - static_cast<Eigen::Index>(frames)), this->GetTiles().frames);
  parallelFor(this->GetTiles().origins.size(), [this](std::size_t i) { this->ProjectTile(i); });
}

std::vector<float>
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
  return coordinates;
}

Eigen::VectorXd
NoiseResiduals::LevelChangesOf(std::size_t i) const
{
  const Eigen::Index series = m_Basis.cols() - 1; // the first one is the constant
  return m_Basis.rightCols(series) * m_MeanCoordinates.col(static_cast<Eigen::Index>(i)).tail(series);
}

bool
NoiseResiduals::HasEnoughPixels() const
{
  return this->GetTiles().origins.size() >= InCorrelation.leastTiles && m_Pixels >= InCorrelation.leastPixels;
}

void
NoiseResiduals::SumSquares(std::size_t i)
{
  const std::size_t size = this->GetTiles().Pixels();
  CallWithAvx2([this, i, size] {
    std::array<float, SampleTiles::Side * SampleTiles::Side> sums{}; // no pointer can point into them
    for (std::size_t t = 0; t < this->GetTiles().frames; ++t)
    {
      const float * values = this->OfTile(i) + t * size;
      for (std::size_t p = 0; p < size; ++p)
      {
        sums[p] += values[p] * values[p];
      }
    }
    std::copy_n(sums.begin(), size, m_Variance.data() + i * size);
  });
}

void
NoiseResiduals::Weigh(const std::vector<std::uint8_t> & take)
{
  m_Weight.assign(take.size(), 0.0F);
  m_Bin.assign(take.size(), 0);
  const std::vector<std::uint32_t> order = SortPixelsBySignal(m_Signal, take);
  m_Pixels = order.size();
  const auto darkest = static_cast<std::size_t>(InCommon.darkestQuantile * static_cast<double>(m_Pixels));
  m_DarkestSignal = m_Pixels > 0 ? m_Signal[order[darkest]] : 0.0;
  const std::size_t bins =
    std::clamp<std::size_t>(order.size() / InCorrelation.leastPixelsOfBin, 1, InCorrelation.noiseBins);
  NoiseCurve curve;
  for (std::size_t b = 0; b < bins; ++b)
  {
    const std::size_t first = b * order.size() / bins;
    const std::size_t last = (b + 1) * order.size() / bins;
    double            signal = 0.0;
    double            sum = 0.0;
    for (std::size_t k = first; k < last; ++k)
    {
      signal += m_Signal[order[k]];
      sum += m_Variance[order[k]];
    }
    const auto count = static_cast<double>(std::max<std::size_t>(1, last - first));
    curve.Add(signal / count, sum / count / std::max(1.0, this->GetDof()));
  }
  for (std::size_t rank = 0; rank < order.size(); ++rank)
  {
    const std::uint32_t pixel = order[rank];
    const double        typical = curve.AtNext(m_Signal[pixel]);
    m_Weight[pixel] = typical > 0.0 ? static_cast<float>(1.0 / typical) : 0.0F;
    m_Bin[pixel] = static_cast<std::uint8_t>(rank * IntensityBins / order.size());
  }
  double weights = 0.0;
  double signals = 0.0;
  for (const std::uint32_t pixel : order)
  {
    const double weight = double{ m_Weight[pixel] } * m_Weight[pixel];
    weights += weight;
    signals += weight * m_Signal[pixel];
  }
  m_MeanSignal = signals / std::max(smallestDivisor, weights);
}

namespace
{
struct PixelKey
{
  std::uint32_t key; // has the order of the signal
  std::uint32_t pixel;
};

/** Returns an integer in the order of \a signal. The bits of positive numbers have the order of the numbers, the bits
 * of negative numbers the opposite order. */
std::uint32_t
KeyOf(float signal)
{
  constexpr std::uint32_t sign = std::uint32_t{ 1 } << 31;
  const float             number = signal + 0.0F; // +0 and -0 become equal
  std::uint32_t           bits = 0;
  static_assert(sizeof bits == sizeof number);
  std::memcpy(&bits, &number, sizeof bits);
  return (bits & sign) != 0 ? ~bits : bits | sign;
}

/** Sorts by 11 bits of the keys, and keeps the order of pixels that are equal in them. */
void
SortByDigit(unsigned int shift, std::vector<PixelKey> & pixels, std::vector<PixelKey> & sorted)
{
  constexpr std::size_t           digits = 2048;
  std::array<std::size_t, digits> places{};
  const auto                      digitOf = [shift](const PixelKey & pixel) { return (pixel.key >> shift) % digits; };
  for (const PixelKey & pixel : pixels)
  {
    ++places[digitOf(pixel)];
  }
  std::size_t next = 0;
  for (std::size_t & place : places)
  {
    const std::size_t count = place;
    place = next;
    next += count;
  }
  for (const PixelKey & pixel : pixels)
  {
    sorted[places[digitOf(pixel)]++] = pixel;
  }
  pixels.swap(sorted);
}
} // namespace

std::vector<std::uint32_t>
SortPixelsBySignal(const std::vector<float> & signal, const std::vector<std::uint8_t> & take)
{
  std::vector<PixelKey> pixels;
  pixels.reserve(signal.size());
  for (std::size_t p = 0; p < signal.size(); ++p)
  {
    if (take[p] != 0)
    {
      pixels.push_back({ KeyOf(signal[p]), static_cast<std::uint32_t>(p) });
    }
  }
  std::vector<PixelKey> sorted(pixels.size());
  for (const unsigned int shift : { 0U, 11U, 22U })
  {
    SortByDigit(shift, pixels, sorted);
  }
  std::vector<std::uint32_t> order;
  order.reserve(pixels.size());
  for (const PixelKey & pixel : pixels)
  {
    order.push_back(pixel.pixel);
  }
  return order;
}

} // namespace sensornoise
