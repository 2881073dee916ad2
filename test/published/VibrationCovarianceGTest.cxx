// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "published/PublishedScene.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <gtest/gtest.h>
#include <vector>

using namespace sensornoise;

namespace
{
constexpr std::size_t Width = 30;
constexpr std::size_t Height = 22;

struct Scene
{
  std::size_t               width;
  std::size_t               height;
  std::vector<double>       mean;
  std::vector<double>       variance;
  std::vector<std::uint8_t> valid;

  VibrationCovariance
  Fit(double flickerSd) const
  {
    return FitVibrationCovariance(mean.data(), variance.data(), valid.data(), width, height, flickerSd);
  }
};

/** Coefficients of (2.20). */
struct Truth
{
  double intercept{ -60.0 };
  double gain{ 1.2 };
  double flickerSd{ 0.03 };
  double varianceX{ 0.04 };
  double varianceY{ 0.0009 };
  double covariance{ -0.003 };
};

/** Returns a smooth scene whose variance follows (2.20) exactly, with centred differences that are computed here. */
Scene
SceneOf(const Truth & truth)
{
  Scene scene{
    Width, Height, {}, std::vector<double>(Width * Height, -1e9), std::vector<std::uint8_t>(Width * Height, 1)
  };
  for (std::size_t p = 0; p < Width * Height; ++p)
  {
    const auto x = static_cast<double>(p % Width);
    const auto y = static_cast<double>(p / Width);
    scene.mean.push_back(1500.0 + 500.0 * std::sin(0.5 * x) * std::cos(0.3 * y) + 20.0 * x + 300.0 * std::sin(0.7 * y));
  }
  const double flicker = truth.flickerSd * truth.flickerSd;
  for (std::size_t y = 1; y + 1 < Height; ++y)
  {
    for (std::size_t x = 1; x + 1 < Width; ++x)
    {
      const std::size_t p = y * Width + x;
      const double      u = scene.mean[p];
      const double      gx = (scene.mean[p + 1] - scene.mean[p - 1]) / 2.0;
      const double      gy = (scene.mean[p + Width] - scene.mean[p - Width]) / 2.0;
      scene.variance[p] =
        truth.intercept + truth.gain * u + flicker * u * u +
        (1.0 + flicker) * (truth.varianceX * gx * gx + truth.varianceY * gy * gy + 2.0 * truth.covariance * gx * gy);
    }
  }
  return scene;
}

Scene
Transposed(const Scene & scene)
{
  Scene out = scene;
  out.width = scene.height;
  out.height = scene.width;
  for (std::size_t p = 0; p < scene.mean.size(); ++p)
  {
    const std::size_t q = p % scene.width * scene.height + p / scene.width;
    out.mean[q] = scene.mean[p];
    out.variance[q] = scene.variance[p];
    out.valid[q] = scene.valid[p];
  }
  return out;
}

void
ExpectTruth(const VibrationCovariance & fit, const Truth & truth)
{
  // Six coefficients of order 1 in scaled columns, with a condition below 1e4: 1e-12. The smallest is 1e-2 of its sum.
  EXPECT_TRUE(fit.isDetermined);
  EXPECT_NEAR(fit.varianceXPixels2, truth.varianceX, 1e-9);
  EXPECT_NEAR(fit.varianceYPixels2, truth.varianceY, 1e-9);
  EXPECT_NEAR(fit.covariancePixels2, truth.covariance, 1e-9);
  EXPECT_NEAR(fit.flickerVariance, truth.flickerSd * truth.flickerSd, 1e-9);
}
} // namespace

TEST(SensorNoiseVibrationCovariance, ExactVarianceGivesItsCovariance)
{
  const Truth               truth;
  const VibrationCovariance fit = SceneOf(truth).Fit(truth.flickerSd);
  ExpectTruth(fit, truth);
  EXPECT_EQ(fit.pixels, (Width - 2) * (Height - 2));
}

TEST(SensorNoiseVibrationCovariance, FlickerIsTakenFromTheRegressionWhereItIsNotKnown)
{
  Truth truth;
  truth.flickerSd = 0.5; // 1 + sigma_gamma^2 is 1.25
  ExpectTruth(SceneOf(truth).Fit(-1.0), truth);
  ExpectTruth(SceneOf(truth).Fit(0.5), truth);
  EXPECT_NEAR(SceneOf(truth).Fit(0.0).varianceXPixels2, 1.25 * truth.varianceX, 1e-9);
}

TEST(SensorNoiseVibrationCovariance, TranspositionSwapsXAndY)
{
  const Truth               truth;
  const VibrationCovariance fit = Transposed(SceneOf(truth)).Fit(truth.flickerSd);
  EXPECT_NEAR(fit.varianceXPixels2, truth.varianceY, 1e-9);
  EXPECT_NEAR(fit.varianceYPixels2, truth.varianceX, 1e-9);
  EXPECT_NEAR(fit.covariancePixels2, truth.covariance, 1e-9);
}

TEST(SensorNoiseVibrationCovariance, MirroringChangesTheSignOfTheCovariance)
{
  const Truth truth;
  const Scene scene = SceneOf(truth);
  Scene       mirrored = scene;
  for (std::size_t p = 0; p < scene.mean.size(); ++p)
  {
    const std::size_t q = p / Width * Width + Width - 1 - p % Width;
    mirrored.mean[q] = scene.mean[p];
    mirrored.variance[q] = scene.variance[p];
  }
  const VibrationCovariance fit = mirrored.Fit(truth.flickerSd);
  EXPECT_NEAR(fit.varianceXPixels2, truth.varianceX, 1e-9);
  EXPECT_NEAR(fit.covariancePixels2, -truth.covariance, 1e-9);
}

TEST(SensorNoiseVibrationCovariance, ScalingTheGreyLevelsChangesNothing)
{
  const Truth truth;
  Scene       scene = SceneOf(truth);
  for (std::size_t p = 0; p < scene.mean.size(); ++p)
  {
    scene.mean[p] *= 16.0;
    scene.variance[p] *= 256.0;
  }
  ExpectTruth(scene.Fit(truth.flickerSd), truth);
}

TEST(SensorNoiseVibrationCovariance, PixelsThatAreNotValidTakeNoPart)
{
  const Truth       truth;
  Scene             scene = SceneOf(truth);
  const std::size_t p = 8 * Width + 8;
  scene.valid[p] = 0;
  scene.variance[p] = std::nan("");
  const VibrationCovariance fit = scene.Fit(truth.flickerSd);
  ExpectTruth(fit, truth);
  EXPECT_EQ(fit.pixels, (Width - 2) * (Height - 2) - 1);
}

TEST(SensorNoiseVibrationCovariance, SceneWithoutGradientsDoesNotDetermineIt)
{
  Scene scene = SceneOf(Truth());
  scene.mean.assign(Width * Height, 700.0);
  EXPECT_FALSE(scene.Fit(0.0).isDetermined);
}

TEST(SensorNoiseVibrationCovariance, SceneWithGradientsAlongOneAxisDoesNotDetermineIt)
{
  Scene scene = SceneOf(Truth());
  for (std::size_t p = 0; p < scene.mean.size(); ++p)
  {
    scene.mean[p] = 1000.0 + 300.0 * std::sin(0.7 * static_cast<double>(p % Width));
  }
  EXPECT_FALSE(scene.Fit(0.0).isDetermined);
}

TEST(SensorNoiseVibrationCovariance, TooFewPixelsDoNotDetermineIt)
{
  Scene scene = SceneOf(Truth());
  for (std::size_t p = 0; p < scene.valid.size(); ++p)
  {
    scene.valid[p] = p >= 5 * Width + 3 && p < 5 * Width + 8 ? 1 : 0;
  }
  const VibrationCovariance fit = scene.Fit(0.0);
  EXPECT_FALSE(fit.isDetermined);
  EXPECT_EQ(fit.pixels, 5u);
  scene.valid.assign(scene.valid.size(), 0);
  EXPECT_EQ(scene.Fit(0.0).pixels, 0u);
}
