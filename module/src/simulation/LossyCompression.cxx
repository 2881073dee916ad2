// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "simulation/FrameProcessing.h"

#include "simulation/SettingChecks.h"

#include <algorithm>
#include <cmath>

namespace sensornoise
{
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
  RequireSetting(settings.quality <= 100, "quality of the block quantisation", settings.quality, "0 to 100");
  RequireSetting(!settings.IsOn() || bitDepth > 0,
                 "bit depth",
                 bitDepth,
                 "1 or more, for the block quantisation needs the converter's range");
}

BlockStepsDn
StepsOfQuality(const BlockSettings & settings, unsigned int bitDepth)
{
  const unsigned int quality = settings.quality;
  const unsigned int percent = quality < 50 ? 5000 / quality : 200 - 2 * quality;
  const double       codeOf8BitsDn = (std::ldexp(1.0, static_cast<int>(bitDepth)) - 1.0) / 255.0;
  BlockStepsDn       stepsDn{};
  std::transform(LuminanceSteps.begin(), LuminanceSteps.end(), stepsDn.begin(), [=](unsigned int step) {
    return codeOf8BitsDn * std::clamp((step * percent + 50) / 100, 1U, 255U);
  });
  return stepsDn;
}

DoubleFrame
QuantiseBlocks(const DoubleFrame & codesDn, const BlockStepsDn & stepsDn, const ParallelFor & parallelFor)
{
  DoubleFrame out(codesDn.width, codesDn.height);
  parallelFor((codesDn.height + Side - 1) / Side, [&](std::size_t blockRow) {
    const std::size_t top = blockRow * Side;
    for (std::size_t left = 0; left < codesDn.width; left += Side)
    {
      Block pixels{};
      for (std::size_t i = 0; i < pixels.size(); ++i)
      {
        const std::size_t y = std::min(top + i / Side, codesDn.height - 1);
        pixels[i] = codesDn.Row(y)[std::min(left + i % Side, codesDn.width - 1)];
      }
      pixels = Quantise(pixels, stepsDn);
      for (std::size_t y = top; y < std::min(top + Side, codesDn.height); ++y)
      {
        const std::size_t columns = std::min(Side, codesDn.width - left);
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
Compand(double * codesDn, std::size_t count, const CompandingSettings & settings, unsigned int bitDepth)
{
  const double top = std::ldexp(1.0, static_cast<int>(bitDepth)) - 1.0;
  const double storedTop = std::ldexp(1.0, static_cast<int>(settings.bits)) - 1.0;
  std::transform(codesDn, codesDn + count, codesDn, [=](double code) {
    const double stored = std::floor(std::sqrt(std::clamp(code, 0.0, top) / top) * storedTop + 0.5) / storedTop;
    return top * stored * stored;
  });
}

} // namespace sensornoise
