// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_test_FrameTestHelper_h
#define sensornoise_test_FrameTestHelper_h

#include "base/Eigen.h"
#include "sensornoise/Parallel.h"
#include "base/Stencils.h"
#include "scene/InitialNoiseModel.h"
#include "scene/ReferenceFrame.h"
#include "series/FrameSums.h"
#include "series/FrameRegressors.h"
#include "series/RegressorBand.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <utility>
#include <vector>

/** \file
 * Frames that are made of the mean and its derivatives, for the regression of frames. */

namespace sensornoise::test
{

/** Largest relative error by the rounding of single precision: of a product of six rounded numbers, and of a sum of
 * such products by RegressorBand. */
inline const double RoundingOfProducts = 6.0 * std::exp2(-24.0);
inline const double RoundingOfSums = RoundingOfProducts + PixelsOfSingleSum * std::exp2(-24.0);

/** Returns a map of waves of all directions and lengths above 5 pixels, from about 400 to 1,600. */
inline std::vector<double>
WavyScene(std::size_t width, std::size_t height)
{
  std::mt19937                     random(8);
  std::uniform_real_distribution<> uniform(0.0, 1.0);
  std::vector<double>              map(width * height, 1000.0);
  for (int wave = 0; wave < 12; ++wave)
  {
    const double length = 5.0 + 20.0 * uniform(random);
    const double direction = 6.2831853 * uniform(random);
    const double phase = 6.2831853 * uniform(random);
    for (std::size_t p = 0; p < map.size(); ++p)
    {
      const double along =
        std::cos(direction) * static_cast<double>(p % width) + std::sin(direction) * static_cast<double>(p / width);
      map[p] += 100.0 * std::sin(6.2831853 * along / length + phase);
    }
  }
  return map;
}

/** Change of one frame from the mean: level + slope mean + sum_k motion_k D_k mean. */
struct FrameChange
{
  double                               level{ 0.0 };
  double                               slope{ 0.0 };
  std::array<double, NumberOfStencils> motion{};
};

/** Frames of \a T in double precision, their reference and a noise model. */
struct SyntheticFrames
{
  ReferenceFrame            reference;
  InitialNoiseModel         model;
  std::vector<std::uint8_t> take;
  std::vector<double>       pixels; ///< frame after frame

  SyntheticFrames(std::size_t width, std::size_t height, const std::vector<FrameChange> & changes, double noise = 0.0)
  {
    const std::vector<double> mean = WavyScene(width, height);
    reference = MakeReferenceFrame(mean,
                                   std::vector<double>(mean.size(), 50.0),
                                   std::vector<std::uint8_t>(mean.size(), 1),
                                   { width, height, 1 },
                                   changes.size());
    take = reference.usable;
    model.darkestDn = 300.0;
    model.centreDn = 950.0;
    model.brightestDn = 1700.0;
    model.interceptDn2 = 30.0;
    model.slopeDn = 0.5;
    std::mt19937               random(17);
    std::normal_distribution<> normal(0.0, 1.0);
    for (const FrameChange & change : changes)
    {
      for (std::size_t p = 0; p < mean.size(); ++p)
      {
        double value = (1.0 + change.slope) * mean[p] + change.level;
        for (std::size_t k = 0; k < NumberOfStencils && take[p] != 0; ++k)
        {
          value += change.motion[k] * this->Derivative(k, p);
        }
        pixels.push_back(value + noise * std::sqrt(model.NoiseVariance(reference.neighbourMean[p])) * normal(random));
      }
    }
  }

  std::size_t
  Frames() const
  {
    return reference.frames;
  }
  std::size_t
  Pixels() const
  {
    return reference.mean.size();
  }
  const double *
  Frame(std::size_t t) const
  {
    return pixels.data() + t * this->Pixels();
  }
  double
  Derivative(std::size_t k, std::size_t p) const
  {
    return ApplyStencil(MotionStencils()[k], reference.mean.data(), reference.geometry.width, p);
  }
  double
  Weight(std::size_t p) const
  {
    return 1.0 / model.NoiseVariance(reference.neighbourMean[p]);
  }
  /** Returns the columns of the regression at a pixel: 1, mean - centre, derivatives. */
  Eigen::Matrix<double, FrameColumns, 1>
  ColumnsOf(std::size_t p) const
  {
    Eigen::Matrix<double, FrameColumns, 1> columns;
    columns(0) = 1.0;
    columns(1) = reference.mean[p] - model.centreDn;
    for (std::size_t k = 0; k < NumberOfStencils; ++k)
    {
      columns(static_cast<Eigen::Index>(2 + k)) = this->Derivative(k, p);
    }
    return columns;
  }
  /** Sums without frames. */
  FrameSums
  EmptySums(const ParallelFor & parallelFor = SerialFor) const
  {
    ShiftInstruments instruments{ SmoothedDerivative(reference, StencilX, parallelFor),
                                  SmoothedDerivative(reference, StencilY, parallelFor),
                                  std::vector<float>(this->Pixels(), 1e-3F) };
    return FrameSums(FrameRegressors(reference, model, take, std::move(instruments)), parallelFor);
  }
  FrameSums
  Sums() const
  {
    FrameSums sums = this->EmptySums();
    sums.AddFrames(pixels.data(), 0, this->Frames(), SerialFor);
    return sums;
  }
};

/** Changes with flicker of 10 % about \a offset and motion of \a motion pixels or so, all different. */
inline std::vector<FrameChange>
FlickerAndMotion(std::size_t frames, double offset, double motion)
{
  std::mt19937               random(29);
  std::normal_distribution<> normal(0.0, 1.0);
  std::vector<FrameChange>   changes(frames);
  for (FrameChange & change : changes)
  {
    change.slope = 0.1 * normal(random);
    change.level = -offset * change.slope;
    for (double & coefficient : change.motion)
    {
      coefficient = motion * normal(random);
    }
  }
  return changes;
}

} // namespace sensornoise::test

#endif
