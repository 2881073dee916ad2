// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_base_BytesFingerprint_h
#define sensornoise_base_BytesFingerprint_h

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <type_traits>
#include <vector>

namespace sensornoise
{

/** Scrambles 64 bits one to one (finaliser of SplitMix64: Steele, Lea and Flood, OOPSLA 2014,
 * DOI 10.1145/2660193.2660195). */
inline std::uint64_t
MixBits(std::uint64_t bits)
{
  bits = (bits ^ (bits >> 30)) * 0xbf58476d1ce4e5b9ULL;
  bits = (bits ^ (bits >> 27)) * 0x94d049bb133111ebULL;
  return bits ^ (bits >> 31);
}

/** \class Fingerprint
 * \brief Number from which it is decided whether two processes continue from the same data, bit by bit; all NaN are
 * equal. */
class Fingerprint
{
public:
  template <typename TNumber>
  void
  Add(const TNumber * numbers, std::size_t count)
  {
    for (std::size_t i = 0; i < count; ++i)
    {
      TNumber number = numbers[i];
      if constexpr (std::is_floating_point_v<TNumber>)
      {
        number = std::isnan(number) ? std::numeric_limits<TNumber>::quiet_NaN() : number;
      }
      std::uint64_t bits = 0;
      std::memcpy(&bits, &number, sizeof(number));
      m_Value = MixBits((m_Value ^ bits) + 0x9e3779b97f4a7c15ULL); // the golden ratio, so that zeros change the value
    }
  }
  std::uint64_t
  GetValue() const
  {
    return m_Value;
  }

private:
  std::uint64_t m_Value{ 0 };
};

/** Fingerprint of some bytes, 128 bits. Two of a million different runs of bytes have the same one with a probability
 * of 1e-27, or of 3e-8 if they differ in every fourth word of 64 bits only. */
using BytesFingerprint = std::array<std::uint64_t, 2>;

/** \class FingerprintLanes
 * \brief Lanes of XXH64. Each lane includes every fourth word of 64 bits. */
class FingerprintLanes
{
public:
  static constexpr std::size_t BytesPerRound = 32;

  /** Performs one round: each lane includes its word, one to one. */
  void
  Add(const unsigned char * bytes)
  {
    Lanes words;
    std::memcpy(words.data(), bytes, BytesPerRound);
    for (std::size_t i = 0; i < m_Lanes.size(); ++i)
    {
      const std::uint64_t sum = m_Lanes[i] + words[i] * Prime2;
      m_Lanes[i] = ((sum << 31) | (sum >> 33)) * Prime1;
    }
  }

  /** Combines the lanes into two numbers, each from all lanes. */
  BytesFingerprint
  GetValue() const
  {
    const Lanes backwards{ m_Lanes[3], m_Lanes[2], m_Lanes[1], m_Lanes[0] };
    Fingerprint first;
    Fingerprint second;
    first.Add(m_Lanes.data(), m_Lanes.size());
    second.Add(backwards.data(), backwards.size());
    return { first.GetValue(), second.GetValue() };
  }

private:
  using Lanes = std::array<std::uint64_t, 4>;
  static_assert(sizeof(Lanes) == BytesPerRound);

  // The primes of XXH64.
  static constexpr std::uint64_t Prime1 = 0x9e3779b185ebca87ULL;
  static constexpr std::uint64_t Prime2 = 0xc2b2ae3d27d4eb4fULL;

  Lanes m_Lanes{ Prime1 + Prime2, Prime2, 0, 0 - Prime1 };
};

/** Size of the blocks into which long runs of bytes are divided [bytes]: a block stays in the cache. */
inline constexpr std::size_t FingerprintBlockBytes = 32768;

/** Returns the fingerprint of a block of up to FingerprintBlockBytes, with the lanes and rounds of XXH64 (Y. Collet,
 * xxHash): 10 GB/s per core. On a big-endian machine it has another value. */
inline BytesFingerprint
FingerprintOfBlock(const void * bytes, std::size_t size)
{
  const auto * const first = static_cast<const unsigned char *>(bytes);
  FingerprintLanes   lanes;
  std::size_t        i = 0;
  for (; i + FingerprintLanes::BytesPerRound <= size; i += FingerprintLanes::BytesPerRound)
  {
    lanes.Add(first + i);
  }
  if (i < size)
  {
    std::array<unsigned char, FingerprintLanes::BytesPerRound> rest{};
    std::copy(first + i, first + size, rest.begin());
    lanes.Add(rest.data());
  }
  return lanes.GetValue();
}

/** Returns the fingerprint of the bytes whose blocks are [begin, end). */
inline BytesFingerprint
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

/** Returns the number of blocks of \a size bytes. */
inline std::size_t
NumberOfFingerprintBlocks(std::size_t size)
{
  return (size + FingerprintBlockBytes - 1) / FingerprintBlockBytes;
}

/** Returns the fingerprint of \a size bytes, block by block. */
inline BytesFingerprint
FingerprintOfBytes(const void * bytes, std::size_t size)
{
  const auto * const            first = static_cast<const unsigned char *>(bytes);
  std::vector<BytesFingerprint> blocks(NumberOfFingerprintBlocks(size));
  for (std::size_t i = 0; i < blocks.size(); ++i)
  {
    const std::size_t begin = i * FingerprintBlockBytes;
    blocks[i] = FingerprintOfBlock(first + begin, std::min(FingerprintBlockBytes, size - begin));
  }
  return FingerprintOfBlocks(blocks.data(), blocks.data() + blocks.size());
}

} // namespace sensornoise

#endif
