// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/base/BytesFingerprint.h"
#include "sensornoise/base/MixBits.h"
#include "helpers/StackTestHelper.h"

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <gtest/gtest.h>
#include <set>
#include <utility>
#include <vector>

using namespace sensornoise;
using namespace sensornoise::test;

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

std::vector<BytesFingerprint>
Find(const Bytes & bytes, std::size_t size, const ParallelFor & parallelFor = SerialFor)
{
  const auto ignore = [](std::size_t, std::size_t, std::size_t, std::size_t) {};
  return FingerprintsOf(bytes.data(), size, bytes.size() / size, parallelFor, ignore);
}
} // namespace

TEST(SensorNoiseBytesFingerprint, DependsNeitherOnThreadsNorOnWhatIsAskedForTogether)
{
  constexpr std::size_t size = 2 * FingerprintBlockBytes + 77;
  const Bytes           bytes = MakeBytes(5 * size);
  const auto            all = Find(bytes, size);
  EXPECT_EQ(Find(bytes, size, Threads(3)), all);
  for (std::size_t k = 0; k < 5; ++k)
  {
    const auto begin = bytes.begin() + static_cast<std::ptrdiff_t>(k * size);
    EXPECT_EQ(Find(Bytes(begin, begin + size), size).front(), all[k]) << k;
  }
}

TEST(SensorNoiseBytesFingerprint, EveryBitAndEveryPlaceCounts)
{
  for (const std::size_t size : { std::size_t{ 1 }, std::size_t{ 31 }, std::size_t{ 100 }, FingerprintBlockBytes + 40 })
  {
    Bytes                   bytes = MakeBytes(size);
    std::set<std::uint64_t> first{ Find(bytes, size)[0][0] };
    std::set<std::uint64_t> second{ Find(bytes, size)[0][1] };
    std::size_t             tried = 1;
    for (std::size_t i = 0; i < size; i += size > 1000 ? 997 : 1)
    {
      for (const unsigned int bit : { 1U, 16U, 128U })
      {
        bytes[i] = static_cast<unsigned char>(bytes[i] ^ bit);
        first.insert(Find(bytes, size)[0][0]);
        second.insert(Find(bytes, size)[0][1]);
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
    EXPECT_NE(Find(moved, size), Find(bytes, size)) << shift;
  }
  EXPECT_NE(Find(Bytes(size, 0), size), Find(Bytes(size / 2, 0), size / 2));
}

TEST(SensorNoiseBytesFingerprint, EachBlockIsVisitedOnce)
{
  constexpr std::size_t                 size = FingerprintBlockBytes + 10;
  const Bytes                           bytes = MakeBytes(3 * size);
  std::vector<std::atomic<std::size_t>> visited(bytes.size());
  FingerprintsOf(
    bytes.data(), size, 3, Threads(2), [&](std::size_t k, std::size_t b, std::size_t first, std::size_t n) {
      EXPECT_EQ(first, b * FingerprintBlockBytes);
      for (std::size_t i = 0; i < n; ++i)
      {
        ++visited[k * size + first + i];
      }
    });
  for (const auto & count : visited)
  {
    ASSERT_EQ(count, 1U);
  }
}
