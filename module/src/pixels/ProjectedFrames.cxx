// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "pixels/ProjectedFrames.h"

#include "base/PixelLayout.h"
#include "base/Quantiles.h"
#include "base/Simd.h"
#include "pixels/Constants.h"
#include "scene/InitialNoiseModel.h"
#include "scene/ReferenceFrame.h"
#include "sensornoise/FrameGeometry.h"
#include "series/SceneSeries.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <type_traits>
#include <vector>

#if defined(SENSORNOISE_AVX2)
#  include <immintrin.h>
#endif

namespace sensornoise
{

namespace
{
/** Sums of low and of high weights times values. */
struct PairSums
{
  alignas(32) std::int32_t low[FramePairs::MostPixels];
  alignas(32) std::int32_t high[FramePairs::MostPixels];
};

template <typename TSum>
inline void
AddTo(TSum * sums, const PairSums & products, TSum more, std::size_t pixels)
{
  constexpr auto step = static_cast<TSum>(PairWeights::Step);
  for (std::size_t i = 0; i < pixels; ++i)
  {
    sums[i] += more + step * static_cast<TSum>(products.high[i]) + static_cast<TSum>(products.low[i]);
  }
}

#if defined(SENSORNOISE_AVX2)
/** A single instruction multiplies sixteen values and adds the products of each pixel; compilers do not generate it. */
template <typename TSum>
__attribute__((target("avx2"))) void
AddPairProductsAvx2(const FramePairs &               frames,
                    const std::vector<PairWeights> & weights,
                    TSum                             more,
                    std::size_t                      pixels,
                    TSum *                           sums)
{
  constexpr std::size_t together = 4; // vectors, of eight pixels each
  PairSums              products{};
  for (std::size_t i = 0; i < FramePairs::Padded(pixels); i += 8 * together)
  {
    __m256i low[together] = {};
    __m256i high[together] = {};
    for (std::size_t k = 0; k < weights.size(); ++k)
    {
      const auto byLow = *reinterpret_cast<const __m256i *>(weights[k].low);
      const auto byHigh = *reinterpret_cast<const __m256i *>(weights[k].high);
      for (std::size_t n = 0; n < together; ++n)
      {
        const auto values = *reinterpret_cast<const __m256i *>(frames.values[k] + 2 * i + 16 * n);
        low[n] = _mm256_add_epi32(low[n], _mm256_madd_epi16(values, byLow));
        high[n] = _mm256_add_epi32(high[n], _mm256_madd_epi16(values, byHigh));
      }
    }
    for (std::size_t n = 0; n < together; ++n)
    {
      *reinterpret_cast<__m256i *>(products.low + i + 8 * n) = low[n];
      *reinterpret_cast<__m256i *>(products.high + i + 8 * n) = high[n];
    }
  }
  AddTo(sums, products, more, pixels);
}
#endif

/** Returns the fastest version for this processor. */
template <typename TSum>
auto
FindAddPairProducts()
{
#if defined(SENSORNOISE_AVX2)
  return HasAvx2() ? AddPairProductsAvx2<TSum> : AddPairProductsOneByOne<TSum>;
#else
  return AddPairProductsOneByOne<TSum>;
#endif
}
} // namespace

template <typename TSum>
void
AddPairProductsOneByOne(const FramePairs &               frames,
                        const std::vector<PairWeights> & weights,
                        TSum                             more,
                        std::size_t                      pixels,
                        TSum *                           sums)
{
  PairSums products{};
  for (std::size_t k = 0; k < weights.size(); ++k)
  {
    const PairWeights & w = weights[k];
    for (std::size_t i = 0; i < pixels; ++i)
    {
      const std::int32_t first = frames.values[k][2 * i];
      const std::int32_t second = frames.values[k][2 * i + 1];
      products.low[i] += first * w.low[0] + second * w.low[1];
      products.high[i] += first * w.high[0] + second * w.high[1];
    }
  }
  AddTo(sums, products, more, pixels);
}

template <typename TSum>
void
AddPairProducts(const FramePairs &               frames,
                const std::vector<PairWeights> & weights,
                TSum                             more,
                std::size_t                      pixels,
                TSum *                           sums)
{
  static const auto add = FindAddPairProducts<TSum>();
  add(frames, weights, more, pixels, sums);
}

// A type between parentheses is an expression. NOLINTBEGIN(bugprone-macro-parentheses)
#define SensorNoise_INSTANTIATE(TSum)                                                 \
  template SensorNoise_EXPORT void AddPairProducts(                                   \
    const FramePairs &, const std::vector<PairWeights> &, TSum, std::size_t, TSum *); \
  template SensorNoise_EXPORT void AddPairProductsOneByOne(                           \
    const FramePairs &, const std::vector<PairWeights> &, TSum, std::size_t, TSum *)
SensorNoise_INSTANTIATE(double);
SensorNoise_INSTANTIATE(std::uint32_t);
#undef SensorNoise_INSTANTIATE
// NOLINTEND(bugprone-macro-parentheses)

namespace
{
/** Largest number of integer frames that are added together. */
constexpr std::size_t MostTogether = 2 * FramePairs::MostPairs;

/** Offset that is subtracted from a value, so that 16 bits with a sign hold it. */
template <typename TPixel>
constexpr int Middle = std::is_same_v<TPixel, unsigned short> ? 32768 : 0;

/** Copies the values of the pixels [begin, end) of \a count frames. If the count is odd, the last frame is its own
 * partner. */
template <typename TPixel>
void
CopyPairs(const TPixel *      frames,
          const PixelLayout & layout,
          std::size_t         count,
          std::size_t         begin,
          std::size_t         end,
          FramePairs &        pairs)
{
  const std::size_t pixels = end - begin;
  for (std::size_t k = 0; 2 * k < count; ++k)
  {
    TPixel         buffers[2][FramePairs::MostPixels];
    const TPixel * frame = frames + 2 * k * layout.frame;
    const TPixel * first = layout.SideBySide(frame, begin, end, buffers[0]);
    const TPixel * second = 2 * k + 1 < count ? layout.SideBySide(frame + layout.frame, begin, end, buffers[1]) : first;
    std::int16_t * pair = pairs.values[k];
    for (std::size_t i = 0; i < pixels; ++i)
    {
      pair[2 * i] = static_cast<std::int16_t>(first[i] - Middle<TPixel>);
      pair[2 * i + 1] = static_cast<std::int16_t>(second[i] - Middle<TPixel>);
    }
    std::fill(pair + 2 * pixels, pair + 2 * FramePairs::Padded(pixels), std::int16_t{ 0 });
  }
}
} // namespace

template <typename TPixel>
ProjectedFrames<TPixel>::ProjectedFrames(const TemporalBasis & basis,
                                         const TPixel *        frames,
                                         const PixelLayout &   layout,
                                         std::size_t           firstFrame,
                                         std::size_t           count)
  : m_Basis(&basis)
  , m_Frames(frames)
  , m_Layout(layout)
  , m_First(firstFrame)
  , m_Count(count)
{
  for (std::size_t t = 0; std::is_integral_v<TPixel> && t < count; t += MostTogether)
  {
    std::vector<Weights> & weights = m_Weights.emplace_back();
    for (std::size_t j = 0; j < basis.Size(); ++j)
    {
      weights.push_back(this->WeightsOf(j, firstFrame + t, std::min(MostTogether, count - t)));
    }
  }
}

template <typename TPixel>
auto
ProjectedFrames<TPixel>::WeightsOf(std::size_t series, std::size_t first, std::size_t count) const -> Weights
{
  Weights weights;
  for (std::size_t t = 0; t < count; t += 2)
  {
    const double own = m_Basis->Rounded(first + t, series);
    const double partner = t + 1 < count ? m_Basis->Rounded(first + t + 1, series) : 0.0;
    weights.pairs.emplace_back(own, partner);
    weights.ofMiddle += Middle<TPixel> * (own + partner);
  }
  return weights;
}

template <typename TPixel>
template <typename TSum>
void
ProjectedFrames<TPixel>::AddTo(TSum * sums, std::size_t begin, std::size_t end, std::size_t ahead, const TSum * next)
  const
{
  if constexpr (std::is_integral_v<TPixel>)
  {
    this->AddTogether(sums, begin, end, ahead, next);
  }
  else if constexpr (std::is_floating_point_v<TSum>)
  {
    this->AddOneByOne(sums, begin, end);
  }
  else
  {
    throw std::logic_error("floating-point frames have no sums modulo 2^32");
  }
}

template <typename TPixel>
template <typename TSum>
void
ProjectedFrames<TPixel>::AddTogether(TSum *       sums,
                                     std::size_t  begin,
                                     std::size_t  end,
                                     std::size_t  ahead,
                                     const TSum * next) const
{
  const std::size_t series = m_Basis->Size();
  FramePairs        values{};
  for (std::size_t n = 0; n < m_Weights.size(); ++n)
  {
    const TPixel * const frames = m_Frames + n * MostTogether * m_Layout.frame;
    const std::size_t    count = std::min(MostTogether, m_Count - n * MostTogether);
    CopyPairs(frames, m_Layout, count, begin, end, values);
    for (std::size_t j = 0; j < series; ++j)
    {
      for (std::size_t t = j; t < count; t += series)
      {
        m_Layout.Prefetch(frames + t * m_Layout.frame, end, ahead);
      }
      if (n == 0 && next != nullptr)
      {
        PrefetchValues(next + j * BlockPixels, BlockPixels);
      }
      const Weights & weights = m_Weights[n][j];
      const auto      ofMiddle = static_cast<TSum>(static_cast<std::int64_t>(weights.ofMiddle));
      AddPairProducts(values, weights.pairs, ofMiddle, end - begin, sums + j * BlockPixels);
    }
  }
}

template <typename TPixel>
void
ProjectedFrames<TPixel>::AddOneByOne(double * sums, std::size_t begin, std::size_t end) const
{
  for (std::size_t t = 0; t < m_Count; ++t)
  {
    TPixel               buffer[BlockPixels];
    const TPixel * const frame = m_Layout.SideBySide(m_Frames + t * m_Layout.frame, begin, end, buffer);
    double               values[BlockPixels];
    std::copy(frame, frame + (end - begin), values);
    for (std::size_t j = 0; j < m_Basis->Size(); ++j)
    {
      const double   weight = m_Basis->Rounded(m_First + t, j);
      double * const sum = sums + j * BlockPixels;
      for (std::size_t i = 0; i < end - begin; ++i)
      {
        sum[i] += weight * values[i];
      }
    }
  }
}

#define SensorNoise_INSTANTIATE(TPixel)                                     \
  template class ProjectedFrames<TPixel>;                                   \
  template SensorNoise_EXPORT void ProjectedFrames<TPixel>::AddTo(          \
    double *, std::size_t, std::size_t, std::size_t, const double *) const; \
  template SensorNoise_EXPORT void ProjectedFrames<TPixel>::AddTo(          \
    std::uint32_t *, std::size_t, std::size_t, std::size_t, const std::uint32_t *) const
SensorNoise_FOR_PIXEL_TYPES(SensorNoise_INSTANTIATE);
#undef SensorNoise_INSTANTIATE

namespace
{
/** Returns the largest power of 2, at most TemporalBasis::Unit, whose sums are within 2^31 for pixels with the sum of
 * squares \a squaresDn2 about a whole number near the mean. The rounding lengthens a series by half the square root of
 * the number of \a frames at most. */
double
LargestUnit(double squaresDn2, double frames)
{
  constexpr double most = 2147483647.0;
  const double     norm = most / std::sqrt(squaresDn2) - 0.5 * std::sqrt(frames) - 1.0;
  return norm < 1.0 ? 0.0 : std::min(TemporalBasis::Unit, std::exp2(std::floor(std::log2(norm))));
}
} // namespace

std::optional<double>
UnitOfNarrowSums(const ReferenceFrame & frame, const InitialNoiseModel & model, const ParallelFor & parallelFor)
{
  const auto       frames = static_cast<double>(frame.frames);
  const auto       isUsable = [&frame](std::size_t p) { return frame.usable[p] != 0; };
  const auto       varianceOf = [&frame](std::size_t p) { return frame.variance[p]; };
  const ValueRange variances = RangeOverPixels(frame.usable.size(), parallelFor, isUsable, varianceOf);
  if (variances.values == 0)
  {
    return std::nullopt;
  }
  const auto sums =
    SumOverBlocks<1>(frame.usable.size(), parallelFor, [&](std::size_t p, std::array<double, 1> & ratios) {
      ratios[0] += isUsable(p) ? frame.variance[p] / model.NoiseVariance(frame.mean[p]) : 0.0;
    });
  const auto   pixels = static_cast<double>(variances.values);
  const double unit = LargestUnit((frames - 1.0) * variances.highest + frames, frames);
  // The error of a rounded number is uniform, with the variance 1/12.
  const double left = (frames - 1.0) * sums[0] / pixels / (12.0 * unit * unit);
  const double standardError = std::sqrt(2.0 / (frames * pixels));
  return left <= InPixels.largestRoundingError * standardError ? std::optional(unit) : std::nullopt;
}

bool
IsSingleEnough(const ReferenceFrame & frame, const InitialNoiseModel & model)
{
  const std::vector<std::size_t> pixels = SamplePixels(frame.usable);
  double                         squares = 0.0;
  for (const std::size_t p : pixels)
  {
    const double ratio = frame.variance[p] / model.NoiseVariance(frame.mean[p]);
    squares += ratio * ratio;
  }
  // A rounded number has an error that is uniform, of at most 2^-24 of the number.
  const double left = squares / static_cast<double>(std::max<std::size_t>(1, pixels.size())) * std::exp2(-48.0) / 3.0;
  const double standardError = std::sqrt(2.0 / static_cast<double>(frame.frames));
  return std::sqrt(left) <= InPixels.largestRoundingError * standardError;
}

} // namespace sensornoise
