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
#ifndef sensornoise_moments_KnownOffset_h
#define sensornoise_moments_KnownOffset_h

#include "sensornoise/moments/DarkMaps.h"

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
