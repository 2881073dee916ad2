// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_pixels_PairProducts_h
#define sensornoise_pixels_PairProducts_h

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#if defined(__SSE2__) || defined(_M_X64)
#  include <emmintrin.h>
#endif

namespace sensornoise
{

/** Integer weights of two frames, |w| <= 2^20, as w = low + 2048 high: products of the halves and 16-bit values stay
 * below 2^25, so that 32 bits hold the sums over 32 frames. Each pair is there four times, as vectors need it. */
struct PairWeights
{
  static constexpr double Step = 2048.0;

  alignas(16) std::int16_t low[8]{};
  alignas(16) std::int16_t high[8]{};

  PairWeights(double first, double second)
  {
    const double weights[2] = { first, second };
    for (std::size_t k = 0; k < 8; ++k)
    {
      const double above = std::floor(weights[k % 2] / Step + 0.5);
      low[k] = static_cast<std::int16_t>(weights[k % 2] - Step * above);
      high[k] = static_cast<std::int16_t>(above);
    }
  }
};

/** Values of up to 32 frames in \a VPixels pixels: of each pair of frames the two values of a pixel lie side by side.
 */
template <std::size_t VPixels>
struct FramePairs
{
  static constexpr std::size_t MostPairs = 16;
  static_assert(VPixels % 16 == 0);

  /** Pixels that are worked on for \a pixels. */
  static constexpr std::size_t
  Padded(std::size_t pixels)
  {
    return (pixels + 15) / 16 * 16;
  }

  alignas(16) std::int16_t values[MostPairs][2 * VPixels];
};

/** The sums of low and high weights times values. */
template <std::size_t VPixels>
struct PairSumsOfPixels
{
  alignas(16) std::int32_t low[VPixels];
  alignas(16) std::int32_t high[VPixels];
};

/** Asks for memory that will be needed soon. */
template <typename TValue>
void
PrefetchValues(const TValue * values, std::size_t count)
{
#if defined(__SSE2__) || defined(_M_X64)
  constexpr std::size_t lineBytes = 64;
  for (std::size_t i = 0; i < count; i += lineBytes / sizeof(TValue))
  {
    _mm_prefetch(reinterpret_cast<const char *>(values + i), _MM_HINT_T0);
  }
#else
  static_cast<void>(values);
  static_cast<void>(count);
#endif
}

/** Sums weights times values over pairs of frames; \a pixels is a multiple of 16. */
template <std::size_t VPixels>
void
SumPairProducts(const FramePairs<VPixels> &      frames,
                const std::vector<PairWeights> & weights,
                std::size_t                      pixels,
                PairSumsOfPixels<VPixels> &      sums)
{
#if defined(__SSE2__) || defined(_M_X64)
  // One instruction multiplies eight values and adds those of a pixel; compilers do not find it by themselves.
  const auto load = [](const auto * from) { return _mm_load_si128(reinterpret_cast<const __m128i *>(from)); };
  const auto store = [](std::int32_t * to, __m128i value) { _mm_store_si128(reinterpret_cast<__m128i *>(to), value); };
  for (std::size_t i = 0; i < pixels; i += 16)
  {
    __m128i low[4] = {};
    __m128i high[4] = {};
    for (std::size_t k = 0; k < weights.size(); ++k)
    {
      const __m128i byLow = load(weights[k].low);
      const __m128i byHigh = load(weights[k].high);
      for (std::size_t n = 0; n < 4; ++n)
      {
        const __m128i values = load(frames.values[k] + 2 * i + 8 * n);
        low[n] = _mm_add_epi32(low[n], _mm_madd_epi16(values, byLow));
        high[n] = _mm_add_epi32(high[n], _mm_madd_epi16(values, byHigh));
      }
    }
    for (std::size_t n = 0; n < 4; ++n)
    {
      store(sums.low + i + 4 * n, low[n]);
      store(sums.high + i + 4 * n, high[n]);
    }
  }
#else
  for (std::size_t i = 0; i < pixels; ++i)
  {
    sums.low[i] = sums.high[i] = 0;
  }
  for (std::size_t k = 0; k < weights.size(); ++k)
  {
    const PairWeights & w = weights[k];
    for (std::size_t i = 0; i < pixels; ++i)
    {
      const std::int32_t first = frames.values[k][2 * i];
      const std::int32_t second = frames.values[k][2 * i + 1];
      sums.low[i] += first * w.low[0] + second * w.low[1];
      sums.high[i] += first * w.high[0] + second * w.high[1];
    }
  }
#endif
}

} // namespace sensornoise

#endif
