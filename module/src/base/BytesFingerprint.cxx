// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "base/BytesFingerprint.h"

#include <algorithm>
#include <cstring>

namespace sensornoise
{

namespace
{
using Lanes = std::array<std::uint64_t, 4>;
constexpr std::size_t BytesPerRound = sizeof(Lanes);

// The primes of XXH64.
constexpr std::uint64_t Prime1 = 0x9e3779b185ebca87ULL;
constexpr std::uint64_t Prime2 = 0xc2b2ae3d27d4eb4fULL;

/** Performs one round: each lane includes its word, one to one. */
inline void
TakeIn(const unsigned char * bytes, Lanes & lanes)
{
  Lanes words;
  std::memcpy(words.data(), bytes, BytesPerRound);
  for (std::size_t i = 0; i < lanes.size(); ++i)
  {
    const std::uint64_t sum = lanes[i] + words[i] * Prime2;
    lanes[i] = ((sum << 31) | (sum >> 33)) * Prime1;
  }
}

/** Combines the lanes into two numbers, each from all lanes. */
BytesFingerprint
FingerprintOfLanes(const Lanes & lanes)
{
  const Lanes backwards{ lanes[3], lanes[2], lanes[1], lanes[0] };
  Fingerprint first;
  Fingerprint second;
  first.Add(lanes.data(), lanes.size());
  second.Add(backwards.data(), backwards.size());
  return { first.GetValue(), second.GetValue() };
}
} // namespace

BytesFingerprint
FingerprintOfBlock(const void * bytes, std::size_t size)
{
  const auto * const first = static_cast<const unsigned char *>(bytes);
  Lanes              lanes{ Prime1 + Prime2, Prime2, 0, 0 - Prime1 };
  std::size_t        i = 0;
  for (; i + BytesPerRound <= size; i += BytesPerRound)
  {
    TakeIn(first + i, lanes);
  }
  if (i < size)
  {
    std::array<unsigned char, BytesPerRound> rest{};
    std::copy(first + i, first + size, rest.begin());
    TakeIn(rest.data(), lanes);
  }
  return FingerprintOfLanes(lanes);
}

BytesFingerprint
FingerprintOfBlocks(const BytesFingerprint * begin, const BytesFingerprint * end)
{
  Fingerprint first;
  Fingerprint second;
  for (const BytesFingerprint * block = begin; block != end; ++block)
  {
    first.Add(block->data(), 1);
    second.Add(&(*block)[1], 1);
  }
  return { first.GetValue(), second.GetValue() };
}

} // namespace sensornoise
