// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "moments/FrameThumbnails.h"
#include "simulation/Random.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <gtest/gtest.h>
#include <limits>
#include <sstream>
#include <string>
#include <vector>

using namespace sensornoise;

namespace
{
constexpr std::size_t   Width = 64;
constexpr std::size_t   Height = 48;
constexpr FrameGeometry Geometry{ Width, Height };
constexpr double        OffsetDn = 100.0;
constexpr double        Gain = 0.5;
constexpr double        ReadNoiseDn = 3.0;

/** Function that returns the electrons at a place in a frame. */
using Electrons = std::function<double(std::size_t t, double x, double y)>;

/** Returns between 500 and 3500 electrons. */
double
Scene(double x, double y)
{
  return 2000.0 + 700.0 * std::sin(0.2 * x) + 800.0 * std::cos(0.13 * y);
}

/** Frames of a camera with normal noise. */
std::vector<float>
Expose(std::size_t frames, const Electrons & electronsOf)
{
  std::vector<float>  stack;
  CounterSeededRandom random(7);
  for (std::size_t t = 0; t < frames; ++t)
  {
    for (std::size_t p = 0; p < Width * Height; ++p)
    {
      const double electrons = electronsOf(t, static_cast<double>(p % Width), static_cast<double>(p / Width));
      const double noise = std::sqrt(Gain * Gain * electrons + ReadNoiseDn * ReadNoiseDn);
      stack.push_back(static_cast<float>(std::rint(OffsetDn + Gain * electrons + noise * random.Normal())));
    }
  }
  return stack;
}

FrameThumbnails
ThumbnailsOf(const std::vector<float> & stack, const std::vector<std::uint8_t> & mask = {})
{
  const std::size_t frames = stack.size() / (Width * Height);
  FrameThumbnails   thumbnails(Geometry, frames, mask);
  thumbnails.AddFrames(stack.data(), 0, frames, SerialFor);
  return thumbnails;
}

std::string
UnlikeOf(const FrameThumbnails & thumbnails)
{
  std::string names;
  for (const auto & [frame, fault] : FindUnlikeFrames(thumbnails))
  {
    names += std::to_string(frame) + " " + NameOf(fault) + "; ";
  }
  return names;
}

/** Sets all pixels of a frame. */
void
Fill(std::vector<float> & stack, std::size_t t, float value)
{
  std::fill_n(stack.begin() + static_cast<std::ptrdiff_t>(t * Width * Height), Width * Height, value);
}
} // namespace

TEST(SensorNoiseUnlikeFrames, AnyIlluminationOfOneSceneIsAlike)
{
  const std::vector<std::function<double(std::size_t)>> illuminations{
    [](std::size_t) { return 1.0; },
    [](std::size_t t) { return 1.0 + 0.05 * std::sin(2.3 * static_cast<double>(t)); },
    [](std::size_t t) { return 0.5 + 0.5 * std::sin(0.8 * static_cast<double>(t)); },
    [](std::size_t t) { return t % 4 == 0 ? 1.0 : 0.0; },
    [](std::size_t t) { return t % 20 == 0 ? 1.0 : 0.0; },
    [](std::size_t t) { return t == 0 ? 0.0 : 1.0; },
    [](std::size_t t) { return t == 7 ? 3.0 : 0.3; },
    [](std::size_t t) { return std::pow(0.1, static_cast<double>(t) / 59.0); },
  };
  for (std::size_t k = 0; k < illuminations.size(); ++k)
  {
    const auto scene = [&](std::size_t t, double x, double y) { return illuminations[k](t) * Scene(x, y); };
    const auto flat = [&](std::size_t t, double, double) { return illuminations[k](t) * 2000.0; };
    EXPECT_EQ(UnlikeOf(ThumbnailsOf(Expose(60, scene))), "") << k;
    EXPECT_EQ(UnlikeOf(ThumbnailsOf(Expose(60, flat))), "") << k;
  }
}

TEST(SensorNoiseUnlikeFrames, VibrationIsAlike)
{
  constexpr std::size_t frames = 60;
  CounterSeededRandom   random(3);
  std::vector<double>   shifts; // [pixel]
  for (std::size_t t = 0; t < 2 * frames; ++t)
  {
    shifts.push_back(0.5 * random.Normal());
  }
  const auto shaken = [&](std::size_t t, double x, double y) {
    return Scene(x + shifts[2 * t], y + shifts[2 * t + 1]);
  };
  EXPECT_EQ(UnlikeOf(ThumbnailsOf(Expose(frames, shaken))), "");
}

TEST(SensorNoiseUnlikeFrames, AVibrationThatFewCellsSeeIsAlike)
{
  constexpr std::size_t frames = 100;
  CounterSeededRandom   random(5);
  std::vector<double>   shifts; // [pixel]
  for (std::size_t t = 0; t < frames; ++t)
  {
    shifts.push_back(0.06 * random.Normal());
  }
  // The edges are at the borders of cells: only a shift to one side moves signal from one cell to another.
  const auto barsOf = [&](std::size_t t, double x, double shift) {
    const double reached = std::max(0.0, shift + (t == 50 ? 0.3 : 0.0));
    const auto   column = static_cast<std::size_t>(x);
    const bool   isBright = column / 8 % 2 == 0;
    return 200.0 + (isBright ? 3000.0 : 0.0) + (column % 8 == 0 ? (isBright ? -3000.0 : 3000.0) * reached : 0.0);
  };
  const auto shaken = [&](std::size_t t, double x, double) { return barsOf(t, x, shifts[t]); };
  EXPECT_EQ(UnlikeOf(ThumbnailsOf(Expose(frames, shaken))), "");
  const auto withAThing = [&](std::size_t t, double x, double y) {
    return barsOf(t, x, shifts[t]) * (t == 30 && y > 10.0 && y < 30.0 ? 0.8 : 1.0);
  };
  EXPECT_EQ(UnlikeOf(ThumbnailsOf(Expose(frames, withAThing))), "30 other-shape; ");
}

TEST(SensorNoiseUnlikeFrames, EachKindIsNamedWhereverItStands)
{
  const Electrons electronsOf = [](std::size_t t, double x, double y) {
    const double r2 = std::pow(x - 0.5 * Width, 2) + std::pow(y - 0.5 * Height, 2);
    const double dip = t == 44 ? 1.0 - 0.12 * std::exp(-r2 / (2.0 * std::pow(0.3 * Width, 2))) : 1.0;
    return dip * (t == 31 ? Scene(y, x) : Scene(x, y));
  };
  std::vector<float> stack = Expose(60, electronsOf);
  Fill(stack, 0, 0.0F);
  Fill(stack, 17, 4095.0F);
  Fill(stack, 59, std::numeric_limits<float>::quiet_NaN());
  EXPECT_EQ(UnlikeOf(ThumbnailsOf(stack)), "0 no-noise; 17 no-noise; 31 other-shape; 44 other-shape; 59 not-finite; ");
}

TEST(SensorNoiseUnlikeFrames, AFewPixelsMakeNoFrameUnlike)
{
  std::vector<float> stack = Expose(30, [](std::size_t, double x, double y) { return Scene(x, y); });
  for (std::size_t p = 0; p < 5 * 300; p += 300) // in at most 5 of 256 tiles
  {
    stack[12 * Width * Height + p + 20 * Width] = 60000.0F;
  }
  EXPECT_EQ(UnlikeOf(ThumbnailsOf(stack)), "");
}

TEST(SensorNoiseUnlikeFrames, MoreThanAFifthAreTheBurst)
{
  const auto otherUntil = [](std::size_t end) {
    return ThumbnailsOf(
      Expose(20, [end](std::size_t t, double x, double y) { return t < end ? Scene(y, x) : Scene(x, y); }));
  };
  EXPECT_EQ(FindUnlikeFrames(otherUntil(4)).size(), 4U);
  EXPECT_EQ(FindUnlikeFrames(otherUntil(5)).size(), 0U);
}

TEST(SensorNoiseUnlikeFrames, EmptyFramesAreNoBurstHoweverManyTheyAre)
{
  std::vector<float> stack =
    Expose(20, [](std::size_t t, double x, double y) { return t == 19 ? Scene(y, x) : Scene(x, y); });
  for (std::size_t t = 0; t < 8; ++t)
  {
    Fill(stack, t, 4095.0F);
  }
  const std::vector<LeftOutFrame> found = FindUnlikeFrames(ThumbnailsOf(stack));
  EXPECT_EQ(NumbersOf(found), (std::vector<std::size_t>{ 0, 1, 2, 3, 4, 5, 6, 7, 19 }));
}

TEST(SensorNoiseUnlikeFrames, MinimumFramesAreLeft)
{
  const auto otherFirst = [](std::size_t frames) {
    return ThumbnailsOf(
      Expose(frames, [](std::size_t t, double x, double y) { return t == 0 ? Scene(y, x) : Scene(x, y); }));
  };
  EXPECT_EQ(FindUnlikeFrames(otherFirst(6)).size(), 1U);
  EXPECT_EQ(FindUnlikeFrames(otherFirst(5)).size(), 0U);
}

TEST(SensorNoiseUnlikeFrames, OfMaskedPixelsNothingIsSaid)
{
  const auto stack = Expose(30, [](std::size_t t, double x, double y) {
    return t == 4 && x >= 32.0 ? 1000.0 : Scene(x, y); // the right half of frame 4 differs
  });
  EXPECT_EQ(UnlikeOf(ThumbnailsOf(stack)), "4 other-shape; ");
  std::vector<std::uint8_t> left(Width * Height);
  for (std::size_t p = 0; p < left.size(); ++p)
  {
    left[p] = p % Width < 32 ? 1 : 0;
  }
  EXPECT_EQ(UnlikeOf(ThumbnailsOf(stack, left)), "");
}

TEST(SensorNoiseUnlikeFrames, OfMergedPartsAreThoseOfTheWhole)
{
  std::vector<float> stack =
    Expose(20, [](std::size_t t, double x, double y) { return t == 11 ? Scene(y, x) : Scene(x, y); });
  Fill(stack, 3, 0.0F);
  FrameThumbnails one(Geometry, 20, {});
  FrameThumbnails two(Geometry, 20, {});
  one.AddFrames(stack.data(), 0, 8, SerialFor);
  two.AddFrames(stack.data() + 8 * Width * Height, 8, 12, SerialFor);
  std::stringstream sums;
  two.Save(sums);
  one.Merge(one.ReadOther(sums));
  EXPECT_EQ(UnlikeOf(one), "3 no-noise; 11 other-shape; ");
}

TEST(SensorNoiseUnlikeFrames, OfPartsAreJoinedUnlessTheyAreTooMany)
{
  const std::vector<LeftOutFrame> one{ { 3, FrameFault::OtherNoise } };
  const std::vector<LeftOutFrame> two{ { 1, FrameFault::OtherShape }, { 3, FrameFault::OtherShape } };
  EXPECT_EQ(NumbersOf(JoinUnlikeFrames({ one, two, {} }, 10)), (std::vector<std::size_t>{ 1, 3 }));
  EXPECT_EQ(NumbersOf(JoinUnlikeFrames({ one, two, {} }, 9)), std::vector<std::size_t>());
}
