// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_base_Simd_h
#define sensornoise_base_Simd_h

#include <algorithm>
#include <array>
#include <cstddef>

// Defined where the compiler can make AVX2 code of single functions. The other compilers, and with
// SENSORNOISE_PLAIN_LOOPS every compiler, get loops without it, which return the same bits.
#if defined(__GNUC__) && defined(__x86_64__) && !defined(SENSORNOISE_PLAIN_LOOPS)
#  define SENSORNOISE_AVX2
#endif

namespace sensornoise
{

/** Returns whether loops may use AVX2: on x86-64, SIMD vectors of 32 bytes instead of 16. */
inline bool
HasAvx2()
{
#if defined(SENSORNOISE_AVX2)
  return __builtin_cpu_supports("avx2");
#else
  return false;
#endif
}

namespace detail
{
#if defined(SENSORNOISE_AVX2)
/** Calls function() and all functions that it calls, compiled for AVX2. The target has no fused multiplication and
 * addition, which would round differently: sums and products are the same, in the same order, and so are the bits. */
template <typename TFunction>
__attribute__((target("avx2"), flatten)) void
CallWithWideVectors(const TFunction & function)
{
  function();
}
#endif
} // namespace detail

/** Calls function(), a loop whose time is spent in arithmetic, compiled for the SIMD instructions of the processor; see
 * HasAvx2(). The bits are the same on all processors. */
template <typename TFunction>
void
CallWithAvx2(const TFunction & function)
{
#if defined(SENSORNOISE_AVX2)
  if (HasAvx2())
  {
    detail::CallWithWideVectors(function);
    return;
  }
#endif
  function();
}

/** Number of pixels of a run, which are processed together with SIMD, so that intermediate results stay in the caches.
 */
inline constexpr std::size_t PixelsPerRun = 512;

/** One number for each pixel of a run. */
using RunValues = std::array<double, PixelsPerRun>;

/** Calls function(first, pixels) for the runs of the pixels [begin, end), one after the other. */
template <typename TFunction>
void
ForRuns(std::size_t begin, std::size_t end, TFunction function)
{
  for (std::size_t first = begin; first < end; first += PixelsPerRun)
  {
    function(first, std::min(PixelsPerRun, end - first));
  }
}

/** Returns the sum of term(i) for i = 0 ... count - 1, in four lanes for SIMD. */
template <typename TTerm>
double
SumOfRun(std::size_t count, TTerm term)
{
  constexpr std::size_t lanes = 4;
  double                sums[lanes] = {};
  std::size_t           i = 0;
  for (; i + lanes <= count; i += lanes)
  {
    for (std::size_t lane = 0; lane < lanes; ++lane)
    {
      sums[lane] += term(i + lane);
    }
  }
  for (; i < count; ++i)
  {
    sums[i % lanes] += term(i);
  }
  return (sums[0] + sums[1]) + (sums[2] + sums[3]);
}

/** Number of frames that the second pass multiplies together, at the cost of one: their sums fill the SIMD registers.
 * At least this number of frames is passed on at a time, for any size of frames. */
inline constexpr std::size_t FramesTogether = 4;

} // namespace sensornoise

#endif
