// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_simulation_ReadNoisePattern_h
#define sensornoise_simulation_ReadNoisePattern_h

#include "SensorNoiseExport.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace sensornoise
{

/** Read noise from pixel to pixel, as in sCMOS sensors: sigma_p = median exp(spread n), n normal, so that the logarithm
 * is normal; and a tail of pixels whose transistors trap charges (Huang et al. 2013, Nature Methods 10, 653,
 * DOI 10.1038/nmeth.2488, measure it pixel by pixel). Typical are a median of 1.4 e- and an rms of 1.6 to 2 e-. The
 * camera's read noise is the median of the pixels outside the tail. */
struct ReadNoiseSettings
{
  /** Standard deviation of ln sigma_p [1], 0 to 3. sCMOS: about 0.2. */
  double spread{ 0.0 };
  /** Fraction of the pixels in the tail, 0 to 1. sCMOS: about 0.03. */
  double tailFraction{ 0.0 };
  /** In the tail ln sigma_p is greater by |m| tailSpread, m normal [1], 0 to 3. */
  double tailSpread{ 1.0 };
};

/** \throws std::invalid_argument naming the first setting that cannot be used. */
SensorNoise_EXPORT void
CheckSettings(const ReadNoiseSettings & settings);

/** Read noise of every pixel in units of the median of those that are not in the tail. Empty if all are alike. */
SensorNoise_EXPORT std::vector<double>
DrawReadNoisePattern(const ReadNoiseSettings & settings, std::uint64_t seed, std::size_t pixels);

} // namespace sensornoise

#endif
