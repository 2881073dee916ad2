// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "pixels/PairProducts.h"

#include "base/Avx2.h"

#include <cstddef>
#include <cstdint>
#include <vector>

#if defined(__GNUC__) && defined(__x86_64__)
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

inline void
AddTo(double * sums, const PairSums & products, double more, std::size_t pixels)
{
  for (std::size_t i = 0; i < pixels; ++i)
  {
    sums[i] += more + PairWeights::Step * products.high[i] + products.low[i];
  }
}

#if defined(__GNUC__) && defined(__x86_64__)
/** A single instruction multiplies sixteen values and adds the products of each pixel; compilers do not generate it. */
__attribute__((target("avx2"))) void
AddPairProductsAvx2(const FramePairs &               frames,
                    const std::vector<PairWeights> & weights,
                    double                           more,
                    std::size_t                      pixels,
                    double *                         sums)
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
auto
FindAddPairProducts()
{
#if defined(__GNUC__) && defined(__x86_64__)
  return HasAvx2() ? AddPairProductsAvx2 : AddPairProductsOneByOne;
#else
  return AddPairProductsOneByOne;
#endif
}
} // namespace

void
AddPairProductsOneByOne(const FramePairs &               frames,
                        const std::vector<PairWeights> & weights,
                        double                           more,
                        std::size_t                      pixels,
                        double *                         sums)
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

void
AddPairProducts(const FramePairs &               frames,
                const std::vector<PairWeights> & weights,
                double                           more,
                std::size_t                      pixels,
                double *                         sums)
{
  static const auto add = FindAddPairProducts();
  add(frames, weights, more, pixels, sums);
}

} // namespace sensornoise
