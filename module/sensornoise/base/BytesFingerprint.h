// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_base_BytesFingerprint_h
#define sensornoise_base_BytesFingerprint_h

#include "SensorNoiseExport.h"
#include "sensornoise/base/Parallel.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

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

/** The fingerprints of \a count runs of \a size bytes each, stored one after the other from \a bytes on. They do not
 * depend on the number of threads, nor on which runs are asked for together. Calls visit(run, block, first byte, size)
 * for each block, in any order and possibly at the same time, when the block is in the cache. */
template <typename TVisitor>
std::vector<BytesFingerprint>
FingerprintsOf(const void * bytes, std::size_t size, std::size_t count, const ParallelFor & parallelFor, TVisitor visit)
{
  const auto * const            first = static_cast<const unsigned char *>(bytes);
  const std::size_t             blocks = (size + FingerprintBlockBytes - 1) / FingerprintBlockBytes;
  std::vector<BytesFingerprint> ofBlocks(count * blocks);
  parallelFor(ofBlocks.size(), [&](std::size_t b) {
    const std::size_t begin = b % blocks * FingerprintBlockBytes;
    const std::size_t ofBlock = std::min(FingerprintBlockBytes, size - begin);
    ofBlocks[b] = FingerprintOfBlock(first + b / blocks * size + begin, ofBlock);
    visit(b / blocks, b % blocks, begin, ofBlock);
  });
  std::vector<BytesFingerprint> fingerprints;
  for (std::size_t k = 0; k < count; ++k)
  {
    fingerprints.push_back(FingerprintOfBlocks(ofBlocks.data() + k * blocks, ofBlocks.data() + (k + 1) * blocks));
  }
  return fingerprints;
}

} // namespace sensornoise

#endif
