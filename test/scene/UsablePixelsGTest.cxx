// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "scene/UsablePixels.h"
#include "base/NothingToMeasure.h"
#include "sensornoise/Parallel.h"
#include "sensornoise/Report.h"
#include "sensornoise/StepResults.h"
#include "scene/ReferenceFrame.h"
#include "helpers/FrameTestHelper.h"

#include <cstddef>
#include <cstdint>
#include <gtest/gtest.h>
#include <limits>
#include <string>
#include <vector>

using namespace sensornoise;
using namespace sensornoise::test;

namespace
{
constexpr std::size_t Width = 60;
constexpr std::size_t Height = 50;
constexpr std::size_t Frames = 20;
constexpr std::size_t Centre = 25 * Width + 30;

struct Scene
{
  SyntheticFrames           frames{ Width, Height, std::vector<FrameChange>(Frames) };
  std::vector<std::uint8_t> pixelUse = std::vector<std::uint8_t>(Width * Height, 0);
  DnRange                   dnRange;

  UsablePixels
  Find(const std::vector<double> & frameMeans = std::vector<double>(Frames, 950.0)) const
  {
    return ExcludeCoarseAndGuarded(frames.reference, frames.model, dnRange, frameMeans, pixelUse, SerialFor);
  }
};

void
ExpectUse(const std::vector<std::uint8_t> & pixelUse, std::size_t p, PixelUse expected)
{
  EXPECT_EQ(pixelUse[p], static_cast<std::uint8_t>(expected)) << p;
}
} // namespace

TEST(SensorNoiseUsablePixels, UseSaysWhyAPixelCannotServe)
{
  const auto                mean = WavyScene(Width, Height);
  std::vector<double>       variance(mean.size(), 50.0);
  std::vector<std::uint8_t> valid(mean.size(), 1);
  std::vector<std::uint8_t> mask(mean.size(), 1);
  variance[10 * Width + 10] = std::numeric_limits<double>::quiet_NaN();
  valid[10 * Width + 10] = 0;
  valid[10 * Width + 20] = 0;
  variance[10 * Width + 30] = 0.0;
  mask[10 * Width + 40] = 0;
  const auto frame = MakeReferenceFrame(mean, variance, valid, { Width, Height, 1 }, Frames);
  const auto pixelUse = FindPixelUse(frame, valid, mask);
  ExpectUse(pixelUse, Centre, PixelUse::Used);
  ExpectUse(pixelUse, 1, PixelUse::Border);
  ExpectUse(pixelUse, 10 * Width + 10, PixelUse::NotFinite);
  ExpectUse(pixelUse, 10 * Width + 11, PixelUse::NearClip);
  ExpectUse(pixelUse, 10 * Width + 20, PixelUse::Clipped);
  ExpectUse(pixelUse, 10 * Width + 30, PixelUse::Constant);
  ExpectUse(pixelUse, 10 * Width + 40, PixelUse::Masked);
  ExpectUse(FindPixelUse(frame, valid, {}), 10 * Width + 40, PixelUse::Used);
}

TEST(SensorNoiseUsablePixels, WithoutDnRangeAllServe)
{
  const Scene        scene;
  const UsablePixels found = scene.Find();
  EXPECT_EQ(found.usable, scene.frames.reference.usable);
  EXPECT_EQ(found.pixelUse, scene.pixelUse);
  EXPECT_EQ(found.count, static_cast<double>((Width - 4) * (Height - 4)));
  EXPECT_NO_THROW(RequireFineQuantization(found, 0.0));
}

TEST(SensorNoiseUsablePixels, GuardedAndCoarsePixelsAreLeftOut)
{
  Scene scene;
  scene.dnRange.clipHighDn = 1400.0;
  scene.dnRange.quantisationStepDn = 30.0; // too coarse below 225 DN^2, at 300 + (225 - 30) / 0.5 DN
  const UsablePixels found = scene.Find();
  std::size_t        count = 0;
  for (std::size_t p = 0; p < found.usable.size(); ++p)
  {
    if (scene.frames.reference.usable[p] != 0)
    {
      const bool isCoarse = scene.frames.reference.neighbourMean[p] < 300.0 + 195.0 / 0.5;
      ASSERT_EQ(found.pixelUse[p] == static_cast<std::uint8_t>(PixelUse::CoarseQuantisation), isCoarse) << p;
      ASSERT_EQ(found.usable[p] == 0, found.pixelUse[p] != 0) << p;
      count += found.usable[p];
    }
  }
  EXPECT_GT(found.coarse, 0u);
  EXPECT_GT(found.nearClip, 0u);
  EXPECT_EQ(found.count, static_cast<double>(count));
  EXPECT_EQ(count + found.coarse + found.nearClip, (Width - 4) * (Height - 4));
  // In a bright frame more pixels reach the clip level.
  std::vector<double> frameMeans(Frames, 950.0);
  frameMeans[3] = 1050.0;
  EXPECT_GT(scene.Find(frameMeans).nearClip, found.nearClip);
}

TEST(SensorNoiseUsablePixels, CoarseQuantizationIsRefusedAboveAFifth)
{
  UsablePixels found;
  found.count = 700.0;
  found.nearClip = 100;
  found.coarse = 200;
  EXPECT_NO_THROW(RequireFineQuantization(found, 4.0));
  found.nearClip = 99;
  found.coarse = 201;
  try
  {
    RequireFineQuantization(found, 4.0);
    FAIL();
  }
  catch (const NothingToMeasure & error)
  {
    EXPECT_EQ(error.GetCode(), WarningCode::CodesTooCoarse);
    EXPECT_EQ(
      std::string(error.what()),
      "the noise of 20.1 % of the pixels, the darkest, is below half the quantization step of 4 DN, which hides it "
      "(expected at most 20 % of the pixels). Use more bits, or a higher analogue gain");
  }
}
