// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "base/BytesFingerprint.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <gtest/gtest.h>
#include <set>
#include <utility>
#include <vector>

using namespace sensornoise;

namespace
{
using Bytes = std::vector<unsigned char>;

Bytes
MakeBytes(std::size_t size)
{
  Bytes bytes(size);
  for (std::size_t i = 0; i < size; ++i)
  {
    bytes[i] = static_cast<unsigned char>(MixBits(i) & 0xffU);
  }
  return bytes;
}

BytesFingerprint
Find(const Bytes & bytes)
{
  std::vector<BytesFingerprint> blocks;
  for (std::size_t b = 0; b < NumberOfFingerprintBlocks(bytes.size()); ++b)
  {
    const std::size_t begin = b * FingerprintBlockBytes;
    blocks.push_back(FingerprintOfBlock(bytes.data() + begin, std::min(FingerprintBlockBytes, bytes.size() - begin)));
  }
  return FingerprintOfBlocks(blocks.data(), blocks.data() + blocks.size());
}
} // namespace

TEST(SensorNoiseBytesFingerprint, EveryBitAndEveryPlaceCounts)
{
  for (const std::size_t size : { std::size_t{ 1 }, std::size_t{ 31 }, std::size_t{ 100 }, FingerprintBlockBytes + 40 })
  {
    Bytes                   bytes = MakeBytes(size);
    std::set<std::uint64_t> first{ Find(bytes)[0] };
    std::set<std::uint64_t> second{ Find(bytes)[1] };
    std::size_t             tried = 1;
    for (std::size_t i = 0; i < size; i += size > 1000 ? 997 : 1)
    {
      for (const unsigned int bit : { 1U, 16U, 128U })
      {
        bytes[i] = static_cast<unsigned char>(bytes[i] ^ bit);
        first.insert(Find(bytes)[0]);
        second.insert(Find(bytes)[1]);
        bytes[i] = static_cast<unsigned char>(bytes[i] ^ bit);
        ++tried;
      }
    }
    EXPECT_EQ(first.size(), tried) << size;
    EXPECT_EQ(second.size(), tried) << size;
  }
}

TEST(SensorNoiseBytesFingerprint, TheOrderOfWordsAndBlocksCounts)
{
  constexpr std::size_t size = 2 * FingerprintBlockBytes;
  const Bytes           bytes = MakeBytes(size);
  for (const std::size_t shift : { std::size_t{ 8 }, std::size_t{ 32 }, FingerprintBlockBytes })
  {
    Bytes moved = bytes;
    for (std::size_t i = 0; i < 8; ++i)
    {
      std::swap(moved[i], moved[i + shift]);
    }
    EXPECT_NE(Find(moved), Find(bytes)) << shift;
  }
  EXPECT_NE(Find(Bytes(size, 0)), Find(Bytes(size / 2, 0)));
}
