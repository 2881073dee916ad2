// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "published/VibrationMask.h"

#include <cmath>
#include <stdexcept>
#include <string>

namespace sensornoise
{

double
ChiSquare2Quantile(double level)
{
  if (!(level > 0.0 && level < 1.0))
  {
    throw std::invalid_argument("the level of the vibration test is " + std::to_string(level) +
                                "; expected a probability between 0 and 1");
  }
  return -2.0 * std::log(level);
}

void
TestVibrationOfRow(const double *       mean,
                   std::ptrdiff_t       stride,
                   const double *       variance,
                   const std::uint8_t * valid,
                   std::size_t          count,
                   std::size_t          frames,
                   double               quantile,
                   std::uint8_t *       kept)
{
  const double scale = 2.0 * static_cast<double>(frames);
  for (std::size_t x = 0; x < count; ++x)
  {
    const double * const centre = mean + x;
    const double         dx = 0.5 * (centre[1] - centre[-1]);
    const double         dy = 0.5 * (centre[stride] - centre[-stride]);
    const bool           still = scale * (dx * dx + dy * dy) < quantile * variance[x];
    kept[x] = still && (valid == nullptr || valid[x] != 0) ? 1 : 0;
  }
}

std::vector<std::uint8_t>
VibrationMask(const double *       mean,
              const double *       variance,
              const std::uint8_t * valid,
              std::size_t          width,
              std::size_t          height,
              std::size_t          frames,
              double               level,
              const ParallelFor &  parallelFor)
{
  const double              quantile = ChiSquare2Quantile(level);
  std::vector<std::uint8_t> mask(width * height, 0);
  parallelFor(width > 2 && height > 2 ? height - 2 : 0, [&](std::size_t above) {
    const std::size_t p = (above + 1) * width + 1;
    TestVibrationOfRow(mean + p,
                       static_cast<std::ptrdiff_t>(width),
                       variance + p,
                       valid == nullptr ? nullptr : valid + p,
                       width - 2,
                       frames,
                       quantile,
                       mask.data() + p);
  });
  return mask;
}

} // namespace sensornoise
