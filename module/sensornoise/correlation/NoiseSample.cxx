// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/correlation/NoiseSample.h"

#include "sensornoise/base/BinaryStream.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <stdexcept>
#include <utility>

namespace sensornoise
{

namespace
{
constexpr const char * SampleName = "NoiseSample";
} // namespace

NoiseSample::NoiseSample(const FrameGeometry & geometry, std::size_t frames)
  : m_Tiles(MakeSampleTiles(geometry, frames))
  , m_Width(geometry.width)
  , m_FramePixels(geometry.Pixels())
  , m_Values(m_Tiles.origins.size() * m_Tiles.frames * m_Tiles.Pixels(), 0.0F)
{}

template <typename TPixel>
void
NoiseSample::AddFrames(const TPixel *              frames,
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
    for (std::size_t t = firstFrame; t < last; ++t)
    {
      const TPixel * frame = frames + (t - firstFrame) * m_FramePixels;
      float *        values = this->OfTile(i) + t * m_Tiles.Pixels();
      for (std::size_t row = 0; row < m_Tiles.side; ++row)
      {
        const std::size_t first = this->PixelOf(i, row * m_Tiles.side);
        for (std::size_t x = 0; x < m_Tiles.side; ++x)
        {
          const double value = static_cast<double>(frame[first + x]) - mean[first + x];
          const double finite = value - value == 0.0 ? value : 0.0; // a vector instruction, unlike std::isfinite()
          values[x] = static_cast<float>(finite);
        }
        values += m_Tiles.side;
      }
    }
  });
}

#define SensorNoise_INSTANTIATE(TPixel)                    \
  template SensorNoise_EXPORT void NoiseSample::AddFrames( \
    const TPixel *, std::size_t, std::size_t, const std::vector<double> &, const ParallelFor &)
SensorNoise_INSTANTIATE(unsigned char);
SensorNoise_INSTANTIATE(unsigned short);
SensorNoise_INSTANTIATE(short);
SensorNoise_INSTANTIATE(float);
SensorNoise_INSTANTIATE(double);
#undef SensorNoise_INSTANTIATE

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
  const std::size_t size = m_Tiles.Pixels();
  auto              to = m_Values.begin();
  for (std::size_t i = 0; i < m_Tiles.origins.size(); ++i)
  {
    for (const std::size_t t : frames)
    {
      to = std::copy_n(m_Values.begin() + static_cast<std::ptrdiff_t>((i * m_Tiles.frames + t) * size), size, to);
    }
  }
  m_Tiles.frames = frames.size();
  m_Values.resize(m_Tiles.origins.size() * frames.size() * size);
}

void
NoiseSample::Merge(const NoiseSample & other)
{
  if (other.m_Values.size() != m_Values.size() || other.m_FramePixels != m_FramePixels)
  {
    throw std::invalid_argument("samples of the noise of different stacks cannot be merged");
  }
  // A frame that is not here is 0, so that no sum is rounded.
  for (std::size_t k = 0; k < m_Values.size(); ++k)
  {
    m_Values[k] += other.m_Values[k];
  }
}

void
NoiseSample::Save(std::ostream & out) const
{
  WriteSumsHeader(out, SampleName, m_FramePixels, m_Tiles.frames);
  WriteCount(out, m_Width);
  WriteNumbers(out, m_Values);
}

void
NoiseSample::Restore(std::istream & in)
{
  NoiseSample read = *this;
  RequireCount("sampled frames", ReadSumsHeader(in, SampleName, m_FramePixels), m_Tiles.frames);
  RequireCount("columns", ReadCount(in), m_Width);
  ReadNumbers(in, read.m_Values);
  *this = std::move(read);
}

} // namespace sensornoise
