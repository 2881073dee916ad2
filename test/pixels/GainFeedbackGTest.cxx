// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "pixels/VarianceLine.h"
#include "base/Eigen.h"
#include "sensornoise/Parallel.h"
#include "base/PixelLayout.h"
#include "pixels/ProjectedFrames.h"
#include "pixels/ProjectedVariance.h"
#include "pixels/ProjectionSums.h"
#include "pixels/StaticVariance.h"
#include "scene/InitialNoiseModel.h"
#include "scene/ReferenceFrame.h"
#include "series/FrameEquations.h"
#include "series/SceneSeries.h"
#include "simulation/Random.h"
#include "helpers/FrameTestHelper.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <gtest/gtest.h>
#include <utility>
#include <vector>

using namespace sensornoise;
using namespace sensornoise::test;

namespace
{
constexpr std::size_t Width = 160;
constexpr std::size_t Height = 130;
constexpr std::size_t Pixels = Width * Height;
constexpr std::size_t Frames = 30;
constexpr double      Gain = 0.5;
constexpr double      OffsetDn = 100.0;
constexpr double      ReadNoiseDn2 = 9.0;
/** Feedback of a burst with one lit frame in ten: gamma is 9 or -1, sum gamma^3 / sum gamma^2 = 8, and 28 degrees of
 * freedom remain. */
constexpr double Feedback = 8.0 / 28.0;

std::vector<double>
LitFrames()
{
  std::vector<double> gamma(Frames, -1.0);
  gamma[4] = gamma[14] = gamma[24] = 9.0;
  return gamma;
}

/** Burst with the illumination 1 + gamma, whose noise is multiplied by \a noise. */
struct Burst
{
  std::vector<double>       gamma{ LitFrames() };
  TemporalBasis             basis{ gamma,
                       Eigen::MatrixXd(static_cast<Eigen::Index>(Frames), 0),
                       Eigen::MatrixXd(static_cast<Eigen::Index>(Frames), 0) };
  ReferenceFrame            frame;
  InitialNoiseModel         model;
  MotionSeries              motion;
  std::vector<std::uint8_t> mask;
  ResidualSquares           squares;

  explicit Burst(double noise, std::uint64_t seed = 3)
  {
    const std::vector<double> scene = WavyScene(Width, Height);
    std::vector<double>       stack(Pixels * Frames);
    CounterSeededRandom       random(seed);
    std::vector<double>       mean(Pixels, 0.0);
    std::vector<double>       variance(Pixels, 0.0);
    for (std::size_t i = 0; i < stack.size(); ++i)
    {
      const std::size_t p = i % Pixels;
      const double      signal = (1.0 + gamma[i / Pixels]) * (scene[p] - OffsetDn);
      stack[i] = OffsetDn + signal + noise * std::sqrt(ReadNoiseDn2 + Gain * signal) * random.Normal();
      mean[p] += stack[i] / Frames;
    }
    for (std::size_t i = 0; i < stack.size(); ++i)
    {
      const double deviation = stack[i] - mean[i % Pixels];
      variance[i % Pixels] += deviation * deviation / (Frames - 1.0);
    }
    frame =
      MakeReferenceFrame(mean, variance, std::vector<std::uint8_t>(Pixels, 1), { Width, Height, 1 }, Frames, SerialFor);
    mask = frame.usable;
    ProjectionSums sums(Pixels, basis.Size());
    sums.AddFrames(ProjectedFrames(basis, stack.data(), PixelLayout::OfFrames({ Pixels, 1, 1 }), 0, Frames), 0, Pixels);
    PixelCoordinates none;
    AppendResidualSquares(frame, basis, sums, SerialFor, squares, none);
    model.interceptDn2 = 200.0;
    model.slopeDn = Gain;
    model.darkestDn = 300.0;
    motion.inverseGram.resize(0, 0);
  }
  ProjectedSquares
  Project()
  {
    return { frame, basis, motion, std::move(squares), model, mask, SerialFor, { gamma, OffsetDn } };
  }
};

VarianceLine
TrueLine()
{
  VarianceLine line;
  line.gain = Gain;
  line.intercept = ReadNoiseDn2 - Gain * OffsetDn;
  line.lowestDn2 = 1.0;
  line.pivotDn = 1000.0;
  line.weightSum = 2.0;
  line.spreadDn2 = 5000.0;
  line.isDetermined = true;
  return line;
}
} // namespace

TEST(SensorNoiseGainFeedback, IsTheThirdMomentOfTheIlluminationOverItsSecond)
{
  Burst                  burst(0.0);
  const ProjectedSquares projected = burst.Project();
  const GainFeedback     feedback({ projected, 0.0 }, TrueLine(), burst.mask, SerialFor);
  EXPECT_NEAR(feedback.GetOfGain(), Feedback, 1e-6); // numbers with 24 bits
  EXPECT_TRUE(feedback.IsLarge());
  EXPECT_FALSE(GainFeedback().IsLarge());
}

TEST(SensorNoiseGainFeedback, SettledLineIsWhereTheIterationEnds)
{
  const GainFeedback feedback(0.8, -80.0);
  // The result of a fit of V = 0.1 x - 1, with the correction of a gain, which is 0.8 x - 80 per unit of gain.
  const auto fit = [](double gain) {
    VarianceLine line;
    line.isDetermined = true;
    line.gain = 0.1 + 0.8 * gain;
    line.intercept = -1.0 - 80.0 * gain;
    line.covariance << 4.0, -1.0, -1.0, 9.0;
    return line;
  };
  double gain = 0.0;
  for (int i = 0; i < 200; ++i)
  {
    gain = fit(gain).gain;
  }
  const VarianceLine settled = feedback.SolveFixedPoint(fit(0.2), 0.2);
  EXPECT_NEAR(settled.gain, gain, 1e-12);
  EXPECT_NEAR(settled.gain, 0.5, 1e-12);
  EXPECT_NEAR(settled.intercept, fit(gain).intercept, 1e-12);
  EXPECT_NEAR(settled.covariance(0, 0), 4.0 / 0.04, 1e-9);
  // The variance of intercept + e gain / (1 - d) is 9 + 2 (-400) (-1) + 400^2 4.
  EXPECT_NEAR(settled.covariance(1, 1), 9.0 + 800.0 + 640000.0, 1e-6);
}

TEST(SensorNoiseGainFeedback, WithoutAFeedbackTheLineIsUnchanged)
{
  VarianceLine line = TrueLine();
  line.covariance << 4.0, -1.0, -1.0, 9.0;
  const VarianceLine same = GainFeedback(0.009, -1.0).SolveFixedPoint(line, 7.0);
  EXPECT_EQ(same.gain, line.gain);
  EXPECT_EQ(same.covariance, line.covariance);
  // One lit frame has no residual: the result contains nothing but the assumed gain.
  const VarianceLine none = GainFeedback(1.0, -100.0).SolveFixedPoint(line, 7.0);
  EXPECT_EQ(none.gain, line.gain);
  EXPECT_NEAR(none.covariance(0, 0),
              4.0 + std::pow(line.At(1000.0) / 50.0, 2),
              1e-9); // the standard deviation of the levels is 50 DN
}

TEST(SensorNoiseGainFeedback, FitEndsAtTheGainFromWhereverItStarts)
{
  Burst                  burst(1.0);
  const ProjectedSquares projected = burst.Project();
  const auto             use = std::vector<std::uint8_t>(Pixels, 0);
  const auto             good = FitStaticVariance(projected, burst.mask, use, Gain, OffsetDn, OffsetDn, SerialFor);
  const auto         bad = FitStaticVariance(projected, burst.mask, use, 20.0 * Gain, OffsetDn, OffsetDn, SerialFor);
  const VarianceLine line = good.line;
  ASSERT_TRUE(line.isDetermined);
  ASSERT_TRUE(bad.line.isDetermined);
  const double error = std::sqrt(line.covariance(0, 0));
  EXPECT_NEAR(line.gain, Gain, 4.0 * error);
  EXPECT_LT(error, 0.03 * Gain);
  // The pixels found static depend slightly on the start. Without SolveFixedPoint(), three steps leave d^3 of 9.5
  // DN/e-.
  EXPECT_NEAR(bad.line.gain, line.gain, 0.3 * error);
  EXPECT_NEAR(good.correctingGain, line.gain, 0.1 * error);
}
