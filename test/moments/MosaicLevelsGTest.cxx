// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "moments/StackMaps.h"

#include "sensornoise/Simulator.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <gtest/gtest.h>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

/** \file
 * Tests that the pattern is found in a single exposure of a scene behind a mosaic, and that no pattern is found in
 * monochrome frames. */

using sensornoise::BayerPattern;
using sensornoise::RecogniseMosaic;
using Scene = std::vector<double>;

namespace
{
constexpr std::size_t Size = 128;

/** Returns one exposure of a scene, with the electrons of camera B unless they are reduced. */
Scene
Expose(const Scene &               scene,
       std::optional<BayerPattern> pattern,
       std::array<double, 3>       transmission = { 0.5, 1.0, 0.6 },
       double                      electrons = 3000.0,
       double                      blurPixels = 0.5)
{
  sensornoise::SimulationSettings settings;
  settings.camera.electrons = electrons;
  settings.frames = 1;
  settings.opticalBlurPixels = blurPixels;
  settings.flaws.filters = { pattern, transmission[0], transmission[1], transmission[2] };
  const sensornoise::StackSimulator simulator(scene, Size, Size, settings);
  Scene                             frame(Size * Size);
  simulator.RenderFrame(0, frame.data());
  return frame;
}

Scene
MakeScene(const std::function<double(double x, double y)> & signal)
{
  Scene scene(Size * Size);
  for (std::size_t p = 0; p < scene.size(); ++p)
  {
    scene[p] = signal(static_cast<double>(p % Size), static_cast<double>(p / Size));
  }
  return scene;
}

double
Stripes(double phase)
{
  return std::fmod(std::abs(std::floor(phase)), 2.0);
}

std::vector<std::pair<std::string, Scene>>
MonochromeScenes()
{
  using sensornoise::MakeTextureScene;
  std::vector<std::pair<std::string, Scene>> scenes{
    { "target", sensornoise::MakeTargetScene(Size, Size) },
    { "bars", sensornoise::MakeBarsScene(Size, Size) },
    { "flat", sensornoise::MakeFlatScene(Size, Size) },
    { "texture 1", MakeTextureScene(Size, Size, 1) },
    { "texture 2", MakeTextureScene(Size, Size, 2) },
    { "texture 3", MakeTextureScene(Size, Size, 3) },
    { "ramp along x", MakeScene([](double x, double) { return x; }) },
    { "ramp aslant", MakeScene([](double x, double y) { return x + 2.0 * y; }) },
    { "stripes of 1", MakeScene([](double x, double) { return Stripes(x); }) },
    { "rows of 1", MakeScene([](double, double y) { return Stripes(y); }) },
    { "stripes of 2", MakeScene([](double x, double) { return Stripes(x / 2.0); }) },
    { "stripes of 2.1", MakeScene([](double x, double) { return Stripes(x / 2.1); }) },
    { "diagonal stripes", MakeScene([](double x, double y) { return Stripes((x + y) / 2.0); }) },
    { "dots", MakeScene([](double x, double y) { return Stripes(x / 1.3) * Stripes(y / 1.3); }) },
    { "star", MakeScene([](double x, double y) { return Stripes(16.0 * std::atan2(y - 63.5, x - 63.5)); }) },
    { "rings", MakeScene([](double x, double y) { return std::cos((x * x + y * y) / 90.0); }) },
    { "rings to 1 pixel", MakeScene([](double x, double y) { return std::cos((x * x + y * y) / 40.0); }) },
    { "one edge", MakeScene([](double x, double y) { return x + 0.3 * y > 60.0 ? 1.0 : 0.0; }) },
  };
  for (const double side : { 1.0, 1.01, 2.0, 3.0 })
  {
    scenes.emplace_back("checkerboard of " + std::to_string(side), MakeScene([side](double x, double y) {
                          return Stripes(std::floor(x / side) + std::floor(y / side));
                        }));
  }
  return scenes;
}

constexpr std::array<BayerPattern, 4> Patterns{
  { BayerPattern::RGGB, BayerPattern::GRBG, BayerPattern::GBRG, BayerPattern::BGGR }
};
} // namespace

TEST(MosaicLevels, EachPatternIsFoundInEachScene)
{
  using sensornoise::MakeTextureScene;
  const std::vector<std::pair<const char *, Scene>> scenes{ { "target", sensornoise::MakeTargetScene(Size, Size) },
                                                            { "texture", MakeTextureScene(Size, Size) },
                                                            { "bars", sensornoise::MakeBarsScene(Size, Size) },
                                                            { "flat", sensornoise::MakeFlatScene(Size, Size) } };
  // The brighter colour is called red. With more blue than red signal the two are exchanged, and a warning says so.
  for (const auto & [name, scene] : scenes)
  {
    for (const BayerPattern pattern : Patterns)
    {
      EXPECT_EQ(RecogniseMosaic(Expose(scene, pattern, { 0.6, 1.0, 0.4 }), Size, Size), pattern) << name;
      EXPECT_EQ(RecogniseMosaic(Expose(scene, pattern, { 0.9, 1.0, 0.3 }), Size, Size), pattern) << name;
      EXPECT_EQ(RecogniseMosaic(Expose(scene, pattern, { 0.45, 1.0, 0.38 }), Size, Size), pattern) << name;
      const BayerPattern turned = sensornoise::CutPattern(pattern, 1, 1); // red and blue exchanged
      EXPECT_EQ(RecogniseMosaic(Expose(scene, pattern, { 0.5, 1.0, 0.7 }), Size, Size), turned) << name;
    }
  }
}

TEST(MosaicLevels, NoSceneOfAMonochromeSensorIsAMosaic)
{
  const auto scenes = MonochromeScenes();
  ASSERT_GE(scenes.size(), 20U);
  for (const auto & [name, scene] : scenes)
  {
    for (const double electrons : { 30.0, 3000.0 })
    {
      for (const double blurPixels : { 0.0, 0.5 })
      {
        const auto found = RecogniseMosaic(Expose(scene, std::nullopt, {}, electrons, blurPixels), Size, Size);
        EXPECT_FALSE(found.has_value()) << name << ", " << electrons << " electrons, blur " << blurPixels;
      }
    }
  }
}

TEST(MosaicLevels, ColoursOfTheSceneDoNotHideIt)
{
  // Red objects reflect red alone, and blue objects blue alone: each plane shows another scene.
  const Scene red = sensornoise::MakeTextureScene(Size, Size, 4);
  const Scene green = sensornoise::MakeTextureScene(Size, Size, 5);
  const Scene blue = sensornoise::MakeTextureScene(Size, Size, 6);
  Scene       mosaic(Size * Size);
  for (std::size_t p = 0; p < mosaic.size(); ++p)
  {
    const std::size_t phase = 2 * (p / Size % 2) + p % Size % 2;
    mosaic[p] = phase == 0 ? 2000.0 * red[p] : phase == 3 ? 1000.0 * blue[p] : 3000.0 * green[p];
  }
  EXPECT_EQ(RecogniseMosaic(mosaic, Size, Size), BayerPattern::RGGB);
}

TEST(MosaicLevels, DefectivePixelsAndTinyFramesAreRecognised)
{
  Scene frame = Expose(sensornoise::MakeTargetScene(Size, Size), BayerPattern::GRBG, { 0.6, 1.0, 0.4 });
  for (std::size_t p = 0; p < frame.size(); p += 97)
  {
    frame[p] = std::numeric_limits<double>::quiet_NaN();
  }
  EXPECT_EQ(RecogniseMosaic(frame, Size, Size), BayerPattern::GRBG);
  for (const std::size_t side : { 1U, 2U, 3U, 4U, 7U })
  {
    EXPECT_FALSE(RecogniseMosaic(Scene(side * side, 5.0), side, side).has_value());
  }
}
