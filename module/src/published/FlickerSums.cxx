// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "published/Flicker.h"

#include "base/BinaryStream.h"
#include "base/Simd.h"
#include "sensornoise/FrameGeometry.h"
#include "base/PixelLayout.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <functional>
#include <istream>
#include <ostream>
#include <vector>

namespace sensornoise
{

FlickerSums::WeightedPixels::WeightedPixels(const IsoIntensitySet & set, const double * mean)
  : pixels(set.pixels)
  , weights(set.weights)
  , effectivePixels(set.EffectivePixels())
{
  for (const std::uint32_t p : pixels)
  {
    means.push_back(mean[p]);
  }
}

template <typename TPixel, typename TValue, typename TFunction>
void
FlickerSums::WeightedPixels::ForRunsOf(const TPixel * frame, TValue value, TFunction function) const
{
  ForRuns(0, pixels.size(), [&](std::size_t first, std::size_t count) {
    RunValues values{};
    // Number of pixels of the next run, which are prefetched.
    const std::size_t ahead = std::min(count, pixels.size() - first - count);
    for (std::size_t i = 0; i < count; ++i)
    {
      values[i] = static_cast<double>(frame[pixels[first + i]]);
      if (i < ahead)
      {
        PrefetchValues(frame + pixels[first + count + i], 1);
      }
    }
    CallWithAvx2([&] {
      std::transform(values.data(), values.data() + count, means.data() + first, values.data(), value);
      function(first, count, values);
    });
  });
}

template <typename TPixel, typename TValue>
void
FlickerSums::WeightedPixels::Average(const TPixel * frame, TValue value, double & average, double & spread) const
{
  average = 0.0;
  double squares = 0.0;
  this->ForRunsOf(frame, value, [&](std::size_t first, std::size_t count, const RunValues & values) {
    const double * const weight = weights.data() + first;
    average += SumOfRun(count, [&](std::size_t i) { return weight[i] * values[i]; });
    squares += SumOfRun(count, [&](std::size_t i) { return weight[i] * values[i] * values[i]; });
  });
  spread = squares - average * average;
}

double
FlickerSums::WeightedPixels::NoiseOfAverage(const std::vector<double> & spreads) const
{
  double sum = 0.0;
  for (const double spread : spreads)
  {
    sum += spread;
  }
  return std::max(0.0, sum / static_cast<double>(spreads.size()) / (effectivePixels - 1.0));
}

FlickerSums::FlickerSums(const IsoIntensitySet & bright,
                         const IsoIntensitySet & dark,
                         const double *          mean,
                         const FrameGeometry &   geometry,
                         std::size_t             frames,
                         const IsoIntensitySet & rowSet)
  : m_Frames(frames)
  , m_Width(geometry.width)
  , m_Rows(rowSet.pixels.empty() ? 0 : geometry.Rows())
  , m_BrightRatios(frames, 0.0)
  , m_DarkResiduals(frames, 0.0)
  , m_BrightVariances(frames, 0.0)
  , m_DarkVariances(frames, 0.0)
  , m_RowSums(frames * m_Rows, 0.0)
  , m_RowWeights(m_Rows, 0.0)
  , m_Bright(bright, mean)
  , m_Dark(dark, mean)
  , m_RowSet(rowSet, mean)
{
  for (std::size_t i = 0; i < rowSet.pixels.size(); ++i)
  {
    m_RowOf.push_back(static_cast<std::uint32_t>(geometry.RowOf(rowSet.pixels[i])));
    m_RowWeights[m_RowOf[i]] += rowSet.weights[i];
  }
}

void
FlickerSums::SetLayout(const PixelLayout & layout)
{
  for (WeightedPixels * const set : { &m_Bright, &m_Dark, &m_RowSet })
  {
    for (std::uint32_t & p : set->pixels)
    {
      p = static_cast<std::uint32_t>(layout.At(p % m_Width, p / m_Width));
    }
  }
}

template <typename TPixel>
void
FlickerSums::AddFrame(const TPixel * frame, std::size_t t)
{
  const auto ratio = [](double u, double mean) { return u / mean; };
  m_Bright.Average(frame, ratio, m_BrightRatios[t], m_BrightVariances[t]);
  const double brightness = m_BrightRatios[t];
  const auto   residual = [brightness](double u, double mean) { return u - brightness * mean; };
  m_Dark.Average(frame, residual, m_DarkResiduals[t], m_DarkVariances[t]);

  double * const rows = m_RowSums.data() + t * m_Rows;
  m_RowSet.ForRunsOf(frame, ratio, [&](std::size_t first, std::size_t count, const RunValues & values) {
    std::size_t row = m_RowOf[first];
    double      sum = rows[row]; // sum of the row of consecutive pixels
    for (std::size_t i = 0; i < count; ++i)
    {
      if (m_RowOf[first + i] != row)
      {
        rows[row] = sum;
        row = m_RowOf[first + i];
        sum = rows[row];
      }
      sum += m_RowSet.weights[first + i] * values[i];
    }
    rows[row] = sum;
  });
}

void
FlickerSums::Forget()
{
  for (std::vector<double> * const sums : this->OfFrames())
  {
    std::fill(sums->begin(), sums->end(), 0.0);
  }
}

void
FlickerSums::Save(std::ostream & out) const
{
  for (const auto * const sums :
       { &m_BrightRatios, &m_DarkResiduals, &m_BrightVariances, &m_DarkVariances, &m_RowSums })
  {
    WriteNumbers(out, *sums);
  }
}

void
FlickerSums::Merge(std::istream & in)
{
  const std::array<std::vector<double> *, 5> mine = this->OfFrames();
  std::array<std::vector<double>, 5>         others;
  for (std::size_t i = 0; i < mine.size(); ++i)
  {
    others[i].resize(mine[i]->size());
    ReadNumbers(in, others[i]);
  }
  for (std::size_t i = 0; i < mine.size(); ++i)
  {
    std::transform(mine[i]->begin(), mine[i]->end(), others[i].begin(), mine[i]->begin(), std::plus<double>());
  }
}

#define SensorNoise_INSTANTIATE(TPixel) \
  template SensorNoise_EXPORT void FlickerSums::AddFrame<TPixel>(const TPixel *, std::size_t)
SensorNoise_FOR_PIXEL_TYPES(SensorNoise_INSTANTIATE);
#undef SensorNoise_INSTANTIATE

} // namespace sensornoise
