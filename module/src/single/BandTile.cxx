// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "single/LevelSums.h"

#include "base/Simd.h"
#include "sensornoise/FrameGeometry.h"
#include "base/Constants.h"
#include "single/Constants.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <type_traits>
#include <vector>

namespace sensornoise
{

namespace
{
/** to[i] = sum over the 6 rows of weights times rows; \a oldest is the first row in the ring. */
void
MixRows(const float *                            rows,
        std::size_t                              stride,
        std::size_t                              oldest,
        const std::array<float, Wavelet::Taps> & weights,
        std::size_t                              count,
        float *                                  to)
{
  const auto         row = [&](std::size_t k) { return rows + (oldest + k) % Wavelet::Taps * stride; };
  const float *const a = row(0), *const b = row(1), *const c = row(2), *const d = row(3), *const e = row(4),
                     *const f = row(5);
  for (std::size_t i = 0; i < count; ++i)
  {
    to[i] = ((weights[0] * a[i] + weights[1] * b[i]) + (weights[2] * c[i] + weights[3] * d[i])) +
            (weights[4] * e[i] + weights[5] * f[i]);
  }
}

/** The coefficient of column i: its even pixels are even[i], even[i + 1], even[i + 2]. */
inline float
AlongRow(const float * even, const float * odd, const std::array<float, Wavelet::Taps> & weights, std::size_t i)
{
  return ((weights[0] * even[i] + weights[1] * odd[i]) + (weights[2] * even[i + 1] + weights[3] * odd[i + 1])) +
         (weights[4] * even[i + 2] + weights[5] * odd[i + 2]);
}

/** to[i] = sum of VSize x VSize values from \a from + i on. \a sums has room for count + VSize - 1 values. */
template <std::size_t VSize>
void
SumWindows(const float * from, std::size_t stride, std::size_t count, float * sums, float * to)
{
  for (std::size_t i = 0; i < count + VSize - 1; ++i)
  {
    float sum = from[i];
    for (std::size_t k = 1; k < VSize; ++k)
    {
      sum += from[i + k * stride];
    }
    sums[i] = sum;
  }
  for (std::size_t i = 0; i < count; ++i)
  {
    float sum = sums[i];
    for (std::size_t k = 1; k < VSize; ++k)
    {
      sum += sums[i + k];
    }
    to[i] = sum;
  }
}

/** to[i] = sum of the 6 x 6 values from \a from + i on, with the weights of the level. \a sums has room for count + 5
 * values. */
void
WeightWindows(const float * from, std::size_t stride, std::size_t count, float * sums, float * to)
{
  constexpr std::size_t                     size = WaveletWindow::Size;
  constexpr const std::array<float, size> & weights = WaveletWindow::level; // symmetric weights
  static_assert(size == 6, "three pairs of equal weights");
  const float *const a = from, *const b = a + stride, *const c = b + stride, *const d = c + stride,
                     *const e = d + stride, *const f = e + stride;
  for (std::size_t i = 0; i < count + size - 1; ++i)
  {
    sums[i] = weights[0] * (a[i] + f[i]) + weights[1] * (b[i] + e[i]) + weights[2] * (c[i] + d[i]);
  }
  for (std::size_t i = 0; i < count; ++i)
  {
    to[i] = weights[0] * (sums[i] + sums[i + 5]) + weights[1] * (sums[i + 1] + sums[i + 4]) +
            weights[2] * (sums[i + 2] + sums[i + 3]);
  }
}
} // namespace

template <typename TPixel>
void
BandTile::LoadRow(const SingleFrame<TPixel> & frame, std::size_t y)
{
  // Differences of pixels of type double are computed in double. Differences of other types are exact in float.
  using Real = std::conditional_t<std::is_same_v<TPixel, double>, double, float>;
  const std::size_t    first = frame.layout.At(2 * m_Tile.x, y);
  const std::size_t    step = frame.layout.step;
  const TPixel * const from = frame.pixels + first;
  const Real           origin = static_cast<Real>(frame.originDn);
  const Real           perUnit = static_cast<Real>(1.0 / frame.unitDn);
  float * const        even = m_Rows.data() + y % Wavelet::Taps * 2 * m_Half;
  float * const        odd = even + m_Half;
  for (std::size_t i = 0; i < m_Half; ++i)
  {
    even[i] = static_cast<float>((static_cast<Real>(from[2 * i * step]) - origin) * perUnit);
    odd[i] = static_cast<float>((static_cast<Real>(from[(2 * i + 1) * step]) - origin) * perUnit);
  }
  if (frame.mask != nullptr)
  {
    constexpr float            missing = std::numeric_limits<float>::quiet_NaN();
    const std::uint8_t * const mask = frame.mask + first;
    for (std::size_t i = 0; i < m_Half; ++i)
    {
      even[i] = mask[2 * i * step] != 0 ? even[i] : missing;
      odd[i] = mask[(2 * i + 1) * step] != 0 ? odd[i] : missing;
    }
  }
}

void
BandTile::TransformRow(std::size_t row, bool hasDetails)
{
  const std::size_t oldest = 2 * (m_Tile.y + row) % Wavelet::Taps;
  const std::size_t width = 2 * m_Half;
  float * const     lowEven = m_Mixed.data();
  float * const     lowOdd = lowEven + m_Half;
  MixRows(m_Rows.data(), width, oldest, Wavelet::low, width, lowEven);
  float * const approximation = m_Approximation.data() + row * m_Columns;
  for (std::size_t i = 0; i < m_Columns; ++i)
  {
    approximation[i] = 0.5F * AlongRow(lowEven, lowOdd, Wavelet::low, i); // the sum of all weights is 2
  }
  if (!hasDetails)
  {
    return;
  }
  float * const highEven = lowEven + width;
  float * const highOdd = highEven + m_Half;
  MixRows(m_Rows.data(), width, oldest, Wavelet::high, width, highEven);
  const std::size_t first = (row - WaveletWindow::Detail) * m_Tile.width;
  float * const     toDetail = detail.data() + first;
  float * const     toDiagonal = diagonal.data() + first;
  float * const     toHorizontal = horizontal.data() + first;
  float * const     toVertical = vertical.data() + first;
  for (std::size_t i = 0; i < m_Tile.width; ++i)
  {
    const std::size_t at = i + WaveletWindow::Detail;
    const float       d = AlongRow(highEven, highOdd, Wavelet::high, at);
    const float       h = AlongRow(lowEven, lowOdd, Wavelet::high, at);
    const float       v = AlongRow(highEven, highOdd, Wavelet::low, at);
    toDetail[i] = d;
    toDiagonal[i] = d * d;
    toHorizontal[i] = h * h;
    toVertical[i] = v * v;
  }
}

void
BandTile::MeasureWindows()
{
  using Window = WaveletWindow;
  constexpr auto    smooth = static_cast<float>(Window::Smooth * Window::Smooth);
  constexpr auto    size = static_cast<float>(Window::Size * Window::Size);
  const std::size_t columns = m_Tile.width + Window::Size - 1; // columns of the deviations
  const std::size_t rows = m_Tile.height + Window::Size - 1;
  m_SquaredDeviations.resize(columns * rows);
  m_Sums.resize(m_Columns);
  for (std::size_t y = 0; y < rows; ++y)
  {
    float * const to = m_SquaredDeviations.data() + y * columns;
    SumWindows<Window::Smooth>(m_Approximation.data() + y * m_Columns, m_Columns, columns, m_Sums.data(), to);
    const float * const centre = m_Approximation.data() + (y + Window::LevelFirst) * m_Columns + Window::LevelFirst;
    for (std::size_t i = 0; i < columns; ++i)
    {
      const float deviation = centre[i] - to[i] * (1.0F / smooth);
      to[i] = deviation * deviation;
    }
  }
  // The variance of a pixel is 4 times the variance of the approximation. The deviation from a mean that contains the
  // pixel lacks 1 part of 25.
  constexpr float perSquare = 4.0F / (size * (1.0F - 1.0F / smooth));
  for (std::size_t y = 0; y < m_Tile.height; ++y)
  {
    float * const ofRow = roughness.data() + y * m_Tile.width;
    SumWindows<Window::Size>(m_SquaredDeviations.data() + y * columns, columns, m_Tile.width, m_Sums.data(), ofRow);
    float * const levels = level.data() + y * m_Tile.width;
    WeightWindows(m_Approximation.data() + (y + Window::LevelFirst) * m_Columns + Window::LevelFirst,
                  m_Columns,
                  m_Tile.width,
                  m_Sums.data(),
                  levels);
    for (std::size_t i = 0; i < m_Tile.width; ++i)
    {
      ofRow[i] *= perSquare;
    }
  }
}

template <typename TPixel>
void
BandTile::Compute(const SingleFrame<TPixel> & frame, const TileOfPositions & tile)
{
  m_Tile = tile;
  m_Columns = tile.width + WaveletWindow::Reach;
  m_Half = m_Columns + Wavelet::Taps / 2 - 1;
  m_Rows.resize(Wavelet::Taps * 2 * m_Half);
  m_Mixed.resize(4 * m_Half);
  const std::size_t rows = tile.height + WaveletWindow::Reach;
  m_Approximation.resize(m_Columns * rows);
  for (std::vector<float> * const of : { &level, &roughness, &detail, &diagonal, &horizontal, &vertical })
  {
    of->resize(this->Positions());
  }
  CallWithAvx2([&] {
    for (std::size_t k = 0; k + 2 < Wavelet::Taps; ++k)
    {
      this->LoadRow(frame, 2 * tile.y + k);
    }
    for (std::size_t row = 0; row < rows; ++row)
    {
      this->LoadRow(frame, 2 * (tile.y + row) + Wavelet::Taps - 2);
      this->LoadRow(frame, 2 * (tile.y + row) + Wavelet::Taps - 1);
      this->TransformRow(row, row >= WaveletWindow::Detail && row < WaveletWindow::Detail + tile.height);
    }
    this->MeasureWindows();
  });
}

#define SensorNoise_INSTANTIATE(TPixel) \
  template void BandTile::Compute(const SingleFrame<TPixel> &, const TileOfPositions &)
SensorNoise_FOR_PIXEL_TYPES(SensorNoise_INSTANTIATE);
#undef SensorNoise_INSTANTIATE

namespace
{
/** Returns the diagonal details of a tile in expected standard deviations; 0: the position is left out. */
std::vector<float>
StandardDetails(const BandTile & tile, const LevelGrid & grid)
{
  std::vector<float> details(tile.Positions());
  const auto         largestRoughness = static_cast<float>(InSingle.largestRoughness);
  const auto         largest = static_cast<float>(Significance.oneTest);
  for (std::size_t i = 0; i < details.size(); ++i)
  {
    const float variance = grid.variance[grid.SetOf(tile.level[i])];
    const float detail = tile.detail[i] / std::sqrt(variance);
    const bool  isUsed = tile.roughness[i] < largestRoughness * variance && std::abs(detail) < largest;
    details[i] = isUsed ? detail : 0.0F;
  }
  return details;
}
} // namespace

void
DetailCorrelation::Add(const BandTile & tile, const LevelGrid & grid)
{
  const std::vector<float> details = StandardDetails(tile, grid);
  const std::size_t        width = tile.Width();
  const std::size_t        height = width == 0 ? 0 : details.size() / width;
  for (std::size_t k = 0; k < Places.size(); ++k)
  {
    const auto [right, down] = Places.at(k);
    const auto  across = static_cast<std::size_t>(std::abs(right));
    const auto  under = static_cast<std::size_t>(down);
    std::size_t pairs = 0;
    double      products = 0.0;
    double      squares = 0.0;
    for (std::size_t y = 0; y + under < height; ++y)
    {
      const float * const one = details.data() + y * width + (right < 0 ? across : 0);
      const float * const other = details.data() + (y + under) * width + (right < 0 ? 0 : across);
      for (std::size_t x = 0; x + across < width; ++x)
      {
        const float a = one[x];
        const float b = other[x];
        const float product = a * b;
        pairs += product != 0.0F ? 1 : 0;
        products += static_cast<double>(product);
        squares += static_cast<double>(product != 0.0F ? 0.5F * (a * a + b * b) : 0.0F);
      }
    }
    m_Sums.at(k).pairs += static_cast<double>(pairs);
    m_Sums.at(k).products += products;
    m_Sums.at(k).squares += squares;
  }
}

void
DetailCorrelation::Add(const DetailCorrelation & other)
{
  for (std::size_t k = 0; k < m_Sums.size(); ++k)
  {
    m_Sums.at(k).pairs += other.m_Sums.at(k).pairs;
    m_Sums.at(k).products += other.m_Sums.at(k).products;
    m_Sums.at(k).squares += other.m_Sums.at(k).squares;
  }
}

DetailCorrelation::Lag
DetailCorrelation::Largest() const
{
  Lag largest;
  for (std::size_t k = 0; k < m_Sums.size(); ++k)
  {
    const Sums & sums = m_Sums.at(k);
    const double value = sums.squares > 0.0 ? sums.products / sums.squares : 0.0;
    if (std::abs(value) > std::abs(largest.value))
    {
      largest = { Places.at(k).x, Places.at(k).y, value, 1.0 / std::sqrt(sums.pairs) };
    }
  }
  return largest;
}

} // namespace sensornoise
