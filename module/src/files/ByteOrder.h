// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_files_ByteOrder_h
#define sensornoise_files_ByteOrder_h

#include <cstddef>
#include <cstdint>

namespace sensornoise
{

/** The number in \a count bytes, at most 8, the highest or the lowest of them first. */
inline std::uint64_t
NumberInBytes(const unsigned char * bytes, std::size_t count, bool isBigEndian)
{
  std::uint64_t number = 0;
  for (std::size_t i = 0; i < count; ++i)
  {
    number = (number << 8) | bytes[isBigEndian ? i : count - 1 - i];
  }
  return number;
}

} // namespace sensornoise

#endif
