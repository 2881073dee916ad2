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

/** Fingerprint of some bytes, 128 bits. Two of a million different runs of bytes have the same one with a probability
 * of 1e-27, or of 3e-8 if they differ in every fourth word of 64 bits only. */
using BytesFingerprint = std::array<std::uint64_t, 2>;

/** Size of the blocks into which long runs of bytes are divided [bytes]: a block stays in the cache. */
inline constexpr std::size_t FingerprintBlockBytes = 32768;

/** Returns the fingerprint of a block of up to FingerprintBlockBytes, with the lanes and rounds of XXH64 (Y. Collet,
 * xxHash): 10 GB/s per core. On a big-endian machine it has another value. */
SensorNoise_EXPORT BytesFingerprint
FingerprintOfBlock(const void * bytes, std::size_t size);

/** Returns the fingerprint of the bytes whose blocks are [begin, end). */
SensorNoise_EXPORT BytesFingerprint
FingerprintOfBlocks(const BytesFingerprint * begin, const BytesFingerprint * end);

/** Returns the number of blocks of \a size bytes. */
inline std::size_t
NumberOfFingerprintBlocks(std::size_t size)
{
  return (size + FingerprintBlockBytes - 1) / FingerprintBlockBytes;
}

} // namespace sensornoise

#endif
