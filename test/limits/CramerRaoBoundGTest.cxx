// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "base/Eigen.h"
#include "limits/CramerRaoBound.h"
#include "sensornoise/Parallel.h"
#include "sensornoise/Simulator.h"
#include "sensornoise/SimulationSettings.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <gtest/gtest.h>
#include <stdexcept>
#include <thread>
#include <vector>

using namespace sensornoise;

namespace
{
/** A simulated stack that owns its scene. */
struct Stack
{
  std::size_t               width{ 48 };
  std::size_t               height{ 48 };
  std::vector<double>       electrons;
  std::vector<std::uint8_t> mask;
  SimulationTruth           truth;
  double                    step{ 1.0 };

  PrecisionLimit
  Bound(const ParallelFor & parallelFor = SerialFor) const
  {
    return ComputeCramerRaoBound({ electrons.data(), mask.data(), width, height, &truth, step }, parallelFor);
  }
  PrecisionLimit
  ClosedForm() const
  {
    const CramerRaoInput input{ electrons.data(), mask.data(), width, height, &truth, step };
    const CameraModel &  camera = truth.settings.camera;
    std::vector<double>  mean;
    for (const double value : electrons)
    {
      mean.push_back(camera.offsetDn + input.MeanFluxPerElectronDn() * value);
    }
    return ComputePrecisionLimit({ mean.data(),
                                   mask.data(),
                                   width,
                                   height,
                                   camera.gainDnPerElectron,
                                   camera.offsetDn,
                                   input.TotalReadVarianceDn2(),
                                   step,
                                   truth.settings.frames,
                                   truth.realisedFlickerSd });
  }
};

/** Camera B looks at 4 x 4 patches of 16 levels from 0 to 3000 electrons, blurred by half a pixel. */
Stack
PatchesStack(std::size_t frames, const SceneConditions & conditions)
{
  Stack              stack;
  SimulationSettings settings;
  settings.frames = frames;
  settings.conditions = conditions;
  stack.truth = DrawTruth(settings, stack.height);
  stack.mask.assign(stack.width * stack.height, 1);
  std::vector<double> levels;
  for (std::size_t p = 0; p < stack.width * stack.height; ++p)
  {
    const std::size_t patch = p / stack.width / 12 * 4 + p % stack.width / 12;
    levels.push_back(200.0 * static_cast<double>(patch * 7 % 16));
  }
  stack.electrons = GaussianBlur(levels, stack.width, stack.height, 0.5);
  return stack;
}

void
ExpectSame(double a, double b, double relative = 1e-8)
{
  EXPECT_NEAR(a, b, relative * std::abs(b));
}

/** Expects equal limits, except for the intercept, which depends on the origin of the grey scale. */
void
ExpectSameButIntercept(const PrecisionLimit & a, const PrecisionLimit & b, double factor = 1.0)
{
  ExpectSame(a.gain, factor * b.gain);
  ExpectSame(a.offset, factor * b.offset);
  ExpectSame(a.readNoise, factor * b.readNoise);
  ExpectSame(a.flickerOfFrame, factor * b.flickerOfFrame);
  ExpectSame(a.flickerSd, factor * b.flickerSd);
  ExpectSame(a.vibrationXOfFrame, factor * b.vibrationXOfFrame);
  ExpectSame(a.vibrationSdX, factor * b.vibrationSdX);
}

void
FourThreads(std::size_t count, const std::function<void(std::size_t)> & function)
{
  std::vector<std::thread> threads;
  for (std::size_t first = 0; first < 4; ++first)
  {
    threads.emplace_back([=, &function] {
      for (std::size_t i = first; i < count; i += 4)
      {
        function(i);
      }
    });
  }
  std::for_each(threads.begin(), threads.end(), [](std::thread & thread) { thread.join(); });
}

constexpr SceneConditions Gentle{ 0.05, 0.01, 0.02 };
} // namespace

// Another way to the same numbers: the whole information matrix of (g, mu, s, gamma, alpha, beta, all q_x), the three
// sums of gamma, alpha and beta held at 0 by multipliers, inverted at once. The scene is linear in x and in y, so that
// its linear interpolation away from the border is the scene itself.
TEST(SensorNoiseCramerRaoBound, IsTheInverseOfTheWholeInformationMatrix)
{
  Stack stack = PatchesStack(5, { 0.1, 0.3, 0.2 });
  stack.width = 7;
  stack.height = 6;
  stack.electrons.clear();
  stack.mask.clear();
  const auto scene = [](double x, double y) { return 900.0 + 150.0 * x - 70.0 * y + 12.0 * x * y; };
  for (std::size_t y = 0; y < stack.height; ++y)
  {
    for (std::size_t x = 0; x < stack.width; ++x)
    {
      stack.electrons.push_back(scene(static_cast<double>(x), static_cast<double>(y)));
      stack.mask.push_back(x > 0 && x < 6 && y > 0 && y < 5 && !(x == 3 && y == 2) ? 1 : 0);
    }
  }
  const CameraModel & camera = stack.truth.settings.camera;
  const auto &        series = stack.truth.series;
  ASSERT_LT(*std::max_element(series.alpha.begin(), series.alpha.end()), 1.0);
  ASSERT_GT(*std::min_element(series.alpha.begin(), series.alpha.end()), -1.0);
  const double g = camera.gainDnPerElectron;
  const double s = camera.readNoiseDn * camera.readNoiseDn + 1.0 / 12.0;
  double       brightness = 0.0;
  for (const double gamma : series.gamma)
  {
    brightness += (1.0 + gamma) / 5.0;
  }
  constexpr Eigen::Index shared = 3 + 3 * 5;
  constexpr Eigen::Index all = shared + 7 * 6;
  Eigen::MatrixXd        information = Eigen::MatrixXd::Zero(all + 3, all + 3);
  for (Eigen::Index p = 0; p < 42; ++p)
  {
    for (Eigen::Index t = 0; t < 5 && stack.mask[static_cast<std::size_t>(p)] != 0; ++t)
    {
      const double    f = 1.0 + stack.truth.normalisedFlicker[static_cast<std::size_t>(t)];
      const double    x = static_cast<double>(p % 7) + series.alpha[static_cast<std::size_t>(t)];
      const double    y = static_cast<double>(p / 7) + series.beta[static_cast<std::size_t>(t)];
      const double    q = g * brightness * scene(x, y);
      Eigen::VectorXd ofMean = Eigen::VectorXd::Zero(all + 3);
      ofMean(3 + t) = q;
      ofMean(8 + t) = f * g * brightness * (150.0 + 12.0 * y);
      ofMean(13 + t) = f * g * brightness * (-70.0 + 12.0 * x);
      ofMean(shared + p) = f;
      Eigen::VectorXd ofVariance = g * ofMean;
      ofMean(1) = 1.0;
      ofVariance(0) = f * q;
      ofVariance(2) = 1.0;
      const double variance = g * f * q + s;
      information += ofMean * ofMean.transpose() / variance;
      information += ofVariance * ofVariance.transpose() / (2.0 * variance * variance);
    }
    if (stack.mask[static_cast<std::size_t>(p)] == 0)
    {
      information(shared + p, shared + p) = 1.0;
    }
  }
  for (Eigen::Index k = 0; k < 3; ++k)
  {
    information.block(3 + 5 * k, all + k, 5, 1).setOnes();
    information.block(all + k, 3 + 5 * k, 1, 5).setOnes();
  }
  const Eigen::MatrixXd covariance = information.fullPivLu().inverse();
  const auto            sdOf = [&](const Eigen::VectorXd & gradient) {
    return std::sqrt(gradient.dot(covariance.topLeftCorner(shared, shared) * gradient));
  };
  const PrecisionLimit bound = stack.Bound();
  // The matrix has a condition number of about 1e9, and the slopes are differences over 0.002 pixel.
  constexpr double tolerance = 1e-5;
  Eigen::VectorXd  gradient = Eigen::VectorXd::Zero(shared);
  gradient(0) = 1.0;
  ExpectSame(bound.gain, sdOf(gradient), tolerance);
  gradient(0) = -camera.offsetDn;
  gradient(1) = -g;
  gradient(2) = 1.0;
  ExpectSame(bound.intercept, sdOf(gradient), tolerance);
  EXPECT_NEAR(bound.gainInterceptCorrelation,
              covariance.row(0).head(shared).dot(gradient) / (bound.gain * bound.intercept),
              tolerance);
  ExpectSame(bound.offset, std::sqrt(covariance(1, 1)), tolerance);
  ExpectSame(bound.readNoise, std::sqrt(covariance(2, 2)) / (2.0 * camera.readNoiseDn), tolerance);
  ExpectSame(bound.flickerOfFrame, std::sqrt(covariance.block(3, 3, 5, 5).trace() / 5.0), tolerance);
  ExpectSame(bound.vibrationXOfFrame, std::sqrt(covariance.block(8, 8, 5, 5).trace() / 5.0), tolerance);
  ExpectSame(bound.vibrationYOfFrame, std::sqrt(covariance.block(13, 13, 5, 5).trace() / 5.0), tolerance);
  gradient.setZero();
  for (Eigen::Index t = 0; t < 5; ++t)
  {
    gradient(3 + t) =
      stack.truth.normalisedFlicker[static_cast<std::size_t>(t)] / (4.0 * stack.truth.realisedFlickerSd);
  }
  ExpectSame(bound.flickerSd, sdOf(gradient), tolerance);
}

// The closed forms leave out terms of 1/(2T), 1.25 % here, and that shifts look like flicker where there are edges.
TEST(SensorNoiseCramerRaoBound, AgreesWithTheClosedForms)
{
  const Stack          stack = PatchesStack(40, Gentle);
  const PrecisionLimit bound = stack.Bound();
  const PrecisionLimit closed = stack.ClosedForm();
  ExpectSame(closed.gain, bound.gain, 0.03);
  ExpectSame(closed.intercept, bound.intercept, 0.03);
  ExpectSame(closed.offset, bound.offset, 0.03);
  ExpectSame(closed.readNoise, bound.readNoise, 0.03);
  ExpectSame(closed.flickerOfFrame, bound.flickerOfFrame, 0.03);
  ExpectSame(closed.flickerSd, bound.flickerSd, 0.03);
  EXPECT_NEAR(closed.gainInterceptCorrelation, bound.gainInterceptCorrelation, 0.03);
  ExpectSame(closed.vibrationXOfFrame, bound.vibrationXOfFrame, 0.4); // central differences, and one-sided ones
}

TEST(SensorNoiseCramerRaoBound, OriginOfTheGreyScaleMovesTheInterceptOnly)
{
  Stack                stack = PatchesStack(20, Gentle);
  const PrecisionLimit before = stack.Bound();
  const double         shift = 300.0;
  stack.truth.settings.camera.offsetDn += shift;
  const PrecisionLimit after = stack.Bound();
  ExpectSameButIntercept(after, before);
  const double covariance = before.gainInterceptCorrelation * before.gain * before.intercept;
  ExpectSame(after.intercept,
             std::sqrt(before.intercept * before.intercept + shift * shift * before.gain * before.gain -
                       2.0 * shift * covariance));
}

TEST(SensorNoiseCramerRaoBound, GreyScaleTwiceAsFine)
{
  Stack                stack = PatchesStack(20, Gentle);
  const PrecisionLimit before = stack.Bound();
  CameraModel &        camera = stack.truth.settings.camera;
  camera.gainDnPerElectron *= 2.0;
  camera.offsetDn *= 2.0;
  camera.readNoiseDn *= 2.0;
  stack.step *= 2.0;
  const PrecisionLimit after = stack.Bound();
  ExpectSame(after.gain, 2.0 * before.gain);
  ExpectSame(after.intercept, 4.0 * before.intercept);
  ExpectSame(after.offset, 2.0 * before.offset);
  ExpectSame(after.readNoise, 2.0 * before.readNoise);
  ExpectSame(after.flickerSd, before.flickerSd);
  ExpectSame(after.vibrationSdY, before.vibrationSdY);
}

// Shot noise alone: four times the electrons leave the error of the gain and halve the error of flux, flicker and
// shift. The variance's own information on the flux, 1/(2p) of the mean's with p > 10000 electrons, does not scale:
// 1e-4.
TEST(SensorNoiseCramerRaoBound, FourTimesTheElectrons)
{
  Stack stack = PatchesStack(20, Gentle);
  stack.step = 0.0;
  stack.truth.settings.camera.readNoiseDn = 1e-3;
  for (double & value : stack.electrons)
  {
    value += 10000.0;
  }
  const PrecisionLimit before = stack.Bound();
  for (double & value : stack.electrons)
  {
    value *= 4.0;
  }
  const PrecisionLimit after = stack.Bound();
  ExpectSame(after.gain, before.gain, 1e-4);
  ExpectSame(after.offset, 2.0 * before.offset, 1e-4);
  ExpectSame(after.flickerOfFrame, 0.5 * before.flickerOfFrame, 1e-4);
  ExpectSame(after.flickerSd, 0.5 * before.flickerSd, 1e-4);
  ExpectSame(after.vibrationSdX, 0.5 * before.vibrationSdX, 1e-4);
}

TEST(SensorNoiseCramerRaoBound, TwiceThePixelsHalveTheVariance)
{
  Stack stack = PatchesStack(20, { 0.05, 0.1, 0.2 });
  for (std::size_t p = 0; p < stack.mask.size(); ++p)
  {
    const std::size_t y = p / stack.width;
    stack.mask[p] = y > 0 && y + 1 < stack.height ? 1 : 0; // where two copies meet, the gradient is another one
  }
  ASSERT_LT(*std::max_element(stack.truth.series.beta.begin(), stack.truth.series.beta.end()), 1.0);
  ASSERT_GT(*std::min_element(stack.truth.series.beta.begin(), stack.truth.series.beta.end()), -1.0);
  const PrecisionLimit once = stack.Bound();
  const auto           electrons = stack.electrons;
  const auto           mask = stack.mask;
  stack.electrons.insert(stack.electrons.end(), electrons.begin(), electrons.end());
  stack.mask.insert(stack.mask.end(), mask.begin(), mask.end());
  stack.height *= 2;
  const PrecisionLimit twice = stack.Bound();
  ExpectSameButIntercept(twice, once, std::sqrt(0.5));
  ExpectSame(twice.intercept, std::sqrt(0.5) * once.intercept);
  ExpectSame(twice.vibrationSdY, std::sqrt(0.5) * once.vibrationSdY);
}

TEST(SensorNoiseCramerRaoBound, SameBitsForAnyNumberOfThreads)
{
  const Stack          stack = PatchesStack(20, Gentle);
  const PrecisionLimit one = stack.Bound();
  const PrecisionLimit four = stack.Bound(FourThreads);
  EXPECT_EQ(one.gain, four.gain);
  EXPECT_EQ(one.offset, four.offset);
  EXPECT_EQ(one.flickerSd, four.flickerSd);
  EXPECT_EQ(one.vibrationSdX, four.vibrationSdX);
}

TEST(SensorNoiseCramerRaoBound, WithoutFlickerNeitherOffsetNorReadNoise)
{
  const PrecisionLimit limit = PatchesStack(20, { 0.0, 0.01, 0.02 }).Bound();
  EXPECT_EQ(limit.offset, PrecisionLimit::None);
  EXPECT_EQ(limit.readNoise, PrecisionLimit::None);
  // 5 % of flicker change the information on the rest by the order of 0.05^2.
  const PrecisionLimit other = PatchesStack(20, Gentle).Bound();
  ExpectSame(limit.gain, other.gain, 0.01);
  ExpectSame(limit.intercept, other.intercept, 0.01);
  ExpectSame(limit.vibrationXOfFrame, other.vibrationXOfFrame, 0.01);
}

TEST(SensorNoiseCramerRaoBound, SceneThatIsConstantAlongYHidesTheVerticalShift)
{
  Stack stack = PatchesStack(20, Gentle);
  for (std::size_t p = 0; p < stack.electrons.size(); ++p)
  {
    stack.electrons[p] = stack.electrons[p % stack.width];
  }
  const PrecisionLimit limit = stack.Bound();
  EXPECT_EQ(limit.vibrationYOfFrame, PrecisionLimit::None);
  EXPECT_EQ(limit.vibrationSdY, PrecisionLimit::None);
  EXPECT_LT(limit.vibrationSdX, 0.01);
  EXPECT_LT(limit.offset, 10.0);
}

// On a scene with the same slope everywhere along y, the shift beta_t adds the same to all pixels: with it free, any
// offset mu + d explains the frames as well, with shifts proportional to d gamma_t.
TEST(SensorNoiseCramerRaoBound, SceneWithOneSlopeAlongYHidesTheOffset)
{
  Stack stack = PatchesStack(20, Gentle);
  for (std::size_t p = 0; p < stack.electrons.size(); ++p)
  {
    stack.electrons[p] = stack.electrons[p % stack.width] + 5.0 * static_cast<double>(p / stack.width);
    stack.mask[p] = p / stack.width > 0 && p / stack.width + 1 < stack.height ? 1 : 0;
  }
  const PrecisionLimit limit = stack.Bound();
  EXPECT_EQ(limit.offset, PrecisionLimit::None);
  EXPECT_EQ(limit.readNoise, PrecisionLimit::None);
  EXPECT_LT(limit.gain, 0.1);
}

TEST(SensorNoiseCramerRaoBound, RefusesWhatItsModelDoesNotHold)
{
  Stack stack = PatchesStack(20, Gentle);
  stack.truth.settings.rollingShutterPeriodRows = 20.0;
  EXPECT_THROW(stack.Bound(), std::invalid_argument);
  stack = PatchesStack(1, Gentle);
  EXPECT_THROW(stack.Bound(), std::invalid_argument);
  stack = PatchesStack(20, Gentle);
  stack.step = 0.0;
  stack.truth.settings.camera.readNoiseDn = 0.0;
  EXPECT_THROW(stack.Bound(), std::invalid_argument);
}
