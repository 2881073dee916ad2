// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "simulation/FrameProcessing.h"


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
BinFrame(const DoubleFrame & valuesDn, const BinningSettings & settings, const ParallelFor & parallelFor)
{
  const DoubleFrame squares = MeanOfSquares(valuesDn, settings.factor, parallelFor);
  DoubleFrame       out(valuesDn.width, valuesDn.height);
  parallelFor(valuesDn.height, [&](std::size_t y) {
    const BetweenSquares vertical(y, settings, squares.height);
    const double *       above = squares.Row(vertical.first);
    const double *       below = squares.Row(vertical.second);
    for (std::size_t x = 0; x < valuesDn.width; ++x)
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
ResampleLinearly(const DoubleFrame & valuesDn, const ResamplingSettings & settings, const ParallelFor & parallelFor)
{
  const LinearShift horizontal(settings.shiftXPixels, valuesDn.width);
  const LinearShift vertical(settings.shiftYPixels, valuesDn.height);
  DoubleFrame       out(valuesDn.width, valuesDn.height);
  parallelFor(valuesDn.height, [&](std::size_t y) {
    const double * above = valuesDn.Row(vertical.First(y));
    const double * below = valuesDn.Row(vertical.Second(y));
    for (std::size_t x = 0; x < valuesDn.width; ++x)
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
ResampleCubically(const DoubleFrame & valuesDn, const ResamplingSettings & settings, const ParallelFor & parallelFor)
{
  const CubicShift horizontal(settings.shiftXPixels, valuesDn.width);
  const CubicShift vertical(settings.shiftYPixels, valuesDn.height);
  DoubleFrame      out(valuesDn.width, valuesDn.height);
  parallelFor(valuesDn.height, [&](std::size_t y) {
    for (std::size_t x = 0; x < valuesDn.width; ++x)
    {
      double sum = 0.0;
      for (std::size_t j = 0; j < CubicShift::NumberOfTaps; ++j)
      {
        const double * row = valuesDn.Row(vertical.Tap(y, j));
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
ResampleFrame(const DoubleFrame & valuesDn, const ResamplingSettings & settings, const ParallelFor & parallelFor)
{
  return settings.interpolation == Interpolation::Cubic ? ResampleCubically(valuesDn, settings, parallelFor)
                                                        : ResampleLinearly(valuesDn, settings, parallelFor);
}

namespace
{
constexpr std::size_t Side = 8;
using Block = std::array<double, Side * Side>;

/** Table K.1 of T.81: quantization steps of the luminance at quality 50, in 8-bit DN. */
constexpr std::array<unsigned int, Side * Side> LuminanceSteps{ 16, 11, 10, 16, 24,  40,  51,  61,  //
                                                                12, 12, 14, 19, 26,  58,  60,  55,  //
                                                                14, 13, 16, 24, 40,  57,  69,  56,  //
                                                                14, 17, 22, 29, 51,  87,  80,  62,  //
                                                                18, 22, 37, 56, 68,  109, 103, 77,  //
                                                                24, 35, 55, 64, 81,  104, 113, 92,  //
                                                                49, 64, 78, 87, 103, 121, 120, 101, //
                                                                72, 92, 95, 98, 112, 100, 103, 99 };

/** Returns the orthonormal cosine transform along one axis: row k has the cosine of frequency k. */
const Block &
CosineRows()
{
  static const Block rows = [] {
    constexpr double pi = 3.14159265358979323846;
    Block            made{};
    for (std::size_t k = 0; k < Side; ++k)
    {
      for (std::size_t x = 0; x < Side; ++x)
      {
        const double angle = pi * static_cast<double>((2 * x + 1) * k) / (2.0 * Side);
        made[k * Side + x] = std::sqrt((k == 0 ? 1.0 : 2.0) / Side) * std::cos(angle);
      }
    }
    return made;
  }();
  return rows;
}

/** Transforms a block along both axes.
 * \param isInverse whether coefficients are transformed to pixels, with the transposed rows */
Block
Transform(const Block & in, bool isInverse)
{
  const Block & cosines = CosineRows();
  const auto    along = [&](const Block & from) { // transforms each row of `from`; the result is transposed
    Block to{};
    for (std::size_t row = 0; row < Side; ++row)
    {
      for (std::size_t k = 0; k < Side; ++k)
      {
        double sum = 0.0;
        for (std::size_t x = 0; x < Side; ++x)
        {
          sum += from[row * Side + x] * (isInverse ? cosines[x * Side + k] : cosines[k * Side + x]);
        }
        to[k * Side + row] = sum;
      }
    }
    return to;
  };
  return along(along(in));
}

Block
Quantise(const Block & pixels, const BlockStepsDn & stepsDn)
{
  Block coefficients = Transform(pixels, false);
  for (std::size_t i = 0; i < coefficients.size(); ++i)
  {
    coefficients[i] = stepsDn[i] * std::round(coefficients[i] / stepsDn[i]);
  }
  return Transform(coefficients, true);
}
} // namespace

void
CheckSettings(const BlockSettings & settings, unsigned int bitDepth)
{
  RequireSetting(settings.quality <= 100, "quality of the block quantization", settings.quality, "0 to 100");
  RequireSetting(!settings.IsOn() || bitDepth > 0,
                 "bit depth",
                 bitDepth,
                 "1 or more, for the block quantization needs the converter's range");
}

BlockStepsDn
StepsOfQuality(const BlockSettings & settings, unsigned int bitDepth)
{
  const unsigned int quality = settings.quality;
  const unsigned int percent = quality < 50 ? 5000 / quality : 200 - 2 * quality;
  const double       stepOf8BitsDn = (std::ldexp(1.0, static_cast<int>(bitDepth)) - 1.0) / 255.0;
  BlockStepsDn       stepsDn{};
  std::transform(LuminanceSteps.begin(), LuminanceSteps.end(), stepsDn.begin(), [=](unsigned int step) {
    return stepOf8BitsDn * std::clamp((step * percent + 50) / 100, 1U, 255U);
  });
  return stepsDn;
}

DoubleFrame
QuantiseBlocks(const DoubleFrame & valuesDn, const BlockStepsDn & stepsDn, const ParallelFor & parallelFor)
{
  DoubleFrame out(valuesDn.width, valuesDn.height);
  parallelFor((valuesDn.height + Side - 1) / Side, [&](std::size_t blockRow) {
    const std::size_t top = blockRow * Side;
    for (std::size_t left = 0; left < valuesDn.width; left += Side)
    {
      Block pixels{};
      for (std::size_t i = 0; i < pixels.size(); ++i)
      {
        const std::size_t y = std::min(top + i / Side, valuesDn.height - 1);
        pixels[i] = valuesDn.Row(y)[std::min(left + i % Side, valuesDn.width - 1)];
      }
      pixels = Quantise(pixels, stepsDn);
      for (std::size_t y = top; y < std::min(top + Side, valuesDn.height); ++y)
      {
        const std::size_t columns = std::min(Side, valuesDn.width - left);
        std::copy_n(pixels.data() + (y - top) * Side, columns, out.Row(y) + left);
      }
    }
  });
  return out;
}

void
CheckSettings(const CompandingSettings & settings, unsigned int bitDepth)
{
  if (!settings.IsOn())
  {
    return;
  }
  RequireSetting(
    settings.bits >= 2 && settings.bits <= 16, "number of bits of the companding", settings.bits, "0 or 2 to 16");
  RequireSetting(bitDepth > 0, "bit depth", bitDepth, "1 or more, for companding needs the converter's range");
}

void
Compand(double * valuesDn, std::size_t count, const CompandingSettings & settings, unsigned int bitDepth)
{
  const double top = std::ldexp(1.0, static_cast<int>(bitDepth)) - 1.0;
  const double storedTop = std::ldexp(1.0, static_cast<int>(settings.bits)) - 1.0;
  std::transform(valuesDn, valuesDn + count, valuesDn, [=](double valueDn) {
    const double stored = std::floor(std::sqrt(std::clamp(valueDn, 0.0, top) / top) * storedTop + 0.5) / storedTop;
    return top * stored * stored;
  });
}

} // namespace sensornoise
