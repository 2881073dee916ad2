// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "base/BinaryStream.h"
#include "moments/TemporalMoments.h"
#include "pixels/ProjectionSums.h"
#include "series/FrameSums.h"

#include <cmath>
#include <cstddef>
#include <gtest/gtest.h>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

using namespace sensornoise;

TEST(SensorNoiseSealedSums, BytesComeBackWhole)
{
  std::vector<unsigned char> sums(100001);
  for (std::size_t i = 0; i < sums.size(); ++i)
  {
    sums[i] = static_cast<unsigned char>(i * i % 251);
  }
  std::vector<unsigned char> sealed = SealSums(sums.data(), sums.size(), "1.2.3");
  ASSERT_EQ(sealed.size(), SumsSealBytes);
  sealed.insert(sealed.end(), sums.begin(), sums.end());
  const UnsealedSums found = UnsealSums(sealed.data(), sealed.size(), "1.2.3");
  EXPECT_EQ(std::vector<unsigned char>(found.bytes, found.bytes + found.size), sums);

  const auto errorOf = [](const std::vector<unsigned char> & bytes, std::size_t size, const std::string & version) {
    try
    {
      UnsealSums(bytes.data(), size, version);
    }
    catch (const std::runtime_error & error)
    {
      return std::string(error.what());
    }
    return std::string();
  };
  for (const std::size_t size : { sealed.size() - 1, sealed.size() / 2, SumsSealBytes })
  {
    EXPECT_NE(errorOf(sealed, size, "1.2.3").find("incomplete"), std::string::npos) << size;
  }
  EXPECT_NE(errorOf(sealed, SumsSealBytes - 1, "1.2.3").find("do not begin as sums do"), std::string::npos);
  EXPECT_NE(errorOf(sums, sums.size(), "1.2.3").find("do not begin as sums do"), std::string::npos);
  const std::string other = errorOf(sealed, sealed.size(), "1.3.0");
  EXPECT_NE(other.find("of module 1.2.3"), std::string::npos) << other;
  EXPECT_NE(other.find("of module 1.3.0"), std::string::npos) << other;
  for (const std::size_t at : { SumsSealBytes, SumsSealBytes + 50000, sealed.size() - 1 })
  {
    std::vector<unsigned char> damaged = sealed;
    damaged[at] ^= 1;
    EXPECT_NE(errorOf(damaged, damaged.size(), "1.2.3").find("damaged"), std::string::npos) << at;
  }
  sealed.push_back(0);
  EXPECT_NE(errorOf(sealed, sealed.size(), "1.2.3").find("too long"), std::string::npos);
}

namespace
{
constexpr std::size_t Pixels = 37;
constexpr std::size_t Frames = 5;

/** Returns any sums, of \a pixels pixels. */
template <typename TSums>
TSums
Make(std::size_t pixels);

template <typename TMoments, typename TPixel>
TMoments
MakeMoments(std::size_t pixels)
{
  TMoments            moments(pixels);
  std::vector<TPixel> frames(pixels * Frames);
  for (std::size_t i = 0; i < frames.size(); ++i)
  {
    frames[i] = static_cast<TPixel>(i * i % 101);
  }
  moments.AddFrames(frames.data(), pixels, Frames, 0, pixels);
  moments.AdvanceFrames(Frames);
  return moments;
}
template <>
IntegerMoments<unsigned short>
Make(std::size_t pixels)
{
  return MakeMoments<IntegerMoments<unsigned short>, unsigned short>(pixels);
}
template <>
IntegerMoments<signed char>
Make(std::size_t pixels)
{
  return MakeMoments<IntegerMoments<signed char>, signed char>(pixels);
}
template <>
FloatingMoments<float>
Make(std::size_t pixels)
{
  return MakeMoments<FloatingMoments<float>, float>(pixels);
}
template <>
FloatingMoments<double>
Make(std::size_t pixels)
{
  return MakeMoments<FloatingMoments<double>, double>(pixels);
}
template <>
ProjectionSums
Make(std::size_t pixels)
{
  ProjectionSums sums(pixels, 3);
  for (std::size_t i = 0; i < pixels * 3; ++i)
  {
    sums.At(i / 3, i % 3) = std::sqrt(static_cast<double>(i));
  }
  return sums;
}
template <>
FrameProducts
Make(std::size_t pixels)
{
  FrameProducts products(pixels, Frames, 2);
  for (std::size_t t = 0; t < Frames; ++t)
  {
    const double x = std::sqrt(static_cast<double>(t + pixels));
    products.OfClass(t, t % GradientClasses).setLinSpaced(x, 7.0);
    products.OfInstruments(t, t % FrameProducts::Blocks) = { -x, 1.0 / 3.0 };
    products.OfCell(t, t % 2) = { x / 7.0, 1e-300 };
  }
  return products;
}

template <typename TSums>
std::string
Saved(const TSums & sums)
{
  std::ostringstream out;
  sums.Save(out);
  return out.str();
}

/** Returns the error of Restore(); "": none. */
template <typename TSums>
std::string
RestoreComplaint(TSums & sums, const std::string & stream)
{
  std::istringstream in(stream);
  try
  {
    sums.Restore(in);
  }
  catch (const std::runtime_error & error)
  {
    return error.what();
  }
  return "";
}

bool
Has(const std::string & text, const std::string & part)
{
  return text.find(part) != std::string::npos;
}
} // namespace

template <typename TSums>
class SensorNoiseBinaryStream : public ::testing::Test
{};
using SumsTypes = ::testing::Types<IntegerMoments<unsigned short>,
                                   IntegerMoments<signed char>,
                                   FloatingMoments<float>,
                                   FloatingMoments<double>,
                                   ProjectionSums,
                                   FrameProducts>;
TYPED_TEST_SUITE(SensorNoiseBinaryStream, SumsTypes);

TYPED_TEST(SensorNoiseBinaryStream, RestoredSumsAreTheSavedOnes)
{
  const auto        sums = Make<TypeParam>(Pixels);
  const std::string saved = Saved(sums);
  auto              restored = sums; // it has the same sizes, and Merge() doubles its numbers
  restored.Merge(sums);
  ASSERT_NE(Saved(restored), saved);
  EXPECT_EQ(RestoreComplaint(restored, saved), "");
  EXPECT_EQ(Saved(restored), saved);
}

TYPED_TEST(SensorNoiseBinaryStream, SumsMayFollowEachOther)
{
  const auto         sums = Make<TypeParam>(Pixels);
  std::istringstream in(Saved(sums) + Saved(sums) + "?");
  auto               restored = sums;
  restored.Restore(in);
  restored.Restore(in);
  EXPECT_EQ(Saved(restored), Saved(sums));
  EXPECT_EQ(in.get(), '?');
}

TYPED_TEST(SensorNoiseBinaryStream, StreamsThatEndEarlyAreRefusedAndChangeNothing)
{
  auto              sums = Make<TypeParam>(Pixels);
  const std::string saved = Saved(sums);
  for (std::size_t size = 0; size < saved.size(); size += size < 60 ? 1 : 97)
  {
    EXPECT_TRUE(Has(RestoreComplaint(sums, saved.substr(0, size)), "ends early: found")) << size;
  }
  EXPECT_EQ(Saved(sums), saved);
}

TYPED_TEST(SensorNoiseBinaryStream, OtherSumsAreRefusedByName)
{
  auto        sums = Make<TypeParam>(Pixels);
  const auto  saved = Saved(sums);
  const auto  name = saved.substr(0, saved.find('\0'));
  std::size_t others = 0;
  for (const std::string & other : { Saved(Make<IntegerMoments<unsigned short>>(Pixels)),
                                     Saved(Make<IntegerMoments<signed char>>(Pixels)),
                                     Saved(Make<FloatingMoments<float>>(Pixels)),
                                     Saved(Make<FloatingMoments<double>>(Pixels)),
                                     Saved(Make<ProjectionSums>(Pixels)),
                                     Saved(Make<FrameProducts>(Pixels)),
                                     std::string("P5 640 480 255\n") + std::string(99, '\1') })
  {
    if (other != saved)
    {
      const std::string complaint = RestoreComplaint(sums, other);
      EXPECT_TRUE(Has(complaint, "found \"" + other.substr(0, 5))) << complaint;
      EXPECT_TRUE(Has(complaint, "expected \"" + name + "\"")) << complaint;
      ++others;
    }
  }
  EXPECT_EQ(others, 6u);
  EXPECT_EQ(Saved(sums), saved);
}

TYPED_TEST(SensorNoiseBinaryStream, OtherSizesAndVersionsAreRefused)
{
  auto sums = Make<TypeParam>(Pixels);
  EXPECT_TRUE(Has(RestoreComplaint(sums, Saved(Make<TypeParam>(38))), "found 38 pixels, expected 37"));
  EXPECT_THROW(sums.Merge(Make<TypeParam>(38)), std::invalid_argument);
  std::string other = Saved(sums);
  other[32] = static_cast<char>(SumsVersion + 1); // the lowest byte of the version comes first
  EXPECT_TRUE(Has(RestoreComplaint(sums, other),
                  "found " + std::to_string(SumsVersion + 1) + ", expected " + std::to_string(SumsVersion)));
}

TEST(SensorNoiseBinaryStreamOfNumbers, StreamThatTakesNothingIsAnError)
{
  std::ostringstream out;
  out.setstate(std::ios::badbit);
  EXPECT_THROW(WriteCount(out, 7), std::runtime_error);
}

TEST(SensorNoiseBinaryStreamOfNumbers, OtherNumbersOfSeriesFramesAndCellsAreRefused)
{
  ProjectionSums sums(Pixels, 3);
  EXPECT_TRUE(Has(RestoreComplaint(sums, Saved(ProjectionSums(Pixels, 4))), "found 4 series, expected 3"));
  FrameProducts products(Pixels, Frames, 2);
  EXPECT_TRUE(Has(RestoreComplaint(products, Saved(FrameProducts(Pixels, 6, 2))), "found 6 frames, expected 5"));
  EXPECT_TRUE(Has(RestoreComplaint(products, Saved(FrameProducts(Pixels, Frames, 3))), "found 3 cells, expected 2"));
}

TEST(SensorNoiseBinaryStreamOfNumbers, FingerprintKnowsEveryBitButOneNaNFromAnother)
{
  const auto of = [](std::vector<double> numbers) {
    Fingerprint fingerprint;
    fingerprint.Add(numbers.data(), numbers.size());
    return fingerprint.GetValue();
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double tiny = std::numeric_limits<double>::epsilon();
  EXPECT_EQ(of({ 1.0, nan, 3.0 }), of({ 1.0, -nan, 3.0 }));
  EXPECT_NE(of({ 1.0, 2.0 }), of({ 1.0 + tiny, 2.0 }));
  EXPECT_NE(of({ 1.0, 2.0 }), of({ 2.0, 1.0 }));
  EXPECT_NE(of({ 0.0 }), of({ 0.0, 0.0 }));
}
