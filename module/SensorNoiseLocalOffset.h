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
#ifndef SensorNoiseLocalOffset_h
#define SensorNoiseLocalOffset_h

#include "SensorNoiseProjectedVariance.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
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

/** What the search for the offset is given. */
struct LocalOffsetData
{
  const ProjectedVariance &         projected;
  const VarianceLine &              line;
  const std::vector<std::uint8_t> & mask;
  double                            centreDn;
  double                            darkestDn;
  double                            rangeDn;
};

namespace detail
{
/** A way to cut the frame into patches. */
struct Patches
{
  std::size_t height;
  std::size_t width;
  std::size_t across;

  std::size_t
  Of(std::size_t p, std::size_t frameWidth) const
  {
    return p / frameWidth / height * across + p % frameWidth / width;
  }
};

/** Removes what motion leaked by chance into the responses: kappa_k times the derivatives, kappa common to the frame.
 * It is estimated against lines in the mean that are free in every 8 x 8 patch (Frisch & Waugh 1933), so that light
 * that differs over the frame does not bias it. Even derivatives resemble the mean locally and would shift the offset.
 */
inline std::vector<std::vector<double>>
ResponsesWithoutMotion(const LocalOffsetData & data)
{
  constexpr std::size_t  derivatives = 5;
  const ReferenceFrame & frame = data.projected.GetFrame();
  const std::size_t      width = frame.geometry.width;
  const std::size_t      light = data.projected.GetBasis().NumberOfLightFactors();
  const Patches          patches{ 8, 8, (width + 7) / 8 };
  const std::size_t      count = patches.across * ((frame.geometry.height + 7) / 8);
  const std::size_t      variables = derivatives + light;
  // Per patch: n, w, wI, wII, then of each variable w z and w I z.
  const std::size_t   stride = 4 + 2 * variables;
  std::vector<double> sums(count * stride, 0.0);
  std::vector<double> z(variables);
  const auto          fill = [&](std::size_t p) {
    for (std::size_t k = 0; k < derivatives; ++k)
    {
      z[k] = ApplyStencil(MotionStencils()[k], frame.mean.data(), width, p);
    }
    for (std::size_t j = 0; j < light; ++j)
    {
      z[derivatives + j] = data.projected.GetCoordinates().OfPixel(p)[j];
    }
  };
  for (std::size_t p = 0; p < data.mask.size(); ++p)
  {
    if (data.mask[p] != 0)
    {
      const double w = 1.0 / data.line.At(frame.neighbourMean[p]);
      const double centred = frame.mean[p] - data.centreDn;
      double *     s = sums.data() + patches.Of(p, width) * stride;
      fill(p);
      s[0] += 1.0;
      s[1] += w;
      s[2] += w * centred;
      s[3] += w * centred * centred;
      for (std::size_t k = 0; k < variables; ++k)
      {
        s[4 + 2 * k] += w * z[k];
        s[5 + 2 * k] += w * centred * z[k];
      }
    }
  }
  Eigen::MatrixXd gram = Eigen::MatrixXd::Zero(derivatives, derivatives);
  Eigen::MatrixXd right = Eigen::MatrixXd::Zero(derivatives, static_cast<Eigen::Index>(light));
  for (std::size_t p = 0; p < data.mask.size(); ++p)
  {
    if (data.mask[p] != 0)
    {
      const double * s = sums.data() + patches.Of(p, width) * stride;
      const double   determinant = s[1] * s[3] - s[2] * s[2];
      if (s[0] > 20.0 && determinant > 1e-9 * s[1] * s[3])
      {
        const double w = 1.0 / data.line.At(frame.neighbourMean[p]);
        const double centred = frame.mean[p] - data.centreDn;
        fill(p);
        for (std::size_t k = 0; k < variables; ++k)
        {
          const double slope = (s[1] * s[5 + 2 * k] - s[2] * s[4 + 2 * k]) / determinant;
          const double level = (s[3] * s[4 + 2 * k] - s[2] * s[5 + 2 * k]) / determinant;
          z[k] -= level + slope * centred;
        }
        for (std::size_t i = 0; i < derivatives; ++i)
        {
          for (std::size_t j = 0; j < derivatives; ++j)
          {
            gram(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) += w * z[i] * z[j];
          }
          for (std::size_t j = 0; j < light; ++j)
          {
            right(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) += w * z[i] * z[derivatives + j];
          }
        }
      }
    }
  }
  const Eigen::VectorXd                                   unit = (gram.diagonal().array() + 1e-300).rsqrt();
  Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> solver;
  solver.setThreshold(1e-6);
  solver.compute(unit.asDiagonal() * gram * unit.asDiagonal());
  const Eigen::MatrixXd leak = unit.asDiagonal() * solver.solve(unit.asDiagonal() * right);

  std::vector<std::vector<double>> responses(light, std::vector<double>(data.mask.size(), 0.0));
  for (std::size_t p = 0; p < data.mask.size(); ++p)
  {
    if (data.mask[p] != 0)
    {
      fill(p);
      for (std::size_t j = 0; j < light; ++j)
      {
        responses[j][p] = z[derivatives + j];
        for (std::size_t k = 0; k < derivatives; ++k)
        {
          responses[j][p] -= leak(static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(j)) * z[k];
        }
      }
    }
  }
  return responses;
}

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
FitPatches(const std::vector<PatchSums> & patches, const LocalOffsetData & data)
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
FindLocalOffset(const LocalOffsetData & data)
{
  const ReferenceFrame & frame = data.projected.GetFrame();
  const std::size_t      width = frame.geometry.width;
  const std::size_t      height = frame.geometry.height;
  const std::size_t      light = data.projected.GetBasis().NumberOfLightFactors();
  const auto             responses = detail::ResponsesWithoutMotion(data);
  const auto             frames = static_cast<double>(frame.frames);

  std::optional<LocalOffset> best;
  const std::size_t sizes[6][2] = { { 64, 64 }, { 32, 32 }, { 16, 16 }, { 8, 8 }, { 4, width }, { 16, width } };
  for (const auto & size : sizes)
  {
    const detail::Patches          patches{ size[0], size[1], (width + size[1] - 1) / size[1] };
    std::vector<detail::PatchSums> sums(patches.across * ((height + size[0] - 1) / size[0]));
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
      const std::optional<LocalOffset> fit = detail::FitPatches(good, data);
      if (fit && (!best || fit->standardError < best->standardError))
      {
        best = fit;
      }
    }
  }
  return best;
}

/** Whether the further series of light are one line a + b mean over the whole frame: then a common offset drifts, and
 * no second light changes. */
inline bool
IsOffsetDrift(const LocalOffsetData & data)
{
  const ReferenceFrame & frame = data.projected.GetFrame();
  const std::size_t      width = frame.geometry.width;
  const std::size_t      light = data.projected.GetBasis().NumberOfLightFactors();
  const detail::Patches  patches{ 32, 32, (width + 31) / 32 };
  const std::size_t      count = patches.across * ((frame.geometry.height + 31) / 32);
  for (std::size_t j = 1; j < light; ++j)
  {
    struct Sums
    {
      double w{ 0.0 }, wI{ 0.0 }, wII{ 0.0 }, z{ 0.0 }, zI{ 0.0 };
    };
    std::vector<Sums> parts(count);
    Sums              whole;
    for (std::size_t p = 0; p < data.mask.size(); ++p)
    {
      if (data.mask[p] != 0)
      {
        const double w = 1.0 / data.line.At(frame.neighbourMean[p]);
        const double centred = frame.mean[p] - data.centreDn;
        const double z = data.projected.GetCoordinates().OfPixel(p)[j];
        for (Sums * s : { &parts[patches.Of(p, width)], &whole })
        {
          s->w += w;
          s->wI += w * centred;
          s->wII += w * centred * centred;
          s->z += w * z;
          s->zI += w * centred * z;
        }
      }
    }
    const double determinant = whole.w * whole.wII - whole.wI * whole.wI;
    const double level = (whole.wII * whole.z - whole.wI * whole.zI) / determinant;
    const double slope = (whole.w * whole.zI - whole.wI * whole.z) / determinant;
    const double explained = level * whole.z + slope * whole.zI;
    double       chi2 = 0.0;
    double       used = 0.0;
    for (const Sums & s : parts)
    {
      if (s.w > 0.0)
      {
        chi2 += std::pow(s.z - level * s.w - slope * s.wI, 2) / s.w;
        used += 1.0;
      }
    }
    if (chi2 > 4.0 * std::max(1.0, used - 2.0) || explained < 10.0 * chi2)
    {
      return false;
    }
  }
  return light > 1;
}

/** Sums from which the spread of local light follows for any offset. */
struct LocalFlicker
{
  double energy{ 0.0 }; ///< sum of (sum_j S_j^2 - noise) / noise
  double w{ 0.0 };      ///< of w, w I and w I^2, I the mean minus the centre
  double wI{ 0.0 };
  double wII{ 0.0 };
  double frames{ 0.0 };

  /** Root mean square over the frame of the standard deviation over time of the light, relative to its mean:
   * sqrt(sum w (sum_j S_j^2 - noise) / ((T - 1) sum w q^2)), q the mean above the offset (minus the centre). */
  double
  Sd(double offset) const
  {
    const double flux = wII - 2.0 * offset * wI + offset * offset * w;
    return std::sqrt(std::max(0.0, energy / (flux * (frames - 1.0))));
  }
};

inline LocalFlicker
SumLocalFlicker(const LocalOffsetData & data)
{
  const ReferenceFrame & frame = data.projected.GetFrame();
  const std::size_t      light = data.projected.GetBasis().NumberOfLightFactors();
  LocalFlicker           sums;
  sums.frames = static_cast<double>(frame.frames);
  for (std::size_t p = 0; p < data.mask.size(); ++p)
  {
    if (data.mask[p] != 0)
    {
      const double noise = data.line.At(frame.neighbourMean[p]);
      const double centred = frame.mean[p] - data.centreDn;
      for (std::size_t j = 0; j < light; ++j)
      {
        sums.energy += std::pow(data.projected.GetCoordinates().OfPixel(p)[j], 2) / noise - 1.0;
      }
      sums.w += 1.0 / noise;
      sums.wI += centred / noise;
      sums.wII += centred * centred / noise;
    }
  }
  return sums;
}

} // namespace sensornoise

#endif
