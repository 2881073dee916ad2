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
#ifndef sensornoise_published_FlickerEstimate_h
#define sensornoise_published_FlickerEstimate_h

#include "sensornoise/base/RollingShutter.h"
#include "sensornoise/published/FlickerSums.h"
#include "sensornoise/published/IsoIntensitySet.h"
#include "sensornoise/published/LineFlicker.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

namespace sensornoise
{

/** Flicker and offset of a stack, sections 3.2 and 3.5 of Sur & Gredi\'ac 2015. */
struct FlickerEstimate
{
  std::vector<double> brightRatio;      ///< v^*(t), (3.8) [1]
  std::vector<double> darkResidualDn;   ///< v_*(t), (3.14) [DN]
  double              slopeDn{ 0.0 };   ///< K, slope of v_* against v^* - 1 [DN]
  double              offsetDn{ 0.0 };  ///< mu, (3.16) [DN]
  std::vector<double> gamma;            ///< gamma_t of the whole frame, (3.17) [1]
  double              flickerSd{ 0.0 }; ///< standard deviation of gamma_t over time (by line: root mean square) [1]

  double                    sigmaLines{ 0.0 }; ///< sigma_y [lines]; 0: no gamma_t(y)
  std::size_t               lines{ 1 };        ///< lines of gammaLines, or 1
  std::vector<double>       gammaLines;        ///< gamma_t(y), frame by frame; empty: no gamma_t(y)
  std::vector<std::uint8_t> lineKnown;         ///< per line: whether the line set reaches it; empty: all known

  /** How many standard deviations of its sampling noise the variance of v^* exceeds that noise by; may be infinite. */
  double flickerZ{ 0.0 };
  /** Residual variance of v_* about the line, over that expected of noise: 1 if the model holds. */
  double offsetLinePhi{ 1.0 };

  /** gamma_t, or gamma_t(y) where it is modelled. */
  double
  Gamma(std::size_t t, std::size_t line) const
  {
    return gammaLines.empty() ? gamma[t] : gammaLines[t * lines + line];
  }
  bool
  IsKnown(std::size_t line) const
  {
    return lineKnown.empty() || lineKnown[line] != 0;
  }
};

namespace detail
{
inline double
Mean(const std::vector<double> & values)
{
  double sum = 0.0;
  for (const double value : values)
  {
    sum += value;
  }
  return sum / static_cast<double>(values.size());
}

inline double
SampleVariance(const std::vector<double> & values)
{
  const double mean = Mean(values);
  double       sum = 0.0;
  for (const double value : values)
  {
    sum += (value - mean) * (value - mean);
  }
  return sum / static_cast<double>(values.size() - 1);
}

} // namespace detail

/** K, mu and gamma_t from the sums over S^* and S_*, (3.8) to (3.17); with \a mode also gamma_t(y), (3.28).
 *
 * K is the slope of the ordinary regression of v_* on v^* - 1; both have mean 0 by construction. K and mu always come
 * from the whole frames (section 3.5 keeps the image-wide procedure). \a sigmaLines is sigma_y for the mode Fixed. */
inline FlickerEstimate
EstimateFlicker(const FlickerSums &     sums,
                const IsoIntensitySet & bright,
                const IsoIntensitySet & dark,
                RollingShutter          mode,
                double                  sigmaLines)
{
  const std::size_t frames = sums.GetNumberOfFrames();
  FlickerEstimate   estimate;
  for (std::size_t t = 0; t < frames; ++t)
  {
    estimate.brightRatio.push_back(sums.GetBrightRatio(t));
    estimate.darkResidualDn.push_back(sums.GetDarkResidualDn(t));
  }

  const double meanBright = detail::Mean(estimate.brightRatio);
  const double meanDark = detail::Mean(estimate.darkResidualDn);
  double       sxx = 0.0;
  double       sxy = 0.0;
  for (std::size_t t = 0; t < frames; ++t)
  {
    const double dx = estimate.brightRatio[t] - meanBright;
    sxx += dx * dx;
    sxy += dx * (estimate.darkResidualDn[t] - meanDark);
  }
  estimate.slopeDn = sxx > 0.0 ? sxy / sxx : 0.0;
  const double contrast = bright.levelDn - dark.levelDn;
  estimate.offsetDn = estimate.slopeDn * bright.levelDn / (estimate.slopeDn - contrast); // (3.16)
  const bool wild = !std::isfinite(estimate.offsetDn) || estimate.offsetDn >= bright.levelDn;
  if (wild)
  {
    estimate.offsetDn = 0.0; // no flicker to speak of: v^* - 1 itself serves as gamma_t
  }
  const double scale = 1.0 + estimate.offsetDn / (bright.levelDn - estimate.offsetDn); // (3.17)
  for (std::size_t t = 0; t < frames; ++t)
  {
    estimate.gamma.push_back((estimate.brightRatio[t] - 1.0) * scale);
  }
  estimate.flickerSd = std::sqrt(detail::SampleVariance(estimate.gamma));

  // Does the flicker stand out of the noise, and do v_* and v^* lie on one line?
  const double dof = static_cast<double>(frames - 1);
  const double ratioVariance = sxx / dof;
  const double noise = sums.GetBrightRatioNoise();
  estimate.flickerZ = !wild && noise > 0.0           ? (ratioVariance / noise - 1.0) / std::sqrt(2.0 / dof)
                      : !wild && ratioVariance > 0.0 ? std::numeric_limits<double>::infinity() // no noise at all
                                                     : 0.0;
  double residual = 0.0;
  for (std::size_t t = 0; t < frames; ++t)
  {
    const double deviation =
      estimate.darkResidualDn[t] - meanDark - estimate.slopeDn * (estimate.brightRatio[t] - meanBright);
    residual += deviation * deviation;
  }
  const double lever = dark.levelDn + estimate.slopeDn; // noise of v^* enters v_* and the abscissa
  const double expected = sums.GetDarkResidualNoiseDn2() + lever * lever * noise;
  estimate.offsetLinePhi = expected > 0.0 ? residual / (dof - 1.0) / expected : 1.0;

  if (mode != RollingShutter::Off && sums.GetNumberOfLines() > 1)
  {
    estimate.sigmaLines = mode == RollingShutter::Fixed ? sigmaLines : ChooseLineSigma(sums);
  }
  if (estimate.sigmaLines > 0.0)
  {
    LineRatios ratios = SmoothLineRatios(sums, estimate.sigmaLines);
    estimate.lines = sums.GetNumberOfLines();
    estimate.lineKnown = std::move(ratios.known);
    estimate.gammaLines = std::move(ratios.ratio);
    for (double & value : estimate.gammaLines)
    {
      value = (value - 1.0) * scale;
    }
    double      total = 0.0;
    std::size_t known = 0;
    for (std::size_t line = 0; line < estimate.lines; ++line)
    {
      if (estimate.IsKnown(line))
      {
        std::vector<double> series;
        for (std::size_t t = 0; t < frames; ++t)
        {
          series.push_back(estimate.Gamma(t, line));
        }
        total += detail::SampleVariance(series);
        ++known;
      }
    }
    estimate.flickerSd = std::sqrt(total / static_cast<double>(known));
  }
  return estimate;
}

} // namespace sensornoise

#endif
