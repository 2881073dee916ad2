// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_test_NoiseCorrelationTestHelper_h
#define sensornoise_test_NoiseCorrelationTestHelper_h

#include "itkImage.h"
#include "itkNoiseCorrelationEstimator.h"
#include "helpers/PipelineTestHelper.h"

#include <cmath>
#include <cstddef>
#include <functional>
#include <random>
#include <string>
#include <type_traits>
#include <vector>

/** \file
 * Flat fields whose noise is known, and the estimator on them. */

namespace sensornoisetest::correlation
{
using FloatStack = itk::Image<float, 3>;
inline constexpr unsigned int Width = 160;
inline constexpr unsigned int Height = 128;
inline constexpr unsigned int Frames = 30;
inline constexpr double       Level = 100.0;
inline constexpr double       NoiseSd = 3.0;

/** Number that is added to a value at (x, y, t). */
using Addition = std::function<double(std::size_t x, std::size_t y, std::size_t t)>;

/** Kernels along x and time, from lag 0 backwards; of one value: nothing is filtered. */
struct Kernels
{
  std::vector<double> alongX{ 1.0 };
  std::vector<double> alongTime{ 1.0 };
};

/** Returns a flat field of 100 DN whose noise is normal, of 3 DN before it is filtered; values are rounded for
 * integers. */
template <typename TStack = FloatStack>
typename TStack::Pointer
FlatStack(
  const Kernels &  kernels = {},
  const Addition & addition = [](std::size_t, std::size_t, std::size_t) { return 0.0; },
  unsigned int     width = Width,
  unsigned int     height = Height)
{
  const std::size_t                longer = kernels.alongTime.size() - 1;
  const std::size_t                wider = kernels.alongX.size() - 1;
  const std::size_t                frames = Frames + longer;
  const std::size_t                row = width + wider;
  std::mt19937                     random(5);
  std::normal_distribution<double> normal(0.0, NoiseSd);
  std::vector<double>              noise(frames * height * row);
  for (double & value : noise)
  {
    value = normal(random);
  }
  return ImageOf<TStack>({ { width, height, Frames } }, [&](const auto & index) {
    const auto x = static_cast<std::size_t>(index[0]);
    const auto y = static_cast<std::size_t>(index[1]);
    const auto t = static_cast<std::size_t>(index[2]);
    double     value = Level + addition(x, y, t);
    for (std::size_t j = 0; j <= longer; ++j)
    {
      for (std::size_t i = 0; i <= wider; ++i)
      {
        value +=
          kernels.alongTime[j] * kernels.alongX[i] * noise[((t + longer - j) * height + y) * row + x + wider - i];
      }
    }
    return std::is_integral_v<typename TStack::PixelType> ? std::round(value) : value;
  });
}

template <typename TStack>
auto
CorrelationOf(const TStack * stack)
{
  auto estimator = itk::NoiseCorrelationEstimator<TStack>::New();
  estimator->SetInput(stack);
  return estimator;
}

template <typename TEstimator>
std::string
JsonOf(const TEstimator & estimator)
{
  EXPECT_EQ(ErrorOf(estimator), "no error");
  return estimator->GetResultAsJson();
}

} // namespace sensornoisetest::correlation

#endif
