// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/MosaicMethod.h"

#include "sensornoise/Report.h"
#include "mosaic/MosaicPasses.h"
#include "published/PublishedPasses.h"
#include "refined/RefinedPasses.h"
#include "sensornoise/ReportText.h"
#include "helpers/StackTestHelper.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <gtest/gtest.h>
#include <limits>
#include <optional>
#include <stdexcept>
#include <type_traits>
#include <utility>
#include <vector>

/** \file
 * The results of a method on the planes of a mosaic have the same bits as its results on each plane alone. */

using namespace sensornoise;
using namespace sensornoise::test;
using Pixel = unsigned short;

namespace
{
Stack<Pixel>
SimulateMosaic(BayerPattern pattern, std::size_t width, std::size_t height)
{
  SimulationSettings settings = FlickeringSettings(24);
  settings.flaws.filters.pattern = pattern;
  return Simulate<Pixel>(settings, width, height);
}

template <typename TMethod>
using SettingsOf =
  std::conditional_t<std::is_same_v<TMethod, RefinedPasses<Pixel>>, RefinedSettings, PublishedSettings>;

template <typename TMethod>
TMethod
MakeMethod(const FrameGeometry &             frame,
           std::size_t                       frames,
           const std::vector<std::uint8_t> & mask,
           ParallelFor                       parallelFor,
           const SettingsOf<TMethod> &       settings = {})
{
  return TMethod(settings, frame, frames, mask, std::move(parallelFor));
}

/** Runs a method through its passes, \a chunk frames at a time. */
template <typename TMethod>
void
RunPasses(TMethod & method, const Stack<Pixel> & stack, std::size_t chunk)
{
  while (!method.IsDone())
  {
    for (std::size_t t = 0; t < stack.frames; t += chunk)
    {
      method.AddFrames(stack.Frame(t), std::min(chunk, stack.frames - t));
    }
    method.EndPass();
  }
}

/** Returns the results of the method for one plane of \a stack. */
template <typename TMethod>
void
RunOnPlane(TMethod & method, const Stack<Pixel> & stack, const MosaicGeometry & geometry, BayerPlane plane)
{
  Stack<Pixel> alone{ geometry.Plane().width, geometry.Plane().height, stack.frames, {} };
  for (std::size_t t = 0; t < stack.frames; ++t)
  {
    const auto frame =
      geometry.Take(std::vector<Pixel>(stack.Frame(t), stack.Frame(t) + geometry.frame.Pixels()), plane);
    alone.pixels.insert(alone.pixels.end(), frame.begin(), frame.end());
  }
  RunPasses(method, alone, stack.frames);
}

template <typename TMethod>
class MosaicMethodOf : public ::testing::Test
{};
using Methods = ::testing::Types<RefinedPasses<Pixel>, PublishedPasses<Pixel>>;
TYPED_TEST_SUITE(MosaicMethodOf, Methods, );
} // namespace

TYPED_TEST(MosaicMethodOf, FindsOfEachPlaneWhatItFindsOfItAlone)
{
  for (const BayerPattern pattern : { BayerPattern::RGGB, BayerPattern::GBRG })
  {
    const Stack<Pixel>   stack = SimulateMosaic(pattern, 97, 90); // the last column is in no plane
    const MosaicGeometry geometry{ { stack.width, stack.height, 1 }, pattern };
    ASSERT_EQ(geometry.Plane().width, 48U);
    std::vector<std::uint8_t> mask(stack.width * stack.height, 1);
    for (std::size_t p = 0; p < mask.size(); p += 5)
    {
      mask[p] = 0;
    }
    const auto                     threads = Threads(3);
    MosaicPasses<Pixel, TypeParam> mosaic(
      geometry,
      [&](BayerPlane plane, const ParallelFor & parallelFor) {
        return MakeMethod<TypeParam>(geometry.Plane(), stack.frames, geometry.Take(mask, plane), parallelFor);
      },
      threads);
    RunPasses(mosaic, stack, 7);
    const auto                reports = mosaic.GetReports();
    constexpr double          nan = std::numeric_limits<double>::quiet_NaN();
    const std::vector<double> mean =
      mosaic.JoinMaps([](const auto & method) -> const auto & { return method.GetMean(); }, nan);
    const std::vector<double> corrected =
      mosaic.JoinMaps([](const auto & method) -> const auto & { return method.GetCorrectedVariance(); }, nan);
    const std::vector<std::uint8_t> use =
      mosaic.JoinMaps([](const auto & method) -> const auto & { return method.GetPixelUse(); },
                      static_cast<std::uint8_t>(PixelUse::Border));
    for (const BayerPlane plane : BayerPlanes)
    {
      auto method = MakeMethod<TypeParam>(geometry.Plane(), stack.frames, geometry.Take(mask, plane), SerialFor);
      RunOnPlane(method, stack, geometry, plane);
      EXPECT_EQ(ToJson(reports.at(static_cast<std::size_t>(plane))), ToJson(method.GetReport())) << NameOf(plane);
      EXPECT_TRUE(HaveSameBits(geometry.Take(mean, plane), method.GetMean()));
      EXPECT_TRUE(HaveSameBits(geometry.Take(corrected, plane), method.GetCorrectedVariance()));
      EXPECT_EQ(geometry.Take(use, plane), method.GetPixelUse());
    }
    EXPECT_TRUE(std::isnan(mean[96]));
    EXPECT_EQ(use[96], static_cast<std::uint8_t>(PixelUse::Border));
  }
}

TYPED_TEST(MosaicMethodOf, PlanesThatAreReadInPlaceAreThoseAlone)
{
  using Method = TypeParam;
  Stack<Pixel>      stack = SimulateMosaic(BayerPattern::GRBG, 96, 90);
  const std::size_t pixels = stack.width * stack.height;
  const auto frame = [&](std::size_t t) { return stack.pixels.begin() + static_cast<std::ptrdiff_t>(t * pixels); };
  std::copy_n(frame(3), pixels, frame(5)); // frames 3 and 5 are equal
  for (std::size_t p = 0; p < pixels; ++p)
  {
    if (p / stack.width % 2 == 0) // frames 8 and 9 are equal in the red rows alone
    {
      stack.pixels[9 * pixels + p] = stack.pixels[8 * pixels + p];
    }
  }
  for (const unsigned int shutterAxis : { 0U, 1U })
  {
    const MosaicGeometry geometry{ { stack.width, stack.height, shutterAxis }, BayerPattern::GRBG };
    SettingsOf<Method>   settings;
    settings.rollingShutter = RollingShutter::Fixed;
    const auto make = [&](BayerPlane, const ParallelFor & parallelFor) {
      return MakeMethod<Method>(geometry.Plane(), stack.frames, {}, parallelFor, settings);
    };
    MosaicPasses<Pixel, Method> mosaic(geometry, make, Threads(3));
    RunPasses(mosaic, stack, 7);
    for (std::size_t k = 0; k < BayerPlanes.size(); ++k)
    {
      Method method = make(BayerPlanes.at(k), SerialFor);
      RunOnPlane(method, stack, geometry, BayerPlanes.at(k));
      EXPECT_EQ(method.GetReport().framesDistinct, stack.frames - (k < 2 ? 2 : 1));
      EXPECT_EQ(ToJson(mosaic.GetReports().at(k)), ToJson(method.GetReport()));
      EXPECT_TRUE(HaveSameBits(mosaic.GetMethods().at(k).GetCorrectedVariance(), method.GetCorrectedVariance()));
    }
  }
}

/** Returns the results of RefinedMethod for the planes, and the number of passes, if \a many sums make the rows take
 * turns. */
struct InTurns
{
  using Method = MosaicPasses<Pixel, RefinedPasses<Pixel>>;

  Method      method;
  std::size_t passes{ 0 };

  InTurns(const Stack<Pixel> &                    stack,
          std::size_t                             chunk,
          const std::optional<Method::ManySums> & many,
          const ParallelFor &                     parallelFor,
          std::size_t                             threads)
    : method(
        { { stack.width, stack.height, 1 }, BayerPattern::GRBG },
        [&](BayerPlane, const ParallelFor & withinPlane) {
          return MakeMethod<RefinedPasses<Pixel>>(
            { stack.width / 2, stack.height / 2, 1 }, stack.frames, {}, withinPlane);
        },
        parallelFor,
        threads)
  {
    method.DisableMerging(many);
    for (; !method.IsDone(); ++passes)
    {
      for (std::size_t t = 0; t < stack.frames; t += chunk)
      {
        method.AddFrames(stack.Frame(t), std::min(chunk, stack.frames - t));
      }
      method.EndPass();
      EXPECT_EQ(method.GetMethods()[1].IsDone(), passes >= 2);
    }
  }
};

TEST(MosaicMethod, RowsThatTakeTurnsFindTheSame)
{
  const Stack<Pixel> stack = SimulateMosaic(BayerPattern::GRBG, 96, 90);
  InTurns            together(stack, stack.frames, std::nullopt, SerialFor, 1);
  EXPECT_EQ(together.passes, 3U);
  const auto threads = Threads(3);
  // By plane with fewer threads than planes, else plane after plane. There are no sums of frames that come together.
  for (const auto & [number, chunk, passes] :
       { std::array<std::size_t, 3>{ 2, 7, 4 }, { 3, 7, 4 }, { 2, stack.frames, 3 }, { 3, stack.frames, 3 } })
  {
    InTurns inTurns(stack, chunk, InTurns::Method::ManySums{ 0, 0 }, threads, number);
    EXPECT_EQ(inTurns.passes, passes);
    for (std::size_t k = 0; k < BayerPlanes.size(); ++k)
    {
      EXPECT_EQ(ToJson(inTurns.method.GetReports().at(k)), ToJson(together.method.GetReports().at(k)));
      EXPECT_TRUE(HaveSameBits(inTurns.method.GetMethods()[k].GetCorrectedVariance(),
                               together.method.GetMethods()[k].GetCorrectedVariance()));
    }
  }
  for (const auto & [ofPixel, bytes] : { std::pair<std::size_t, std::size_t>{ 100, 0 }, { 0, 1'000'000'000 } })
  {
    EXPECT_EQ(InTurns(stack, 7, InTurns::Method::ManySums{ ofPixel, bytes }, SerialFor, 1).passes, 3U);
  }
}

TEST(MosaicMethod, PlanesCountTheirOwnFrames)
{
  const MosaicGeometry geometry{ { 64, 64, 1 }, BayerPattern::RGGB };
  const auto           make = [&](BayerPlane, const ParallelFor &) {
    return RefinedPasses<Pixel>(RefinedSettings(), geometry.Plane(), 8);
  };
  MosaicPasses<Pixel, RefinedPasses<Pixel>> method(geometry, make);
  const std::vector<Pixel>                  frames(64 * 64 * 9);
  EXPECT_THROW(method.AddFrames(frames.data(), 9), std::logic_error);
}

/** The public class gives its settings to the planes: it divides a memory limit of all planes among them, and each
 * plane has separate settings. */
TYPED_TEST(MosaicMethodOf, IsThePassesOfItsPlanes)
{
  using Method =
    std::conditional_t<std::is_same_v<TypeParam, RefinedPasses<Pixel>>, RefinedMethod<Pixel>, PublishedMethod<Pixel>>;
  const Stack<Pixel>          stack = SimulateMosaic(BayerPattern::GBRG, 97, 90);
  const MosaicGeometry        geometry{ { stack.width, stack.height, 1 }, BayerPattern::GBRG };
  const SettingsOf<TypeParam> settings;
  std::vector<std::uint8_t>   mask(stack.width * stack.height, 1);
  std::fill(mask.begin(), mask.begin() + 100, std::uint8_t{ 0 });
  auto passes = MakeMosaicPasses<Pixel, TypeParam>(
    { { settings, settings, settings, settings } }, geometry, stack.frames, mask, SerialFor, 1);
  RunPasses(passes, stack, stack.frames);
  MosaicMethod<Pixel, Method> made(settings, geometry.frame, geometry.pattern, stack.frames, mask, Threads(2), 2);
  auto                        method = std::move(made);
  RunPasses(method, stack, 9);
  for (std::size_t k = 0; k < BayerPlanes.size(); ++k)
  {
    EXPECT_EQ(ToJson(method.GetReports().at(k)), ToJson(passes.GetReports().at(k)));
  }
  const auto use =
    passes.JoinMaps([](auto & ofPlane) { return ofPlane.TakePixelUse(); }, static_cast<std::uint8_t>(PixelUse::Border));
  EXPECT_EQ(method.TakePixelUse(), use);
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  const auto       mean = passes.JoinMaps([](auto & ofPlane) { return ofPlane.TakeMean(); }, nan);
  EXPECT_TRUE(HaveSameBits(method.TakeMean(), mean));
}
