// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "base/BinaryStream.h"

#include <algorithm>
#include <cstddef>
#include <gtest/gtest.h>
#include <istream>
#include <ostream>
#include <random>
#include <string>
#include <vector>

using namespace sensornoise;

namespace
{
/** Bytes with runs of zeros of up to 300, and of others. */
std::string
BytesWithZeros(std::size_t count)
{
  std::mt19937_64 random(7);
  std::string     bytes;
  while (bytes.size() < count)
  {
    const bool isZero = random() % 2 == 0;
    for (std::size_t left = random() % 300; left > 0; --left)
    {
      bytes += isZero ? '\0' : static_cast<char>(random());
    }
  }
  bytes.resize(count);
  return bytes;
}

/** Packed, in pieces of up to \a piece bytes. */
std::vector<unsigned char>
Pack(const std::string & bytes, std::size_t piece)
{
  ZeroRunWriter writer;
  std::ostream  out(&writer);
  for (std::size_t at = 0; at < bytes.size(); at += piece)
  {
    const std::string part = bytes.substr(at, piece);
    part.size() == 1 ? out.put(part[0]) : out.write(part.data(), static_cast<std::streamsize>(part.size()));
  }
  EXPECT_TRUE(out);
  return writer.Take();
}

/** As many bytes as come, up to \a count, in pieces. */
std::string
Unpack(const std::vector<unsigned char> & packed, std::size_t count, std::size_t piece)
{
  ZeroRunReader reader(packed.data(), packed.size());
  std::istream  in(&reader);
  std::string   bytes(count, '?');
  std::size_t   found = 0;
  while (in && found < count)
  {
    in.read(bytes.data() + found, static_cast<std::streamsize>(std::min(piece, count - found)));
    found += static_cast<std::size_t>(in.gcount());
  }
  bytes.resize(found);
  return bytes;
}
} // namespace

TEST(SensorNoiseZeroRuns, GiveBackTheBytesInAnyPieces)
{
  for (const std::size_t count : { 1, 63, 64, 65, 5000 })
  {
    const std::string bytes = BytesWithZeros(count);
    for (const std::size_t piece : { 1, 8, 61, 64, 1000, 9000 })
    {
      const auto packed = Pack(bytes, piece);
      EXPECT_EQ(packed, Pack(bytes, count)) << piece;
      EXPECT_EQ(Unpack(packed, count, piece), bytes) << piece;
    }
  }
}

TEST(SensorNoiseZeroRuns, TakeAsManyBytesAsThereAreOthers)
{
  EXPECT_EQ(Pack(std::string(1 << 20, '\0'), 4096).size(), 16u); // two counts
  EXPECT_EQ(Pack(std::string(1 << 20, 'x'), 4096).size(), (1u << 20) + 16u);
  std::string sparse(1 << 20, '\0');
  sparse[500000] = 'x';
  EXPECT_EQ(Pack(sparse, 4096).size(), 16u + 64u + 16u);
  EXPECT_TRUE(Pack("", 1).empty());
}

TEST(SensorNoiseZeroRuns, AWriterIsEmptyWhenItWasTaken)
{
  ZeroRunWriter writer;
  std::ostream  out(&writer);
  out << "one";
  writer.Take();
  EXPECT_TRUE(writer.Take().empty());
  out << "two";
  EXPECT_EQ(Unpack(writer.Take(), 3, 3), "two");
}

TEST(SensorNoiseZeroRuns, OtherBytesEndEarly)
{
  const std::string bytes = BytesWithZeros(5000);
  auto              packed = Pack(bytes, 5000);
  packed.resize(packed.size() / 2);
  const std::string found = Unpack(packed, 5000, 64);
  EXPECT_LT(found.size(), 5000u);
  EXPECT_EQ(found, bytes.substr(0, found.size()));
  EXPECT_EQ(Unpack({}, 10, 10), "");
  const std::vector<unsigned char> lies(40, 0xff); // as many blocks as fit no memory
  EXPECT_EQ(Unpack(lies, 1000, 64), std::string(1000, '\0'));
}
