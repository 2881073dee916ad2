// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "emva1288/HighpassFilter.h"

namespace sensornoise
{

namespace
{
constexpr std::size_t Taps = 2 * EmvaFilterRadius + 1;

/** Returns the convolution of two kernels. */
std::vector<double>
Convolve(const std::vector<double> & a, const std::vector<double> & b)
{
  std::vector<double> result(a.size() + b.size() - 1, 0.0);
  for (std::size_t i = 0; i < a.size(); ++i)
  {
    for (std::size_t j = 0; j < b.size(); ++j)
    {
      result[i + j] += a[i] * b[j];
    }
  }
  return result;
}

std::array<double, Taps>
MakeKernel()
{
  const auto box = [](std::size_t taps) { return std::vector<double>(taps, 1.0 / static_cast<double>(taps)); };
  const std::vector<double> taps = Convolve(Convolve(box(7), box(11)), { 0.25, 0.5, 0.25 });
  std::array<double, Taps>  kernel{};
  for (std::size_t k = 0; k < Taps; ++k)
  {
    kernel[k] = taps[k];
  }
  return kernel;
}
} // namespace

const std::array<double, Taps> &
EmvaLowpassKernel()
{
  static const std::array<double, Taps> kernel = MakeKernel();
  return kernel;
}

bool
HasRoomForHighpass(std::size_t width, std::size_t height)
{
  constexpr std::size_t least = Taps + 2; // three columns and rows are left
  return width >= least && height >= least;
}

HighpassImage
FilterHighpass(const std::vector<double> & image,
               std::size_t                 width,
               std::size_t                 height,
               const ParallelFor &         parallelFor)
{
  const auto &  kernel = EmvaLowpassKernel();
  HighpassImage result{ width - Taps + 1, height - Taps + 1, {} };
  result.pixels.resize(result.columns * result.rows);
  parallelFor(result.rows, [&](std::size_t row) {
    std::vector<double> columns(width, 0.0); // lowpass along y
    for (std::size_t k = 0; k < Taps; ++k)
    {
      const double * const source = image.data() + (row + k) * width;
      const double         weight = kernel[k];
      for (std::size_t x = 0; x < width; ++x)
      {
        columns[x] += weight * source[x];
      }
    }
    double * const out = result.pixels.data() + row * result.columns;
    for (std::size_t x = 0; x < result.columns; ++x)
    {
      out[x] = image[(row + EmvaFilterRadius) * width + x + EmvaFilterRadius];
    }
    for (std::size_t k = 0; k < Taps; ++k)
    {
      for (std::size_t x = 0; x < result.columns; ++x)
      {
        out[x] -= kernel[k] * columns[x + k];
      }
    }
  });
  return result;
}

} // namespace sensornoise
