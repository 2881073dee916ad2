// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "moments/DarkFrames.h"

#include "base/ChiSquare.h"
#include "base/Constants.h"
#include "sensornoise/Parallel.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

namespace sensornoise
{

namespace
{

/** Factors that are the same for all pixels. */
struct IntervalFactors
{
  double student; ///< half width of the interval of the offset, in standard errors
  double low;     ///< lower bound of the interval of the variance, in units of the variance
  double high;    ///< upper bound, in the same unit
  double frames;  ///< number of frames T
  double stepDn;  ///< quantization step
};

IntervalFactors
IntervalFactorsOf(const DarkMaps & dark)
{
  const auto   frames = static_cast<double>(dark.frames);
  const double dof = frames - 1.0;
  return { StudentQuantile(0.975, dof),
           dof / ChiSquareUpperQuantile(0.025, dof),
           dof / ChiSquareQuantile(0.025, dof),
           frames,
           dark.stepDn };
}

/** Returns the standard deviation of noise [DN] whose variance together with quantization noise is \a varianceDn2. */
double
NoiseWithoutRounding(double varianceDn2, double stepDn)
{
  return std::sqrt(std::max(0.0, varianceDn2 - stepDn * stepDn / 12.0));
}

IntervalMapDn
EmptyIntervalMap(std::size_t pixels)
{
  const std::vector<double> unknown(pixels, std::numeric_limits<double>::quiet_NaN());
  return { unknown, unknown, unknown };
}

void
FillPixel(PixelCalibration & maps, std::size_t p, double offsetDn, double varianceDn2, const IntervalFactors & factors)
{
  constexpr double worst = 1.57079632679489661923; // pi/2, see RoundingErrorDn()
  const double     half =
    factors.student * std::sqrt(varianceDn2 / factors.frames) + worst * RoundingErrorDn(factors.stepDn, varianceDn2);
  maps.offset.value[p] = offsetDn;
  maps.offset.low[p] = offsetDn - half;
  maps.offset.high[p] = offsetDn + half;
  const double stepDn = factors.stepDn;
  const bool   isHidden = varianceDn2 < InCommon.hiddenVariance * stepDn * stepDn;
  const double high = NoiseWithoutRounding(varianceDn2 * factors.high, stepDn);
  maps.readNoise.value[p] = NoiseWithoutRounding(varianceDn2, stepDn);
  maps.readNoise.low[p] = isHidden ? 0.0 : NoiseWithoutRounding(varianceDn2 * factors.low, stepDn);
  maps.readNoise.high[p] = isHidden ? std::max(std::sqrt(InCommon.hiddenVariance) * stepDn, high) : high;
}

} // namespace

PixelCalibration
MakePixelCalibration(const DarkMaps & dark, const ParallelFor & parallelFor)
{
  const std::size_t pixels = dark.offsetDn.size();
  if (dark.frames < 2 || dark.varianceDn2.size() != pixels)
  {
    throw std::invalid_argument("the dark maps are of " + std::to_string(dark.frames) + " frames, with " +
                                std::to_string(pixels) + " offsets and " + std::to_string(dark.varianceDn2.size()) +
                                " variances; expected two frames or more, and as many variances as offsets");
  }
  const IntervalFactors factors = IntervalFactorsOf(dark);
  PixelCalibration      maps{ EmptyIntervalMap(pixels), EmptyIntervalMap(pixels) };
  ForBlocks(pixels, parallelFor, [&](std::size_t begin, std::size_t end) {
    for (std::size_t p = begin; p < end; ++p)
    {
      if (std::isfinite(dark.offsetDn[p]) && std::isfinite(dark.varianceDn2[p]))
      {
        FillPixel(maps, p, dark.offsetDn[p], dark.varianceDn2[p], factors);
      }
    }
  });
  return maps;
}

} // namespace sensornoise
