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
#ifndef sensornoise_published_PublishedFindings_h
#define sensornoise_published_PublishedFindings_h

#include "sensornoise/base/FrameGeometry.h"
#include "sensornoise/moments/StackMaps.h"
#include "sensornoise/published/FlickerEstimate.h"
#include "sensornoise/published/IsoIntensitySet.h"
#include "sensornoise/published/PublishedSettings.h"
#include "sensornoise/report/Quantities.h"
#include "sensornoise/report/Report.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace sensornoise
{

/** All that the published method found out, from which its report is made. */
struct PublishedFindings
{
  const PublishedSettings &         settings;
  const FrameGeometry &             geometry;
  std::size_t                       frames;
  const StackSummary &              summary;
  const std::vector<double> &       mean;
  const std::vector<double> &       variance;
  const std::vector<double> &       correctedVariance; ///< empty: the stack cannot be measured
  const std::vector<std::uint8_t> & valid;
  const std::vector<std::uint8_t> & kept; ///< the vibration mask
  const std::vector<std::uint8_t> & pixelUse;
  const IsoIntensitySet &           bright;
  const IsoIntensitySet &           dark;
  const FlickerEstimate &           flicker;
  const std::string &               failure; ///< why the stack cannot be measured; empty: it can
};

namespace detail
{
inline void
WarnOfFlicker(Report & report, const PublishedFindings & found)
{
  const FlickerEstimate & flicker = found.flicker;
  const auto              widened = [&report](const char * name, const IsoIntensitySet & set) {
    if (set.wideningSteps > 0)
    {
      report.Warn(std::string(name) + "-set-widened",
                  std::string("the ") + name + " set was too small and was taken at the quantile " +
                    Text(set.quantile) + " with " + std::to_string(set.pixels.size()) + " pixels (" +
                    std::to_string(set.wideningSteps) + " steps, Remark 3)");
    }
  };
  widened("bright", found.bright);
  widened("dark", found.dark);
  if (flicker.sigmaLines > 0.0)
  {
    report.Warn("rolling-shutter",
                "the flicker differs from line to line; it is estimated with sigma_y = " + Text(flicker.sigmaLines) +
                  " lines");
    const auto unknown = std::count(flicker.lineKnown.begin(), flicker.lineKnown.end(), 0);
    if (unknown > 0)
    {
      report.Warn("lines-without-flicker",
                  "the brightest pixels do not reach " + std::to_string(unknown) + " of " +
                    std::to_string(flicker.lines) + " lines, whose flicker is not known: their pixels are left out");
    }
  }
  if (flicker.offsetLinePhi > 3.0)
  {
    report.Warn("offset-line-misfit",
                "dark pixels do not follow the bright ones' flicker (residual variance " + Text(flicker.offsetLinePhi) +
                  " times that of noise, expected 1): the offset is not reliable");
  }
}
} // namespace detail

} // namespace sensornoise

#endif
