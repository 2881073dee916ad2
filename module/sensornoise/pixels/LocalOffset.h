/*=========================================================================
 *
 *  Copyright the ITKSensorNoise contributors
 *
 *  Licensed under the Apache License, Version 2.0 (the "License");
 *  you may not use this file except in compliance with the License.
 *  You may obtain a copy of the License at
 *
 *         https://www.apache.org/licenses/LICENSE-2.0.txt
 *
 *  Unless required by applicable law or agreed to in writing, software
 *  distributed under the License is distributed on an "AS IS" BASIS,
 *  WITHOUT WARRANTIES OR CONDITIONS OF ANY KIND, either express or implied.
 *  See the License for the specific language governing permissions and
 *  limitations under the License.
 *
 *=========================================================================*/
#ifndef sensornoise_pixels_LocalOffset_h
#define sensornoise_pixels_LocalOffset_h

#include "sensornoise/base/ChiSquare.h"
#include "sensornoise/base/Parallel.h"
#include "sensornoise/pixels/PixelLight.h"
#include "sensornoise/scene/ReferenceFrame.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

namespace sensornoise
{

/** The offset from the pixels' responses to the series of light. */
struct LocalOffset
{
  double      offset{ 0.0 }; ///< [DN], minus the centre
  double      standardError{ std::numeric_limits<double>::infinity() };
  double      low{ -std::numeric_limits<double>::infinity() };
  double      high{ std::numeric_limits<double>::infinity() };
  double      phi{ 1.0 };
  std::size_t patches{ 0 };
};

namespace detail
{
/** Sums of a patch and, per response, r1 = sum w z and r2 = sum w I z. */
struct PatchSums
{
  double              n{ 0.0 };
  double              g11{ 0.0 };
  double              g12{ 0.0 };
  double              g22{ 0.0 };
  std::vector<double> r1;
  std::vector<double> r2;

  double
  Precision(double m) const
  {
    return g22 - 2.0 * m * g12 + m * m * g11;
  }
};

inline std::optional<LocalOffset>
FitPatches(const std::vector<PatchSums> & patches, const PixelLight & data)
{
  const auto profile = [&patches](double m) {
    double sum = 0.0;
    for (const PatchSums & s : patches)
    {
      for (std::size_t j = 0; j < s.r1.size(); ++j)
      {
        sum += std::pow(s.r2[j] - m * s.r1[j], 2) / s.Precision(m);
      }
    }
    return sum;
  };
  const double  start = data.darkestDn - data.centreDn;
  double        best = start;
  double        highest = -1.0;
  constexpr int steps = 60;
  const double  step = 2.0 * data.rangeDn / steps;
  for (int i = 0; i <= steps; ++i)
  {
    const double m = start - 1.5 * data.rangeDn + i * step;
    const double value = profile(m);
    if (value > highest)
    {
      highest = value;
      best = m;
    }
  }
  // Golden section between the neighbours of the best of the grid.
  constexpr double ratio = 0.6180339887498949;
  double           low = best - step;
  double           high = best + step;
  for (int i = 0; i < 60; ++i)
  {
    const double a = high - ratio * (high - low);
    const double b = low + ratio * (high - low);
    (profile(a) > profile(b) ? high : low) = profile(a) > profile(b) ? b : a;
  }
  LocalOffset result;
  result.offset = 0.5 * (low + high);
  result.patches = patches.size();
  double full = 0.0;
  double information = 0.0;
  double number = 0.0;
  for (const PatchSums & s : patches)
  {
    const double precision = s.Precision(result.offset);
    const double across = s.g12 - result.offset * s.g11;
    for (std::size_t j = 0; j < s.r1.size(); ++j)
    {
      const double r = s.r2[j] - result.offset * s.r1[j];
      full += (s.g22 * s.r1[j] * s.r1[j] - 2.0 * s.g12 * s.r1[j] * s.r2[j] + s.g11 * s.r2[j] * s.r2[j]) /
              (s.g11 * s.g22 - s.g12 * s.g12);
      information += (r * r / (precision * precision) - 1.0 / precision) * (s.g11 - across * across / precision);
      number += 1.0;
    }
  }
  const double top = profile(result.offset);
  result.phi = number > 1.0 ? (full - top) / (number - 1.0) : 1.0;
  const double widening = std::max(1.0, result.phi);
  if (!(information > 0.0))
  {
    return std::nullopt;
  }
  result.standardError = std::sqrt(widening / information);
  const double far = std::max(profile(start - 20.0 * data.rangeDn), profile(start + 20.0 * data.rangeDn));
  const double student = StudentQuantile(0.975, std::max(1.0, number - 1.0));
  if (far < top - student * student * widening)
  {
    result.low = result.offset - student * result.standardError;
    result.high = result.offset + student * result.standardError;
  }
  return result;
}
} // namespace detail

/** The offset where light is local. A pixel's response to any series of light is its own light's, S_j = rho_j (mean -
 * mu), with rho_j about constant over a patch: the lines of all patches and series cross zero at mu. Patches of 8 to 64
 * pixels and strips of rows are tried, and the one of the smallest standard error, which their dispersion widens,
 * serves. Estimator.md, 3.7. */
inline std::optional<LocalOffset>
FindLocalOffset(const PixelLight & data, const ParallelFor & parallelFor = SerialFor)
{
  const ReferenceFrame & frame = data.projected.GetFrame();
  const std::size_t      width = frame.geometry.width;
  const std::size_t      height = frame.geometry.height;
  const std::size_t      light = data.projected.GetBasis().NumberOfLightFactors();
  const auto             responses = detail::ResponsesWithoutMotion(data, parallelFor);
  const auto             frames = static_cast<double>(frame.frames);

  constexpr std::size_t                                trials = 6;
  std::array<std::optional<LocalOffset>, trials>       fits;
  const std::array<std::array<std::size_t, 2>, trials> sizes{
    { { 64, 64 }, { 32, 32 }, { 16, 16 }, { 8, 8 }, { 4, width }, { 16, width } }
  };
  parallelFor(trials, [&](std::size_t trial) {
    const auto [patchHeight, patchWidth] = sizes[trial];
    const detail::Patches          patches{ patchHeight, patchWidth, (width + patchWidth - 1) / patchWidth };
    std::vector<detail::PatchSums> sums(patches.across * ((height + patchHeight - 1) / patchHeight));
    for (detail::PatchSums & s : sums)
    {
      s.r1.assign(light, 0.0);
      s.r2.assign(light, 0.0);
    }
    for (std::size_t p = 0; p < data.mask.size(); ++p)
    {
      if (data.mask[p] != 0)
      {
        const double        noise = data.line.At(frame.neighbourMean[p]);
        const double        w = 1.0 / noise;
        const double        centred = frame.mean[p] - data.centreDn;
        detail::PatchSums & s = sums[patches.Of(p, width)];
        s.n += 1.0;
        s.g11 += w;
        s.g12 += w * centred;
        s.g22 += w * (centred * centred - noise / frames);
        for (std::size_t j = 0; j < light; ++j)
        {
          s.r1[j] += w * responses[j][p];
          s.r2[j] += w * (centred - data.line.gain / frames) * responses[j][p];
        }
      }
    }
    std::vector<detail::PatchSums> good;
    for (const detail::PatchSums & s : sums)
    {
      const double determinant = s.g11 * s.g22 - s.g12 * s.g12;
      if (s.n > 12.0 && determinant > 30.0 * s.g11 * s.n / frames && determinant > 1e-6 * s.g11 * std::abs(s.g22))
      {
        good.push_back(s);
      }
    }
    if (!good.empty())
    {
      fits[trial] = detail::FitPatches(good, data);
    }
  });
  std::optional<LocalOffset> best;
  for (const std::optional<LocalOffset> & fit : fits)
  {
    if (fit && (!best || fit->standardError < best->standardError))
    {
      best = fit;
    }
  }
  return best;
}

} // namespace sensornoise

#endif
