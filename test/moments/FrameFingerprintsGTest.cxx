// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "moments/StackMoments.h"

#include <cstddef>
#include <cstdint>
#include <gtest/gtest.h>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

using namespace sensornoise;

namespace
{
using Flags = std::vector<std::uint8_t>;

/** Returns one fingerprint for each of \a names. */
std::vector<BytesFingerprint>
Of(const std::string & names)
{
  std::vector<BytesFingerprint> fingerprints;
  for (const char name : names)
  {
    fingerprints.push_back({ 1, static_cast<std::uint64_t>(name) });
  }
  return fingerprints;
}

std::vector<std::size_t>
OriginalsOf(const FrameFingerprints & fingerprints)
{
  const DistinctFrames     frames = fingerprints.FindDistinct();
  std::vector<std::size_t> originals;
  for (std::size_t t = 0; t < frames.Given(); ++t)
  {
    originals.push_back(frames.OriginalOf(t));
  }
  return originals;
}
} // namespace

TEST(SensorNoiseFrameFingerprints, AFrameIsNewIfNoneBeforeIsEqual)
{
  FrameFingerprints fingerprints(6);
  EXPECT_EQ(fingerprints.Add(0, Of("abb")), (Flags{ 1, 1, 0 }));
  EXPECT_EQ(fingerprints.Add(3, Of("cab")), (Flags{ 1, 0, 0 }));
  EXPECT_EQ(OriginalsOf(fingerprints), (std::vector<std::size_t>{ 0, 1, 1, 3, 0, 1 }));
}

TEST(SensorNoiseFrameFingerprints, TheOriginalIsTheFirstWhoeverTookItUp)
{
  const std::vector<std::size_t> expected{ 0, 1, 0, 1, 4, 0 };
  FrameFingerprints              late(6);
  late.Add(2, Of("ab"));
  FrameFingerprints early(6);
  std::stringstream stream;
  late.Save(stream);
  early.Merge(early.ReadOther(stream)); // the later frames come first
  EXPECT_EQ(early.Add(0, Of("ab")), (Flags{ 0, 0 }));
  EXPECT_EQ(early.Add(4, Of("ca")), (Flags{ 1, 0 }));
  EXPECT_EQ(OriginalsOf(early), expected);
}

TEST(SensorNoiseFrameFingerprints, FramesThatTwoHaveCountedAreNamed)
{
  FrameFingerprints one(9);
  FrameFingerprints other(9);
  one.Add(0, Of("abc"));
  other.Add(3, Of("de"));
  EXPECT_NO_THROW(one.RequireApart(other));
  other.Add(5, Of("fb"));
  try
  {
    one.RequireApart(other);
    FAIL();
  }
  catch (const std::runtime_error & error)
  {
    EXPECT_NE(std::string(error.what()).find("frame 6 equals frame 1"), std::string::npos) << error.what();
  }
  EXPECT_THROW(other.RequireApart(one), std::runtime_error);
}

TEST(SensorNoiseFrameFingerprints, FramesThatAreLeftToAnotherAreNotCounted)
{
  FrameFingerprints one(6);
  FrameFingerprints other(6);
  one.Add(0, Of("abc"));
  other.SetCountedElsewhere({ 0, 0, 0, 1, 0, 1 });
  EXPECT_EQ(other.Add(3, Of("bdb")), (Flags{ 0, 1, 0 }));
  EXPECT_THROW(other.FindDistinct(), std::logic_error); // no process has counted b
  EXPECT_NO_THROW(one.RequireApart(other));
  std::stringstream stream;
  other.Save(stream);
  one.Merge(one.ReadOther(stream));
  EXPECT_EQ(OriginalsOf(one), (std::vector<std::size_t>{ 0, 1, 2, 1, 4, 1 }));
  EXPECT_THROW(one.SetCountedElsewhere({ 0 }), std::invalid_argument);
}

TEST(SensorNoiseFrameFingerprints, StreamsThatEndEarlyOrDoNotFitAreRefused)
{
  FrameFingerprints fingerprints(3);
  fingerprints.Add(0, Of("abc"));
  std::stringstream stream;
  fingerprints.Save(stream);
  const std::string text = stream.str();
  for (const std::size_t size : { std::size_t{ 0 }, std::size_t{ 9 }, text.size() - 1 })
  {
    std::istringstream cut(text.substr(0, size));
    EXPECT_THROW(fingerprints.ReadOther(cut), std::runtime_error) << size;
  }
  EXPECT_THROW(FrameFingerprints(2).ReadOther(stream), std::runtime_error);
}
