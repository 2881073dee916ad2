// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "exports/LibcameraExport.h"

#include "base/Text.h"
#include "exports/ExportInput.h"
#include "exports/RelativeFit.h"
#include "report/JsonWriter.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace sensornoise
{
namespace
{
constexpr double       slopeFactor = 1.4; // rpi-ctt 1.4.0 multiplies its slope by it
constexpr int          levels = 4096;     // of the fit, at even distances of the root of the signal
constexpr unsigned int scaleBits = 16;    // libcamera's levels

/** The standard deviation c + s r at the root r of the signal, on libcamera's scale. */
struct RootLine
{
  double constant{ 0.0 };
  double slope{ 0.0 };
};

/** The variance slope m + dark of the signal m, on libcamera's scale, up to the white level. */
struct ScaledVariance
{
  double slope{ 0.0 };
  double dark{ 0.0 };
  double highestRoot{ 0.0 };

  double
  RootOfLevel(int level) const
  {
    return highestRoot * level / (levels - 1);
  }
  double
  DeviationAt(double root) const
  {
    return std::sqrt(slope * root * root + dark);
  }
};

/** Libcamera's levels per DN. */
double
DnScaleOf(const CameraNoise & noise)
{
  return std::exp2(scaleBits - *noise.bitDepth) / noise.analogueGain;
}

ScaledVariance
ScaleVariance(const CameraNoise & noise)
{
  if (!noise.bitDepth || *noise.bitDepth < 1 || *noise.bitDepth > scaleBits)
  {
    throw ExportError(
      "the report " + noise.name +
      " has no bit depth from 1 to 16, which libcamera's scale needs. Estimate the noise of frames with "
      "integer values.");
  }
  const double   range = WhiteLevelOf(noise) - BlackLevelOf(noise);
  NormalisedLine mean;
  for (const ChannelNoise & channel : noise.channels)
  {
    const NormalisedLine line = NormalisedLineOf(noise, channel);
    mean.scale += line.scale / static_cast<double>(noise.channels.size());
    mean.offset += line.offset / static_cast<double>(noise.channels.size());
  }
  const double scaledRange = range * DnScaleOf(noise);
  return { mean.scale * scaledRange, mean.offset * scaledRange * scaledRange, std::sqrt(scaledRange) };
}

/** Least squares of the relative error; with a constant of 0 where it would be negative. */
RootLine
FitRootLine(const ScaledVariance & variance)
{
  std::vector<TwoTerms> equations;
  for (int level = variance.dark > 0.0 ? 0 : 1; level < levels; ++level)
  {
    const double root = variance.RootOfLevel(level);
    equations.push_back({ 1.0, root, variance.DeviationAt(root) });
  }
  const auto [constant, slope] = SolveRelative(equations, true);
  return { constant, slope };
}

/** Relative errors of the standard deviation that is stored. */
struct Misfit
{
  double rms{ 0.0 };
  double largest{ 0.0 };
  double signal{ 0.0 }; ///< of the largest, on libcamera's scale
};

Misfit
MisfitOf(const RootLine & line, const ScaledVariance & variance)
{
  Misfit    misfit;
  const int first = variance.dark > 0.0 ? 0 : 1;
  for (int level = first; level < levels; ++level)
  {
    const double root = variance.RootOfLevel(level);
    const double error = std::abs((line.constant + line.slope * root) / variance.DeviationAt(root) - 1.0);
    misfit.rms += error * error / (levels - first);
    if (error > misfit.largest)
    {
      misfit.largest = error;
      misfit.signal = root * root;
    }
  }
  misfit.rms = std::sqrt(misfit.rms);
  return misfit;
}
} // namespace

NoiseExport
ExportLibcamera(const CameraNoise & noise)
{
  const ScaledVariance variance = ScaleVariance(noise);
  const RootLine       line = FitRootLine(variance);
  const double         constant = std::floor(line.constant);
  const double         slope = std::round(1000.0 * slopeFactor * line.slope) / 1000.0;
  std::string          text;
  JsonWriter           json(text);
  json.Object([&] {
    json.ObjectMember("rpi.noise",
                      [&] { json.Member("reference_constant", constant).Member("reference_slope", slope); });
  });
  const Misfit misfit = MisfitOf({ constant, slope / slopeFactor }, variance);
  const double level = BlackLevelOf(noise) + misfit.signal / DnScaleOf(noise);
  return OneFile("libcamera_noise.json",
                 text + '\n',
                 "The fitted standard deviation differs from the measured one by " + Percent(misfit.rms) +
                   " (rms), and by " + Percent(misfit.largest) + " at most, at " + Rounded(level) +
                   " DN. The slope is multiplied by 1.4, as by rpi-ctt. The analogue gain of the burst is taken as " +
                   Text(noise.analogueGain) + '.');
}

} // namespace sensornoise
