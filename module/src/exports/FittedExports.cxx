// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "exports/ExportFormats.h"

#include "base/Text.h"
#include "report/JsonWriter.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <set>
#include <string>
#include <vector>

namespace sensornoise
{
namespace
{
/** One equation: first x + second y = wanted. */
struct TwoTerms
{
  double first{ 0.0 };
  double second{ 0.0 };
  double wanted{ 0.0 };
};

/** The least value that errors are relative to [variance of levels from 0 to 1, or DN of 16 bits]: far below one
 * electron of any sensor, and above 0. */
constexpr double leastWanted = 1e-30;

/** Solves equations for (x, y) by least squares of relative errors. Where \a isPositive, neither is below 0. */
std::array<double, 2>
SolveRelative(const std::vector<TwoTerms> & equations, bool isPositive)
{
  double xx = 0.0;
  double xy = 0.0;
  double yy = 0.0;
  double xw = 0.0;
  double yw = 0.0;
  for (const TwoTerms & each : equations)
  {
    const double weight = std::pow(std::max(each.wanted, leastWanted), -2.0);
    xx += weight * each.first * each.first;
    xy += weight * each.first * each.second;
    yy += weight * each.second * each.second;
    xw += weight * each.first * each.wanted;
    yw += weight * each.second * each.wanted;
  }
  const double          determinant = xx * yy - xy * xy;
  std::array<double, 2> solved{ (xw * yy - yw * xy) / determinant, (yw * xx - xw * xy) / determinant };
  if (isPositive && solved[0] < 0.0)
  {
    solved = { 0.0, yw / yy };
  }
  else if (isPositive && solved[1] < 0.0)
  {
    solved = { xw / xx, 0.0 };
  }
  return solved;
}

/** The model of one channel. */
struct AndroidChannel
{
  std::array<double, 2> scale{};  // A, B
  std::array<double, 2> offset{}; // C, D
  double                fitError{ 0.0 };
};

double
DigitalGainOf(const CameraNoise & noise)
{
  return noise.maxAnalogueIso ? std::max(1.0, *noise.isoSpeed / *noise.maxAnalogueIso) : 1.0;
}

AndroidChannel
FitAndroidChannel(const std::vector<CameraNoise> & settings, std::size_t channel)
{
  std::vector<TwoTerms> scales;
  std::vector<TwoTerms> offsets;
  for (const CameraNoise & noise : settings)
  {
    const NormalisedLine line = NormalisedLineOf(noise, noise.channels[channel]);
    const double         iso = *noise.isoSpeed;
    const double         digital = DigitalGainOf(noise);
    scales.push_back({ iso, 1.0, line.scale });
    offsets.push_back({ iso * iso, digital * digital, line.offset });
  }
  AndroidChannel model{ SolveRelative(scales, false), SolveRelative(offsets, true) };
  for (std::size_t i = 0; i < settings.size(); ++i)
  {
    for (const double level : { 0.0, 0.1, 1.0 }) // fractions of the range: dark, dim and bright
    {
      const double fitted = (scales[i].first * model.scale[0] + model.scale[1]) * level +
                            offsets[i].first * model.offset[0] + offsets[i].second * model.offset[1];
      const double measured = scales[i].wanted * level + offsets[i].wanted;
      model.fitError = measured > 0.0 ? std::max(model.fitError, std::abs(fitted / measured - 1.0)) : model.fitError;
    }
  }
  return model;
}

void
RequireAlike(const std::vector<CameraNoise> & settings)
{
  RequireIsoSpeeds(settings, "android");
  std::set<double> speeds;
  for (const CameraNoise & noise : settings)
  {
    speeds.insert(*noise.isoSpeed);
  }
  if (speeds.size() < 2)
  {
    throw ExportError("all reports have the ISO speed " + Text(*speeds.begin()) +
                      "; expected 2 or more different ISO speeds. Measure a burst at another one.");
  }
}
} // namespace

NoiseExport
ExportAndroid(const std::vector<CameraNoise> & settings)
{
  RequireAlike(settings);
  std::vector<std::string>           names;
  std::array<std::vector<double>, 4> coefficients;
  double                             fitError = 0.0;
  for (std::size_t channel = 0; channel < settings.front().channels.size(); ++channel)
  {
    const std::string    name = settings.front().channels[channel].channel;
    const AndroidChannel model = FitAndroidChannel(settings, channel);
    names.push_back(name == "G1" ? "Gr" : name == "G2" ? "Gb" : name);
    coefficients[0].push_back(model.scale[0]);
    coefficients[1].push_back(model.scale[1]);
    coefficients[2].push_back(model.offset[0]);
    coefficients[3].push_back(model.offset[1]);
    fitError = std::max(fitError, model.fitError);
  }
  std::string text;
  JsonWriter  json(text);
  json.Object([&] {
    json.Member("channels", names);
    json.Member("noise_model_A", coefficients[0]).Member("noise_model_B", coefficients[1]);
    json.Member("noise_model_C", coefficients[2]).Member("noise_model_D", coefficients[3]);
    json.Member("max_analog_iso", settings.front().maxAnalogueIso);
  });
  return OneFile("android_noise_model.json",
                 text + '\n',
                 "The fitted variance differs from the measured variance by " + Percent(fitError) + " at most.");
}

namespace
{
constexpr int          levels = 4096;  // number of levels of the fit, at even distances of the root of the signal
constexpr unsigned int scaleBits = 16; // libcamera's levels

// libcamera, src/ipa/rpi/controller/rpi/noise.cpp: at the analogue gain G, the standard deviation is sqrt(G) (constant
// + slope sqrt(signal)), in levels of 16 bits. (A binned mode divides it by a factor of the mode.) rpi-ctt divides the
// levels by G before its fit, which makes the constant sqrt(G) times smaller than the formula of noise.cpp needs at G.

/** Line of the standard deviation over sqrt(G), c + s r, at the root r of the signal, on libcamera's scale. */
struct RootLine
{
  double constant{ 0.0 };
  double slope{ 0.0 };
};

/** Line of the variance over G, slope m + dark, at the signal m, on libcamera's scale, up to the white level. */
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

/** Returns the number of libcamera's levels per DN. Throws ExportError if the bit depth is not 1 to 16. */
double
DnScaleOf(const CameraNoise & noise)
{
  if (!noise.bitDepth || *noise.bitDepth < 1 || *noise.bitDepth > scaleBits)
  {
    throw ExportError(
      "the report " + noise.name +
      " has no bit depth from 1 to 16, which libcamera's scale needs. Estimate the noise of frames with "
      "integer values.");
  }
  return std::exp2(scaleBits - *noise.bitDepth);
}

ScaledVariance
ScaleVariance(const CameraNoise & noise)
{
  const double   scale = DnScaleOf(noise);
  const double   range = WhiteLevelOf(noise) - BlackLevelOf(noise);
  NormalisedLine mean;
  for (const ChannelNoise & channel : noise.channels)
  {
    const NormalisedLine line = NormalisedLineOf(noise, channel);
    mean.scale += line.scale / static_cast<double>(noise.channels.size());
    mean.offset += line.offset / static_cast<double>(noise.channels.size());
  }
  const double scaledRange = range * scale;
  return { mean.scale * scaledRange / noise.analogueGain,
           mean.offset * scaledRange * scaledRange / noise.analogueGain,
           std::sqrt(scaledRange) };
}

/** Fits the line by least squares of the relative error. A constant that would be negative is set to 0. */
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
struct FitError
{
  double rms{ 0.0 };
  double largest{ 0.0 };
  double signal{ 0.0 }; ///< signal of the largest deviation, on libcamera's scale
};

FitError
FitErrorOf(const RootLine & line, const ScaledVariance & variance)
{
  FitError  fitError;
  const int first = variance.dark > 0.0 ? 0 : 1;
  for (int level = first; level < levels; ++level)
  {
    const double root = variance.RootOfLevel(level);
    const double error = std::abs((line.constant + line.slope * root) / variance.DeviationAt(root) - 1.0);
    fitError.rms += error * error / (levels - first);
    if (error > fitError.largest)
    {
      fitError.largest = error;
      fitError.signal = root * root;
    }
  }
  fitError.rms = std::sqrt(fitError.rms);
  return fitError;
}
} // namespace

LibcameraNoise
FitLibcamera(const CameraNoise & noise)
{
  const RootLine line = FitRootLine(ScaleVariance(noise));
  return { std::floor(line.constant), std::round(1000.0 * libcameraSlopeFactor * line.slope) / 1000.0 };
}

double
LibcameraVariance(const LibcameraNoise & model, const CameraNoise & noise, double levelDn)
{
  const double scale = DnScaleOf(noise);
  const double root = std::sqrt(std::max(0.0, scale * (levelDn - BlackLevelOf(noise))));
  const double deviation = (model.constant + model.slope / libcameraSlopeFactor * root) / scale;
  return noise.analogueGain * deviation * deviation;
}

NoiseExport
ExportLibcamera(const CameraNoise & noise)
{
  const ScaledVariance variance = ScaleVariance(noise);
  const LibcameraNoise model = FitLibcamera(noise);
  std::string          text;
  JsonWriter           json(text);
  json.Object([&] {
    json.ObjectMember(
      "rpi.noise", [&] { json.Member("reference_constant", model.constant).Member("reference_slope", model.slope); });
  });
  const FitError fitError = FitErrorOf({ model.constant, model.slope / libcameraSlopeFactor }, variance);
  const double   level = BlackLevelOf(noise) + fitError.signal / DnScaleOf(noise);
  return OneFile("libcamera_noise.json",
                 text + '\n',
                 "The fitted standard deviation differs from the measured one by " + Percent(fitError.rms) +
                   " (rms), and by " + Percent(fitError.largest) + " at most, at " + Rounded(level) +
                   " DN. The slope is multiplied by 1.4, as by rpi-ctt. The analogue gain of the burst is taken as " +
                   Text(noise.analogueGain) + ". libcamera multiplies both numbers by the root of the gain.");
}

} // namespace sensornoise
