// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_base_BytesFingerprint_h
#define sensornoise_base_BytesFingerprint_h

#include "SensorNoiseExport.h"

#include <array>
#include <cstddef>
#include <cstdint>

namespace sensornoise
{

/** 128 bits that stand for some bytes. Other bytes have the same by chance only: among a million runs of bytes with a
 * probability of 1e-27; 3e-8 if they differ in every fourth word of 64 bits only. */
using BytesFingerprint = std::array<std::uint64_t, 2>;

/** The unit in which long runs of bytes are worked on: it stays in the cache. */
inline constexpr std::size_t FingerprintBlockBytes = 32768;

/** The fingerprint of a block of up to FingerprintBlockBytes, by the lanes and rounds of XXH64 (Y. Collet, xxHash): 10
 * GB/s a core. On a machine that is not little-endian it is another one. */
SensorNoise_EXPORT BytesFingerprint
FingerprintOfBlock(const void * bytes, std::size_t size);

/** The fingerprint of what the blocks [begin, end) are blocks of. */
SensorNoise_EXPORT BytesFingerprint
FingerprintOfBlocks(const BytesFingerprint * begin, const BytesFingerprint * end);

/** How many blocks \a size bytes have. */
inline std::size_t
NumberOfFingerprintBlocks(std::size_t size)
{
  return (size + FingerprintBlockBytes - 1) / FingerprintBlockBytes;
}

} // namespace sensornoise

#endif
