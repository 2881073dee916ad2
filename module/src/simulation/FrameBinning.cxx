// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "simulation/FrameBinning.h"

#include "simulation/SettingChecks.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <string>

namespace sensornoise
{
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

} // namespace sensornoise
