// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "simulation/FrameProcessing.h"

#include "simulation/SettingChecks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <utility>

namespace sensornoise
{
namespace
{
constexpr std::array<std::pair<Interpolation, const char *>, 3> InterpolationNames{
  { { Interpolation::Nearest, "nearest" }, { Interpolation::Linear, "linear" }, { Interpolation::Cubic, "cubic" } }
};
} // namespace

const char *
NameOf(Interpolation interpolation)
{
  for (const auto & [known, name] : InterpolationNames)
  {
    if (known == interpolation)
    {
      return name;
    }
  }
  return "unknown";
}

Interpolation
InterpolationOf(const std::string & name)
{
  for (const auto & [interpolation, known] : InterpolationNames)
  {
    if (name == known)
    {
      return interpolation;
    }
  }
  throw std::invalid_argument("the interpolation \"" + name + "\" is not known; expected nearest, linear or cubic");
}

namespace
{
DoubleFrame
MeanOfSquares(const DoubleFrame & frame, std::size_t side, const ParallelFor & parallelFor)
{
  DoubleFrame means((frame.width + side - 1) / side, (frame.height + side - 1) / side);
  parallelFor(means.height, [&](std::size_t row) {
    const std::size_t endY = std::min((row + 1) * side, frame.height);
    for (std::size_t column = 0; column < means.width; ++column)
    {
      const std::size_t endX = std::min((column + 1) * side, frame.width);
      double            sum = 0.0;
      for (std::size_t y = row * side; y < endY; ++y)
      {
        for (std::size_t x = column * side; x < endX; ++x)
        {
          sum += frame.Row(y)[x];
        }
      }
      means.Row(row)[column] = sum / static_cast<double>((endX - column * side) * (endY - row * side));
    }
  });
  return means;
}

/** The two squares along an axis between whose centres a pixel lies, and its distance from the first one in units of
 * their distance. */
struct BetweenSquares
{
  std::size_t first;
  std::size_t second;
  double      fraction;

  BetweenSquares(std::size_t pixel, const BinningSettings & settings, std::size_t squares)
    : first(pixel / settings.factor)
    , second(first)
    , fraction(0.0)
  {
    if (settings.interpolation == Interpolation::Linear)
    {
      const double at = (static_cast<double>(pixel) + 0.5) / settings.factor - 0.5;
      const double before = std::floor(at);
      const double last = static_cast<double>(squares) - 1.0;
      first = static_cast<std::size_t>(std::clamp(before, 0.0, last));
      second = static_cast<std::size_t>(std::clamp(before + 1.0, 0.0, last));
      fraction = at - before;
    }
  }
  double
  Blend(double atFirst, double atSecond) const
  {
    return atFirst + fraction * (atSecond - atFirst);
  }
};
} // namespace

void
CheckSettings(const BinningSettings & settings)
{
  RequireSetting(settings.factor >= 1 && settings.factor <= 64, "factor of the binning", settings.factor, "1 to 64");
  if (settings.interpolation == Interpolation::Cubic)
  {
    throw std::invalid_argument(std::string("the interpolation of the binning is ") + NameOf(settings.interpolation) +
                                "; expected nearest or linear");
  }
}

DoubleFrame
BinFrame(const DoubleFrame & codesDn, const BinningSettings & settings, const ParallelFor & parallelFor)
{
  const DoubleFrame squares = MeanOfSquares(codesDn, settings.factor, parallelFor);
  DoubleFrame       out(codesDn.width, codesDn.height);
  parallelFor(codesDn.height, [&](std::size_t y) {
    const BetweenSquares vertical(y, settings, squares.height);
    const double *       above = squares.Row(vertical.first);
    const double *       below = squares.Row(vertical.second);
    for (std::size_t x = 0; x < codesDn.width; ++x)
    {
      const BetweenSquares across(x, settings, squares.width);
      out.Row(y)[x] = vertical.Blend(across.Blend(above[across.first], above[across.second]),
                                     across.Blend(below[across.first], below[across.second]));
    }
  });
  return out;
}

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
