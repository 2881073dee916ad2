// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_moments_StackMaps_h
#define sensornoise_moments_StackMaps_h

#include "sensornoise/base/Parallel.h"
#include "sensornoise/moments/CodeRange.h"
#include "sensornoise/moments/CodeSettings.h"
#include "sensornoise/moments/TemporalMoments.h"
#include "SensorNoiseExport.h"

#include <cstddef>
#include <cstdint>

namespace sensornoise
{

/** What the moments of a stack say beside mean and variance. */
struct StackSummary
{
  CodeRange   codes;
  std::size_t clipped{ 0 };   ///< pixels that attain a clip level in a frame
  std::size_t notFinite{ 0 }; ///< pixels that are NaN or infinite in a frame
};

/** Turns the moments of a stack into frame-sized maps: mean [DN], unbiased variance [DN^2] and the valid mask (1:
 * finite and never at a clip level). The variance of a single frame is 0. Codes and clip levels are given or found, see
 * FindCodes() and FindLevels(). NaN stands where a pixel was not finite. Throws std::invalid_argument if the data pass
 * the given bit depth. */
template <typename TPixel>
StackSummary
MakeStackMaps(const TemporalMoments<TPixel> & moments,
              const CodeSettings &            settings,
              const ParallelFor &             parallelFor,
              double *                        mean,
              double *                        variance,
              std::uint8_t *                  valid);

extern template SensorNoise_EXPORT StackSummary
MakeStackMaps<unsigned char>(const TemporalMoments<unsigned char> &,
                             const CodeSettings &,
                             const ParallelFor &,
                             double *,
                             double *,
                             std::uint8_t *);
extern template SensorNoise_EXPORT StackSummary
MakeStackMaps<unsigned short>(const TemporalMoments<unsigned short> &,
                              const CodeSettings &,
                              const ParallelFor &,
                              double *,
                              double *,
                              std::uint8_t *);
extern template SensorNoise_EXPORT StackSummary
MakeStackMaps<short>(const TemporalMoments<short> &,
                     const CodeSettings &,
                     const ParallelFor &,
                     double *,
                     double *,
                     std::uint8_t *);
extern template SensorNoise_EXPORT StackSummary
MakeStackMaps<float>(const TemporalMoments<float> &,
                     const CodeSettings &,
                     const ParallelFor &,
                     double *,
                     double *,
                     std::uint8_t *);
extern template SensorNoise_EXPORT StackSummary
MakeStackMaps<double>(const TemporalMoments<double> &,
                      const CodeSettings &,
                      const ParallelFor &,
                      double *,
                      double *,
                      std::uint8_t *);

} // namespace sensornoise

#endif
