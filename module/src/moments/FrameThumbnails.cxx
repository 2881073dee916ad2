// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "moments/FrameThumbnails.h"

#include "base/BinaryStream.h"
#include "sensornoise/FrameGeometry.h"
#include "base/Quantiles.h"
#include "moments/Constants.h"
#include "moments/StackFrames.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <numeric>
#include <type_traits>

namespace sensornoise
{

namespace
{
/** Variances over the cells of a frame [DN^2]. */
struct FrameVariances
{
  double changed{ 0.0 }; ///< variance of the deviation from the mean frame, up to a factor and a level; from the median
                         ///< cell
  double whole{ 0.0 };
};

FrameVariances
VariancesOf(const std::vector<double> & mean, const std::vector<double> & frame)
{
  const FrameFit      fit = FitCells(mean, frame, AllBelow(mean.size()));
  double              squares = 0.0;
  std::vector<double> differences;
  for (std::size_t i = 0; i < mean.size(); ++i)
  {
    squares += (frame[i] - fit.level) * (frame[i] - fit.level);
    differences.push_back(std::abs(fit.DifferenceOf(mean[i], frame[i])));
  }
  const double sd = Quantile(differences, 0.5) / MedianOfNormal;
  return { sd * sd, squares / (static_cast<double>(mean.size()) - 1.0) };
}

/** Sums over parts of rows. */
struct RunSums
{
  double pixels{ 0.0 };
  double sum{ 0.0 }; ///< sum of the levels [DN]
  double pairs{ 0.0 };
  double steps{ 0.0 }; ///< sum of the squared differences of neighbours [DN^2]

  RunSums &
  operator+=(const RunSums & other)
  {
    pixels += other.pixels;
    sum += other.sum;
    pairs += other.pairs;
    steps += other.steps;
    return *this;
  }
};

/** Computes the sums of \a count integer pixels that are all used. Integer sums do not depend on the order, and are
 * compiled to SIMD instructions. */
template <typename TPixel>
RunSums
SumIntegers(const TPixel * from, std::size_t count)
{
  std::int64_t  sum = 0;
  std::uint64_t steps = 0;
  for (std::size_t i = 0; i < count; ++i)
  {
    sum += static_cast<std::int32_t>(from[i]);
  }
  for (std::size_t i = 1; i < count; ++i)
  {
    const auto step =
      static_cast<std::uint32_t>(static_cast<std::int32_t>(from[i]) - static_cast<std::int32_t>(from[i - 1]));
    steps += step * step; // the square is below 2^32 for either sign
  }
  return { static_cast<double>(count),
           static_cast<double>(sum),
           static_cast<double>(count - std::min<std::size_t>(1, count)),
           static_cast<double>(steps) };
}

/** Computes the sums of the pixels that are finite, and nonzero in \a mask if that is not null. */
template <typename TPixel>
RunSums
SumUsable(const TPixel * from, const std::uint8_t * mask, std::size_t count)
{
  RunSums sums;
  double  last = std::numeric_limits<double>::quiet_NaN(); // level of the pixel before, if it counts
  for (std::size_t i = 0; i < count; ++i)
  {
    const auto level = static_cast<double>(from[i]);
    const bool counts = std::isfinite(level) && (mask == nullptr || mask[i] != 0);
    if (counts)
    {
      sums.sum += level;
      sums.pixels += 1.0;
      sums.steps += std::isfinite(last) ? (level - last) * (level - last) : 0.0;
      sums.pairs += std::isfinite(last) ? 1.0 : 0.0;
    }
    last = counts ? level : std::numeric_limits<double>::quiet_NaN();
  }
  return sums;
}

template <typename TPixel>
RunSums
SumRun(const TPixel * from, const std::uint8_t * mask, std::size_t count)
{
  if constexpr (std::is_integral_v<TPixel>)
  {
    if (mask == nullptr)
    {
      return SumIntegers(from, count);
    }
  }
  return SumUsable(from, mask, count);
}
} // namespace

bool
SceneChange::IsLarge() const
{
  return fraction > InMoments.sceneChangeFraction && ofTheLevel > InMoments.sceneChangeOfTheLevel;
}

FrameThumbnails::FrameThumbnails(const FrameGeometry &             geometry,
                                 std::size_t                       frames,
                                 const std::vector<std::uint8_t> & mask)
  : m_Pixels(geometry.Pixels())
  , m_Frames(frames)
  , m_Mask(mask)
{
  const std::size_t columns = std::min(geometry.width, InMoments.thumbnailCells);
  const std::size_t rows = std::min(geometry.height, InMoments.thumbnailCells);
  m_Cells = columns * rows;
  for (std::size_t row = 0; row < rows; ++row)
  {
    const std::size_t top = row * geometry.height / rows;
    const std::size_t height = (row + 1) * geometry.height / rows - top;
    for (std::size_t column = 0; column < columns; ++column)
    {
      for (std::size_t third = height > 1 ? 1 : 2; third <= 2; ++third)
      {
        const std::size_t line = (top + (height > 1 ? third * height / 3 : 0)) * geometry.width;
        m_Runs.push_back({ row * columns + column,
                           line + column * geometry.width / columns,
                           line + (column + 1) * geometry.width / columns });
      }
    }
  }
  m_Means.resize(m_Cells * frames, 0.0);
  m_Noise.resize(frames, 0.0);
  m_UniformFractions.resize(frames, 0.0);
}

FrameThumbnails
FrameThumbnails::Of(const std::vector<std::size_t> & frames) const
{
  FrameThumbnails chosen = *this;
  for (std::size_t k = 0; k < frames.size(); ++k)
  {
    const auto from = m_Means.begin() + static_cast<std::ptrdiff_t>(frames[k] * m_Cells);
    std::copy_n(from, m_Cells, chosen.m_Means.begin() + static_cast<std::ptrdiff_t>(k * m_Cells));
    chosen.m_Noise[k] = m_Noise[frames[k]];
    chosen.m_UniformFractions[k] = m_UniformFractions[frames[k]];
  }
  chosen.m_Frames = frames.size();
  chosen.m_Means.resize(frames.size() * m_Cells);
  chosen.m_Noise.resize(frames.size());
  chosen.m_UniformFractions.resize(frames.size());
  return chosen;
}

std::vector<double>
FrameThumbnails::PixelsOfCells() const
{
  std::vector<double> pixels(m_Cells, 0.0);
  for (const Run & run : m_Runs)
  {
    for (std::size_t p = run.begin; p < run.end; ++p)
    {
      pixels[run.cell] += m_Mask.empty() || m_Mask[p] != 0 ? 1.0 : 0.0;
    }
  }
  return pixels;
}

double
FrameThumbnails::PixelsOfCell() const
{
  const std::vector<double> pixels = this->PixelsOfCells();
  const auto                empty = std::count(pixels.begin(), pixels.end(), 0.0);
  return std::accumulate(pixels.begin(), pixels.end(), 0.0) /
         std::max(1.0, static_cast<double>(m_Cells) - static_cast<double>(empty));
}

std::vector<bool>
FrameThumbnails::FindCellsWithin(const std::vector<std::uint8_t> & mask) const
{
  std::vector<bool> areWithin(m_Cells, true);
  for (const Run & run : m_Runs)
  {
    for (std::size_t p = run.begin; p < run.end; ++p)
    {
      const bool isLookedAt = m_Mask.empty() || m_Mask[p] != 0;
      areWithin[run.cell] = areWithin[run.cell] && (!isLookedAt || mask[p] != 0);
    }
  }
  return areWithin;
}

template <typename TPixel>
void
FrameThumbnails::AddFrames(const TPixel *      frames,
                           const PixelLayout & layout,
                           std::size_t         first,
                           std::size_t         count,
                           const ParallelFor & parallelFor)
{
  parallelFor(count, [&](std::size_t k) {
    std::vector<RunSums> cells(m_Cells);
    std::vector<TPixel>  buffer;
    for (const Run & run : m_Runs)
    {
      const std::uint8_t * const mask = m_Mask.empty() ? nullptr : m_Mask.data() + run.begin;
      buffer.resize(layout.AreSideBySide() ? 0 : run.end - run.begin);
      const TPixel * const values = layout.SideBySide(frames + k * layout.frame, run.begin, run.end, buffer.data());
      cells[run.cell] += SumRun(values, mask, run.end - run.begin);
    }
    double noise = 0.0;
    double seen = 0.0;
    double even = 0.0;
    for (std::size_t i = 0; i < m_Cells; ++i)
    {
      const RunSums & cell = cells[i];
      m_Means[(first + k) * m_Cells + i] = cell.sum / cell.pixels; // NaN: no finite pixel
      if (cell.pairs > 0.0)
      {
        noise += cell.steps / (2.0 * cell.pairs * cell.pixels);
        seen += 1.0;
        even += cell.steps == 0.0 ? 1.0 : 0.0;
      }
    }
    m_Noise[first + k] = seen > 0.0 ? noise / seen : 0.0;
    m_UniformFractions[first + k] = seen > 0.0 ? even / seen : 0.0;
  });
}

void
FrameThumbnails::Save(std::ostream & out) const
{
  WriteNumbers(out, m_Means);
  WriteNumbers(out, m_Noise);
  WriteNumbers(out, m_UniformFractions);
}

FrameThumbnails
FrameThumbnails::ReadOther(std::istream & in) const
{
  FrameThumbnails other = *this;
  ReadNumbers(in, other.m_Means);
  ReadNumbers(in, other.m_Noise);
  ReadNumbers(in, other.m_UniformFractions);
  return other;
}

void
FrameThumbnails::Merge(const FrameThumbnails & other)
{
  std::transform(m_Means.begin(), m_Means.end(), other.m_Means.begin(), m_Means.begin(), std::plus<double>());
  std::transform(m_Noise.begin(), m_Noise.end(), other.m_Noise.begin(), m_Noise.begin(), std::plus<double>());
  std::transform(m_UniformFractions.begin(),
                 m_UniformFractions.end(),
                 other.m_UniformFractions.begin(),
                 m_UniformFractions.begin(),
                 std::plus<double>());
}

FrameThumbnails::MeanFrame
FrameThumbnails::FindMeanFrame(const std::vector<std::size_t> & frames) const
{
  MeanFrame mean;
  for (std::size_t cell = 0; cell < m_Cells; ++cell)
  {
    double sum = 0.0;
    for (const std::size_t t : frames)
    {
      sum += this->MeanOf(t, cell);
    }
    if (std::isfinite(sum))
    {
      mean.cells.push_back(cell);
      mean.means.push_back(sum / static_cast<double>(frames.size()));
    }
  }
  return frames.size() < MinimumFrames || mean.cells.size() < InCommon.fewestCells ? MeanFrame() : mean;
}

std::vector<double>
FrameThumbnails::MeansOf(std::size_t t, const std::vector<std::size_t> & cells) const
{
  std::vector<double> frame(cells.size());
  std::transform(
    cells.begin(), cells.end(), frame.begin(), [&](std::size_t cell) { return m_Means[t * m_Cells + cell]; });
  return frame;
}

SceneChange
FrameThumbnails::FindChange(const std::vector<std::size_t> & frames) const
{
  const auto [cells, means] = this->FindMeanFrame(frames);
  if (cells.empty())
  {
    return {};
  }
  const double level = std::abs(std::accumulate(means.begin(), means.end(), 0.0) / static_cast<double>(cells.size()));
  std::vector<double> changed;
  std::vector<double> fractions;
  for (const std::size_t t : frames)
  {
    const FrameVariances variances = VariancesOf(means, this->MeansOf(t, cells));
    changed.push_back(std::max(0.0, variances.changed - m_Noise[t]));
    fractions.push_back(variances.whole > 0.0 ? std::min(1.0, changed.back() / variances.whole) : 0.0);
  }
  return { Quantile(fractions, 0.5), level > 0.0 ? std::sqrt(Quantile(changed, 0.5)) / level : 0.0 };
}

std::vector<CellVariance>
FrameThumbnails::FindCellVariances(const std::vector<std::size_t> & frames) const
{
  const auto [cells, means] = this->FindMeanFrame(frames);
  std::vector<double> squares(cells.size(), 0.0);
  for (const std::size_t t : frames)
  {
    if (!cells.empty())
    {
      const std::vector<double> frame = this->MeansOf(t, cells);
      const FrameFit            fit = FitMostCells(means, frame);
      for (std::size_t i = 0; i < cells.size(); ++i)
      {
        squares[i] += std::pow(fit.DifferenceOf(means[i], frame[i]), 2);
      }
    }
  }
  const std::vector<double> pixels = this->PixelsOfCells();
  std::vector<std::size_t>  middle(m_Cells, 0);
  for (const Run & run : m_Runs)
  {
    middle[run.cell] = (run.begin + run.end) / 2;
  }
  std::vector<CellVariance> variances;
  for (std::size_t i = 0; i < cells.size(); ++i)
  {
    const double variance = squares[i] / (static_cast<double>(frames.size()) - 1.0);
    variances.push_back({ middle[cells[i]], pixels[cells[i]] * variance });
  }
  return variances;
}

double
FrameThumbnails::FindIlluminationChange(const std::vector<std::size_t> & frames) const
{
  const auto [cells, means] = this->FindMeanFrame(frames);
  if (cells.empty())
  {
    return 0.0;
  }
  std::vector<std::vector<double>> ofFrames;
  std::vector<double>              noise;
  for (const std::size_t t : frames)
  {
    ofFrames.push_back(this->MeansOf(t, cells));
    noise.push_back(m_Noise[t]);
  }
  return ComputeIlluminationChange(means, ofFrames, this->PixelsOfCell() * QuantileOf(std::move(noise), 0.5));
}

#define SensorNoise_INSTANTIATE(TPixel)                        \
  template SensorNoise_EXPORT void FrameThumbnails::AddFrames( \
    const TPixel *, const PixelLayout &, std::size_t, std::size_t, const ParallelFor &)
SensorNoise_FOR_PIXEL_TYPES(SensorNoise_INSTANTIATE);
#undef SensorNoise_INSTANTIATE

} // namespace sensornoise
