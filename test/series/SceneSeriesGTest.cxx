// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "series/SceneSeries.h"
#include "simulation/Random.h"
#include "base/Stencils.h"
#include "base/NothingToMeasure.h"
#include "sensornoise/Parallel.h"
#include "sensornoise/Settings.h"
#include "series/FrameEquations.h"
#include "series/FrameSums.h"
#include "series/FrameRegressors.h"
#include "helpers/FrameTestHelper.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <gtest/gtest.h>
#include <string>
#include <vector>

using namespace sensornoise;
using namespace sensornoise::test;

namespace
{
constexpr std::size_t Width = 70;
constexpr std::size_t Height = 45;
} // namespace

TEST(SensorNoiseSceneSeries, SquaresOfTheShiftsAreNoFlicker)
{
  constexpr std::size_t count = 20;
  MotionSeries          motion;
  motion.stencils = { StencilX, StencilY };
  motion.coefficients.resize(count, 2);
  std::vector<double> ofShifts(count);
  std::vector<double> ofIllumination(count);
  for (std::size_t t = 0; t < count; ++t)
  {
    CounterSeededRandom random(9, t, 0, 0);
    const double        x = random.Normal();
    const double        y = random.Normal();
    motion.coefficients.row(static_cast<Eigen::Index>(t)) << x, y;
    ofShifts[t] = -1e-3 * (x * x + 0.5 * y * y - 0.3 * x * y) + 1e-4 * random.Normal();
    ofIllumination[t] = 1e-3 * random.Normal();
  }
  const Eigen::MatrixXd squares = SquaresThatExplain(ofShifts, motion);
  ASSERT_EQ(squares.cols(), 3);
  EXPECT_LT((squares.transpose() * squares - Eigen::MatrixXd::Identity(3, 3)).norm(), 1e-12);
  EXPECT_LT(squares.colwise().sum().norm(), 1e-12);
  EXPECT_EQ(SquaresThatExplain(ofIllumination, motion).cols(), 0);
}

TEST(SensorNoiseSceneSeries, FlickerDeterminesTheOffset)
{
  const SyntheticFrames frames(Width, Height, FlickerAndMotion(24, 120.0, 0.3), 1.0);
  const FrameSums       sums = frames.Sums();
  const SceneSeries     series = FindSceneSeries(sums, RollingShutter::Off);
  EXPECT_EQ(series.offset, series.line.offset);
  // 6 standard errors.
  EXPECT_NEAR(series.offset + frames.model.centreDn, 120.0, 6.0 * series.line.standardError);
  EXPECT_EQ(series.local.series.cols(), 0);
  EXPECT_EQ(series.basis.NumberOfIlluminationFactors(), 1u);
  EXPECT_GE(series.basis.Size(), 1 + series.motion.stencils.size());
}

TEST(SensorNoiseSceneSeries, WithoutFlickerTheDarkestLevelServes)
{
  const SyntheticFrames frames(Width, Height, std::vector<FrameChange>(24), 1.0);
  const FrameSums       sums = frames.Sums();
  const SceneSeries     series = FindSceneSeries(sums, RollingShutter::Off);
  EXPECT_EQ(series.offset, frames.model.darkestDn - frames.model.centreDn);
}

TEST(SensorNoiseSceneSeries, OneIntensityDeterminesTheFlickerAboutAKnownOffset)
{
  // A flat field of 500 DN whose frames deviate by 2 %. Its gain is identifiable with dark frames.
  std::vector<FrameChange> changes(24);
  for (std::size_t t = 0; t < changes.size(); ++t)
  {
    changes[t].level = 10.0 * (t % 2 == 0 ? 1.0 : -1.0);
  }
  SyntheticFrames frames(Width, Height, changes);
  std::fill(frames.reference.mean.begin(), frames.reference.mean.end(), 500.0);
  frames.model.centreDn = 500.0;
  frames.model.darkestDn = 490.0;
  FrameSums sums = frames.EmptySums();
  for (std::size_t t = 0; t < changes.size(); ++t)
  {
    const std::vector<double> frame(frames.Pixels(), 500.0 + changes[t].level);
    sums.AddFrames(frame.data(), t, 1, SerialFor);
  }
  const SceneSeries blind = FindSceneSeries(sums, RollingShutter::Auto);
  EXPECT_FALSE(blind.isOffsetIdentifiable);
  EXPECT_EQ(blind.line.contrast, 0.0);
  EXPECT_EQ(blind.offset, 0.0 - 500.0); // about the level 0
  const SceneSeries known = FindSceneSeries(sums, RollingShutter::Auto, 100.0);
  EXPECT_FALSE(known.isOffsetIdentifiable);
  EXPECT_EQ(known.offset, 100.0 - 500.0);
  ASSERT_EQ(known.line.gamma.size(), changes.size());
  for (std::size_t t = 0; t < changes.size(); ++t)
  {
    EXPECT_NEAR(known.line.gamma[t], changes[t].level / (500.0 - 100.0), 1e-9) << t; // relative to the signal
  }
}

TEST(SensorNoiseSceneSeries, NoUsablePixelIsNothingToMeasure)
{
  SyntheticFrames frames(Width, Height, std::vector<FrameChange>(24));
  std::fill(frames.take.begin(), frames.take.end(), std::uint8_t{ 0 });
  const FrameSums sums = frames.EmptySums();
  try
  {
    FindSceneSeries(sums, RollingShutter::Auto);
    ADD_FAILURE() << "no pixel was measured";
  }
  catch (const NothingToMeasure & error)
  {
    EXPECT_EQ(std::string(error.what()).rfind("no pixel is left: all are masked, clipped", 0), 0U) << error.what();
  }
}

TEST(SensorNoiseSceneSeries, NoiseOfTheModelCountsThePixelsOfEachClass)
{
  const SyntheticFrames   frames(Width, Height, std::vector<FrameChange>(5));
  const FrameSums         sums = frames.EmptySums();
  const RegressorNoise    noise = NoiseOfModel(sums.GetRegressors());
  std::vector<double>     counts(GradientClasses, 0.0);
  const FrameRegressors & regressors = sums.GetRegressors();
  for (std::size_t p = 0; p < frames.Pixels(); ++p)
  {
    if (frames.take[p] != 0)
    {
      counts[regressors.ClassOf(p)] += 1.0;
    }
  }
  for (std::size_t c = 0; c < GradientClasses; ++c)
  {
    EXPECT_EQ(noise.variance[c], counts[c]) << c;
    EXPECT_EQ(noise.shot[c], 0.0) << c;
  }
}
