// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "simulation/FrameResampling.h"

#include "simulation/CubicShift.h"
#include "simulation/LinearShift.h"
#include "simulation/SettingChecks.h"

#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <string>

namespace sensornoise
{
namespace
{
DoubleFrame
ResampleLinearly(const DoubleFrame & codesDn, const ResamplingSettings & settings, const ParallelFor & parallelFor)
{
  const LinearShift horizontal(settings.shiftXPixels, codesDn.width);
  const LinearShift vertical(settings.shiftYPixels, codesDn.height);
  DoubleFrame       out(codesDn.width, codesDn.height);
  parallelFor(codesDn.height, [&](std::size_t y) {
    const double * above = codesDn.Row(vertical.First(y));
    const double * below = codesDn.Row(vertical.Second(y));
    for (std::size_t x = 0; x < codesDn.width; ++x)
    {
      const std::size_t left = horizontal.First(x);
      const std::size_t right = horizontal.Second(x);
      out.Row(y)[x] =
        vertical.Blend(horizontal.Blend(above[left], above[right]), horizontal.Blend(below[left], below[right]));
    }
  });
  return out;
}

DoubleFrame
ResampleCubically(const DoubleFrame & codesDn, const ResamplingSettings & settings, const ParallelFor & parallelFor)
{
  const CubicShift horizontal(settings.shiftXPixels, codesDn.width);
  const CubicShift vertical(settings.shiftYPixels, codesDn.height);
  DoubleFrame      out(codesDn.width, codesDn.height);
  parallelFor(codesDn.height, [&](std::size_t y) {
    for (std::size_t x = 0; x < codesDn.width; ++x)
    {
      double sum = 0.0;
      for (std::size_t j = 0; j < CubicShift::NumberOfTaps; ++j)
      {
        const double * row = codesDn.Row(vertical.Tap(y, j));
        double         along = 0.0;
        for (std::size_t i = 0; i < CubicShift::NumberOfTaps; ++i)
        {
          along += horizontal.Weight(i) * row[horizontal.Tap(x, i)];
        }
        sum += vertical.Weight(j) * along;
      }
      out.Row(y)[x] = sum;
    }
  });
  return out;
}
} // namespace

void
CheckSettings(const ResamplingSettings & settings)
{
  const auto requireShift = [](double shift, const char * name) {
    RequireSetting(std::abs(shift) <= 1000.0, name, shift, "-1000 to 1000 pixels");
  };
  requireShift(settings.shiftXPixels, "horizontal shift of the resampling");
  requireShift(settings.shiftYPixels, "vertical shift of the resampling");
  if (settings.interpolation == Interpolation::Nearest)
  {
    throw std::invalid_argument(std::string("the interpolation of the resampling is ") +
                                NameOf(settings.interpolation) + "; expected linear or cubic");
  }
}

DoubleFrame
ResampleFrame(const DoubleFrame & codesDn, const ResamplingSettings & settings, const ParallelFor & parallelFor)
{
  return settings.interpolation == Interpolation::Cubic ? ResampleCubically(codesDn, settings, parallelFor)
                                                        : ResampleLinearly(codesDn, settings, parallelFor);
}

} // namespace sensornoise
