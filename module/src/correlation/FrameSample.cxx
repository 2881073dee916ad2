// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "correlation/FrameSample.h"

#include "base/BinaryStream.h"
#include "base/ParallelWork.h"
#include "sensornoise/FrameGeometry.h"
#include "base/Simd.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <functional>
#include <limits>
#include <map>
#include <numeric>
#include <stdexcept>
#include <type_traits>
#include <utility>
#include <vector>

namespace sensornoise
{

SampleTiles
MakeSampleTiles(const FrameGeometry & geometry, std::size_t frames)
{
  SampleTiles tiles;
  tiles.frames = std::min(frames, SampleTiles::MostFrames);
  tiles.side = SampleTiles::Side;
  if ((geometry.width / tiles.side) * (geometry.height / tiles.side) < SampleTiles::EnoughTiles)
  {
    tiles.side = SampleTiles::SmallSide;
  }
  std::size_t       columns = geometry.width / tiles.side;
  std::size_t       rows = geometry.height / tiles.side;
  const std::size_t most =
    std::min(SampleTiles::MostPixels,
             SampleTiles::MostValuesOf(geometry.Pixels()) / std::max<std::size_t>(1, tiles.frames)) /
    tiles.Pixels();
  if (columns * rows > most)
  {
    const double ratio = static_cast<double>(columns) / static_cast<double>(rows);
    const auto   square = static_cast<std::size_t>(std::sqrt(static_cast<double>(most) * ratio));
    const auto   fewer = std::clamp<std::size_t>(square, 1, std::min(columns, most));
    const auto   more = std::min(fewer + 1, std::min(columns, most));
    const auto   rowsOf = [rows, most](std::size_t across) { return std::min(rows, most / across); };
    columns = more * rowsOf(more) > fewer * rowsOf(fewer) ? more : fewer;
    rows = rowsOf(columns);
  }
  for (std::size_t j = 0; j < rows; ++j)
  {
    for (std::size_t i = 0; i < columns; ++i)
    {
      // The tile lies in the middle of its part of the frame.
      tiles.origins.push_back({ ((2 * i + 1) * geometry.width / columns - tiles.side) / 2,
                                ((2 * j + 1) * geometry.height / rows - tiles.side) / 2 });
    }
  }
  return tiles;
}

std::vector<std::vector<std::size_t>>
TilesInLine(const SampleTiles & tiles, LineAxis axis)
{
  std::map<std::size_t, std::vector<std::size_t>> lines;
  for (std::size_t i = 0; i < tiles.origins.size(); ++i)
  {
    lines[axis == LineAxis::Rows ? tiles.origins[i].y : tiles.origins[i].x].push_back(i);
  }
  std::vector<std::vector<std::size_t>> groups;
  groups.reserve(lines.size());
  for (auto & line : lines)
  {
    groups.push_back(std::move(line.second));
  }
  return groups;
}

void
NoiseSample::DropFirst(std::size_t frames)
{
  std::vector<std::size_t> left(m_Tiles.frames - frames);
  std::iota(left.begin(), left.end(), frames);
  this->KeepFrames(left);
}

void
NoiseSample::KeepFrames(const std::vector<std::size_t> & frames)
{
  if (frames.size() == m_Tiles.frames)
  {
    return;
  }
  const std::size_t size = m_Tiles.Pixels();
  float *           to = m_Values.data();
  for (std::size_t i = 0; i < m_Tiles.origins.size(); ++i)
  {
    for (const std::size_t t : frames)
    {
      to = std::copy_n(m_Values.data() + m_Tiles.PlaceOf(i, t), size, to);
    }
  }
  m_Tiles.frames = frames.size();
  m_Values.conservativeResize(static_cast<Eigen::Index>(m_Tiles.Values()));
}

namespace
{
constexpr const char * SampleName = "FrameSample";

/** Returns the value above the mean, or 0 where the difference is not finite. */
float
AboveMean(double value, double mean)
{
  const double above = value - mean;
  return static_cast<float>(above - above == 0.0 ? above : 0.0); // vectorizes, unlike std::isfinite()
}
} // namespace

FrameSample::FrameSample(const FrameGeometry & geometry,
                         std::size_t           frames,
                         bool                  isInteger,
                         double                lowest,
                         const ParallelFor &   parallelFor)
  : m_Tiles(MakeSampleTiles(geometry, frames))
  , m_Width(geometry.width)
  , m_FramePixels(geometry.Pixels())
  , m_Layout(PixelLayout::OfFrames(geometry))
  , m_Lowest(lowest)
  , m_Integers(MakeMap<std::uint16_t>(isInteger ? m_Tiles.Values() : 0, parallelFor))
  , m_Values(Eigen::ArrayXf::Zero(isInteger ? 0 : static_cast<Eigen::Index>(m_Tiles.Values())))
{}

template <typename TPixel>
void
FrameSample::AddFrames(const TPixel *              frames,
                       std::size_t                 firstFrame,
                       std::size_t                 count,
                       const std::vector<double> & mean,
                       const ParallelFor &         parallelFor)
{
  const std::size_t last = std::min(firstFrame + count, m_Tiles.frames);
  if (firstFrame >= last)
  {
    return;
  }
  parallelFor(m_Tiles.origins.size(), [&](std::size_t i) {
    std::vector<TPixel> buffer(m_Tiles.side);
    for (std::size_t t = firstFrame; t < last; ++t)
    {
      for (std::size_t row = 0; row < m_Tiles.side; ++row)
      {
        const std::size_t pixel = m_Tiles.PixelOf(i, row * m_Tiles.side, m_Width);
        const std::size_t place = m_Tiles.PlaceOf(i, t) + row * m_Tiles.side;
        const TPixel *    values =
          m_Layout.SideBySide(frames + (t - firstFrame) * m_Layout.frame, pixel, pixel + m_Tiles.side, buffer.data());
        if constexpr (std::is_integral_v<TPixel>)
        {
          std::transform(values, values + m_Tiles.side, m_Integers.data() + place, [](TPixel value) {
            return static_cast<std::uint16_t>(value - std::numeric_limits<TPixel>::lowest());
          });
        }
        else
        {
          const auto to = m_Values.data() + place;
          if (mean.empty())
          {
            std::transform(values, values + m_Tiles.side, to, [](double value) { return AboveMean(value, 0.0); });
          }
          else
          {
            std::transform(values, values + m_Tiles.side, mean.data() + pixel, to, AboveMean);
          }
        }
      }
    }
  });
}

#define SensorNoise_INSTANTIATE(TPixel)                    \
  template SensorNoise_EXPORT void FrameSample::AddFrames( \
    const TPixel *, std::size_t, std::size_t, const std::vector<double> &, const ParallelFor &)
SensorNoise_FOR_PIXEL_TYPES(SensorNoise_INSTANTIATE);
#undef SensorNoise_INSTANTIATE

void
FrameSample::Clear()
{
  std::fill(m_Integers.begin(), m_Integers.end(), std::uint16_t{ 0 });
  m_Values.setZero();
}

void
FrameSample::Merge(const FrameSample & other)
{
  if (other.m_Integers.size() != m_Integers.size() || other.m_Values.size() != m_Values.size() ||
      other.m_FramePixels != m_FramePixels)
  {
    throw std::invalid_argument("samples of different stacks cannot be merged");
  }
  // Values of frames that are missing are 0, so that no sum is rounded.
  std::transform(other.m_Integers.begin(),
                 other.m_Integers.end(),
                 m_Integers.begin(),
                 m_Integers.begin(),
                 [](std::uint16_t a, std::uint16_t b) { return static_cast<std::uint16_t>(a + b); });
  m_Values += other.m_Values;
}

void
FrameSample::Save(std::ostream & out) const
{
  WriteSumsHeader(out, SampleName, m_FramePixels, m_Tiles.frames);
  WriteCount(out, m_Width);
  WriteNumbers(out, m_Integers);
  WriteNumbers(out, m_Values.data(), static_cast<std::size_t>(m_Values.size()));
}

void
FrameSample::Restore(std::istream & in)
{
  FrameSample read = *this;
  RequireCount("sampled frames", ReadSumsHeader(in, SampleName, m_FramePixels), m_Tiles.frames);
  RequireCount("columns", ReadCount(in), m_Width);
  ReadNumbers(in, read.m_Integers);
  ReadNumbers(in, read.m_Values.data(), static_cast<std::size_t>(read.m_Values.size()));
  *this = std::move(read);
}

double
FrameSample::RepeatedFraction(const std::vector<std::uint8_t> & mask, double stepDn) const
{
  const auto step = static_cast<int>(std::max(1.0, std::round(stepDn)));
  if (m_Integers.empty())
  {
    return 0.0;
  }
  std::array<double, 3> count{}; // differences of 0, 1 and 2 steps
  double                pairs = 0.0;
  const std::size_t     pixels = m_Tiles.Pixels();
  const std::size_t     every = std::max<std::size_t>(1, m_Tiles.origins.size() / SampleTiles::EnoughTiles);
  for (std::size_t i = 0; i < m_Tiles.origins.size(); i += every)
  {
    for (std::size_t t = 1; t < m_Tiles.frames; ++t)
    {
      const std::uint16_t * const before = m_Integers.data() + m_Tiles.PlaceOf(i, t - 1);
      const std::uint16_t * const now = before + pixels;
      for (std::size_t p = 0; p < pixels; ++p)
      {
        if (mask[m_Tiles.PixelOf(i, p, m_Width)] != 0)
        {
          const int difference = std::abs(static_cast<int>(now[p]) - static_cast<int>(before[p]));
          pairs += 1.0;
          count[0] += difference == 0 ? 1.0 : 0.0;
          count[1] += difference == step ? 0.5 : 0.0; // half of the differences of either sign
          count[2] += difference == 2 * step ? 0.5 : 0.0;
        }
      }
    }
  }
  const double byNoise = count[1] * count[1] / std::max(1.0, count[2]);
  return pairs > 0.0 ? std::max(0.0, count[0] - byNoise) / pairs : 0.0;
}

namespace
{
/** Pixels of a line of a tile, each with its neighbour in the line before. */
using LinePairs = std::vector<std::pair<std::size_t, std::size_t>>;

/** Returns for each line, in one frame of a tile, whether it equals the line before it. No line does where more than
 * half of the pairs of the other lines are equal: quantization hides the noise of this frame. */
std::vector<std::uint8_t>
FindCopiedLines(const std::uint16_t * values, const std::vector<LinePairs> & lines)
{
  std::vector<std::uint8_t> isCopy(lines.size(), 0);
  std::size_t               pairs = 0;
  std::size_t               equalPairs = 0;
  for (std::size_t line = 0; line < lines.size(); ++line)
  {
    const auto equal =
      static_cast<std::size_t>(std::count_if(lines[line].begin(), lines[line].end(), [values](const auto & p) {
        return values[p.first] == values[p.second];
      }));
    isCopy[line] = equal == lines[line].size() ? 1 : 0;
    pairs += isCopy[line] != 0 ? 0 : lines[line].size();
    equalPairs += isCopy[line] != 0 ? 0 : equal;
  }
  return 2 * equalPairs < pairs ? isCopy : std::vector<std::uint8_t>(lines.size(), 0);
}
} // namespace

double
FrameSample::CopiedFraction(const std::vector<std::uint8_t> & mask, LineAxis axis) const
{
  double            all = 0.0;
  double            copies = 0.0;
  const std::size_t every = std::max<std::size_t>(1, m_Tiles.origins.size() / SampleTiles::EnoughTiles);
  for (std::size_t i = 0; i < m_Tiles.origins.size() && !m_Integers.empty(); i += every)
  {
    const auto             isTaken = [&](std::size_t p) { return mask[m_Tiles.PixelOf(i, p, m_Width)] != 0; };
    std::vector<LinePairs> lines;
    for (std::size_t line = 1; line < m_Tiles.side; ++line)
    {
      LinePairs pairs;
      for (std::size_t k = 0; k < m_Tiles.side; ++k)
      {
        const std::size_t before = m_Tiles.InTile(axis, line - 1, k);
        const std::size_t own = m_Tiles.InTile(axis, line, k);
        if (isTaken(before) && isTaken(own))
        {
          pairs.emplace_back(before, own);
        }
      }
      if (pairs.size() >= SampleTiles::SmallSide)
      {
        lines.push_back(std::move(pairs));
      }
    }
    std::vector<std::size_t> ofLines(lines.size(), 0);
    for (std::size_t t = 0; t < m_Tiles.frames; ++t)
    {
      const auto isCopy = FindCopiedLines(m_Integers.data() + m_Tiles.PlaceOf(i, t), lines);
      std::transform(isCopy.begin(), isCopy.end(), ofLines.begin(), ofLines.begin(), std::plus<std::size_t>());
    }
    for (const std::size_t count : ofLines)
    {
      const bool isOfFrames = 2 * count <= m_Tiles.frames;
      all += isOfFrames ? static_cast<double>(m_Tiles.frames) : 0.0;
      copies += isOfFrames ? static_cast<double>(count) : 0.0;
    }
  }
  return all > 0.0 ? copies / all : 0.0;
}

NoiseSample
FrameSample::TakeNoise(const std::vector<double> & mean, const ParallelFor & parallelFor)
{
  NoiseSample noise = this->StartNoise();
  parallelFor(m_Tiles.origins.size(), [&](std::size_t i) { this->FillNoise(i, mean, noise); });
  *this = FrameSample();
  return noise;
}

NoiseSample
FrameSample::StartNoise()
{
  if (m_Integers.empty())
  {
    return { m_Tiles, m_Width, std::exchange(m_Values, {}) };
  }
  Eigen::ArrayXf values(static_cast<Eigen::Index>(m_Integers.size())); // the thread that fills a tile is the first to
                                                                       // touch it
  return { m_Tiles, m_Width, std::move(values) };
}

void
FrameSample::FillNoise(std::size_t i, const std::vector<double> & mean, NoiseSample & noise) const
{
  if (m_Integers.empty())
  {
    return; // the values are above the mean already
  }
  std::vector<double> ofTile(m_Tiles.Pixels());
  std::vector<double> factors(m_Tiles.Pixels()); // 0: the pixel has no mean
  for (std::size_t p = 0; p < ofTile.size(); ++p)
  {
    const double own = mean[m_Tiles.PixelOf(i, p, m_Width)];
    factors[p] = std::isfinite(own) ? 1.0 : 0.0;
    ofTile[p] = std::isfinite(own) ? own : 0.0;
  }
  CallWithAvx2([&] {
    for (std::size_t t = 0; t < m_Tiles.frames; ++t)
    {
      const std::uint16_t * const integers = m_Integers.data() + m_Tiles.PlaceOf(i, t);
      float * const               values = noise.OfTile(i) + t * ofTile.size();
      for (std::size_t p = 0; p < ofTile.size(); ++p)
      {
        values[p] = static_cast<float>(factors[p] * (m_Lowest + integers[p] - ofTile[p]));
      }
    }
  });
}

} // namespace sensornoise
