// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_moments_KnownOffset_h
#define sensornoise_moments_KnownOffset_h

#include "moments/DarkMaps.h"

#include <cstddef>
#include <memory>
#include <optional>

namespace sensornoise
{

/** Temporal variance of dark frames, that of rounding to whole codes included, and its standard error: the mean over
 * all pixels that are not defective, the noisy ones of the tail among them. */
struct DarkVariance
{
  double valueDn2{ 0.0 };
  double standardErrorDn2{ 0.0 };
};

/** Read noise of the median pixel, that of rounding to whole codes taken off, and its standard error. */
struct MedianReadNoise
{
  double valueDn{ 0.0 };
  double standardErrorDn{ 0.0 };
};

/** An offset that is known from elsewhere: given, or measured with dark frames, which tell the read noise, too. */
struct KnownOffset
{
  double                          valueDn{ 0.0 };
  double                          standardErrorDn{ 0.0 };
  std::size_t                     darkFrames{ 0 };         ///< frames that it was measured with; 0: it was given
  std::optional<DarkVariance>     variance{};              ///< null: fewer than two dark frames
  std::optional<MedianReadNoise>  readNoiseMedian{};       ///< null: see MedianReadNoiseOf()
  std::size_t                     numberDefective{ 0 };    ///< pixels left out as defective, see DefectivePixels.h
  double                          driftVarianceDn2{ 0.0 }; ///< over time, of the level common to all pixels [DN^2]
  std::shared_ptr<const DarkMaps> maps{};                  ///< null: fewer than two dark frames
};

} // namespace sensornoise

#endif
