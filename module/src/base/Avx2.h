// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_base_Avx2_h
#define sensornoise_base_Avx2_h

namespace sensornoise
{

/** Returns whether loops may use AVX2: on x86-64, SIMD vectors of 32 bytes instead of 16. */
inline bool
HasAvx2()
{
#if defined(__GNUC__) && defined(__x86_64__)
  return __builtin_cpu_supports("avx2");
#else
  return false;
#endif
}

namespace detail
{
#if defined(__GNUC__) && defined(__x86_64__)
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
#if defined(__GNUC__) && defined(__x86_64__)
  if (HasAvx2())
  {
    detail::CallWithWideVectors(function);
    return;
  }
#endif
  function();
}

} // namespace sensornoise

#endif
