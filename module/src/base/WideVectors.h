// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_base_WideVectors_h
#define sensornoise_base_WideVectors_h

namespace sensornoise
{

/** Whether loops may take what this processor has beyond what every one of its kind has: on x86-64 vectors of 32 bytes,
 * not of 16. */
inline bool
HasWideVectors()
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
/** Compiled once more, together with all that function calls. The target has no fused multiplication and addition,
 * which would round differently: sums and products are the same in the same order, so the bits are. */
template <typename TFunction>
__attribute__((target("avx2"), flatten)) void
CallWithWideVectors(const TFunction & function)
{
  function();
}
#endif
} // namespace detail

/** Calls function(), a loop whose time goes into arithmetic, compiled for the processor that is there; see
 * HasWideVectors(). Same bits on each. */
template <typename TFunction>
void
WithWideVectors(const TFunction & function)
{
#if defined(__GNUC__) && defined(__x86_64__)
  if (HasWideVectors())
  {
    detail::CallWithWideVectors(function);
    return;
  }
#endif
  function();
}

} // namespace sensornoise

#endif
