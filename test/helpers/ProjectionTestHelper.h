// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_test_ProjectionTestHelper_h
#define sensornoise_test_ProjectionTestHelper_h

#include "base/Eigen.h"
#include "sensornoise/Parallel.h"
#include "pixels/ProjectionSums.h"
#include "pixels/ProjectedVariance.h"
#include "scene/InitialNoiseModel.h"
#include "scene/ReferenceFrame.h"
#include "series/FrameEquations.h"
#include "series/SceneSeries.h"
#include "helpers/FrameTestHelper.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <utility>
#include <vector>

/** \file
 * Time series of pixels, for their projection on a basis. */

namespace sensornoise::test::projection
{

inline constexpr std::size_t Width = 80;
inline constexpr std::size_t Height = 65;
inline constexpr std::size_t Pixels = Width * Height;
inline constexpr std::size_t Frames = 30;
inline constexpr std::size_t IlluminationFactors = 2;

inline Eigen::VectorXd
Wave(double periods, double phase)
{
  Eigen::VectorXd series(Frames);
  for (Eigen::Index t = 0; t < series.size(); ++t)
  {
    series(t) = std::sin(6.283185307179586 * periods * static_cast<double>(t) / Frames + phase) + 0.3 * (t % 3 == 0);
  }
  return series;
}

/** Returns two components of the illumination and one of motion. */
inline const TemporalBasis &
Basis()
{
  static const auto basis = [] {
    const Eigen::VectorXd     flicker = Wave(2.0, 0.3);
    const std::vector<double> gamma(flicker.data(), flicker.data() + Frames);
    return TemporalBasis(gamma, Wave(3.3, 1.0), Wave(7.1, 2.0));
  }();
  return basis;
}

/** Returns noise of 20 DN: time series of every pixel, one a column. */
inline Eigen::MatrixXd
NormalSeries()
{
  std::mt19937               random(51);
  std::normal_distribution<> normal(0.0, 20.0);
  Eigen::MatrixXd            series(Frames, Pixels);
  for (Eigen::Index i = 0; i < series.size(); ++i)
  {
    series(i) = normal(random);
  }
  return series;
}

/** Input of the projection: a stack, frame after frame, with its moments and sums. */
struct Input
{
  ReferenceFrame            frame;
  InitialNoiseModel         model;
  MotionSeries              motion;
  ProjectionSums            sums; // until they are projected
  std::vector<std::uint8_t> mask;

  PixelCoordinates coordinates; // on the illumination components

  explicit Input(const Eigen::MatrixXd & series)
    : sums(Pixels, Basis().Size())
    , coordinates(Pixels, Basis().NumberOfIlluminationFactors())
  {
    std::vector<double> mean = WavyScene(Width, Height);
    std::vector<double> variance(Pixels);
    std::vector<double> stack(Pixels * Frames);
    for (std::size_t p = 0; p < Pixels; ++p)
    {
      const Eigen::VectorXd values = series.col(static_cast<Eigen::Index>(p)).array() + mean[p];
      mean[p] = values.mean();
      variance[p] = (values.array() - mean[p]).square().sum() / (Frames - 1.0);
      for (std::size_t t = 0; t < Frames; ++t)
      {
        stack[t * Pixels + p] = values(static_cast<Eigen::Index>(t));
      }
    }
    frame =
      MakeReferenceFrame(mean, variance, std::vector<std::uint8_t>(Pixels, 1), { Width, Height, 1 }, Frames, SerialFor);
    mask = frame.usable;
    sums.AddFrames(
      ProjectedFrames(Basis(), stack.data(), PixelLayout::OfFrames({ Pixels, 1, 1 }), 0, Frames), 0, Pixels);
    model.interceptDn2 = 100.0;
    model.slopeDn = 0.3;
    model.darkestDn = 300.0;
    motion.inverseGram.resize(0, 0);
  }
  /** Once: the sums are turned into coordinates. */
  ProjectedSquares
  Project(const ParallelFor & parallelFor = SerialFor, const FrameIllumination & illumination = {})
  {
    ResidualSquares squares;
    AppendResidualSquares(frame, Basis(), sums, parallelFor, squares, coordinates);
    return { frame, Basis(), motion, std::move(squares), model, mask, parallelFor, illumination };
  }
};

} // namespace sensornoise::test::projection

#endif
