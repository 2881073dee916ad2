// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_base_Prefetch_h
#define sensornoise_base_Prefetch_h

#include <cstddef>

namespace sensornoise
{

/** Prefetches memory that will be needed soon. */
template <typename TValue>
void
PrefetchValues(const TValue * values, std::size_t count)
{
#if defined(__GNUC__)
  constexpr std::size_t lineBytes = 64;
  for (std::size_t i = 0; i < count; i += lineBytes / sizeof(TValue))
  {
    __builtin_prefetch(values + i);
  }
#else
  static_cast<void>(values);
  static_cast<void>(count);
#endif
}

} // namespace sensornoise

#endif
