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
#ifndef sensornoise_refined_RefinedResults_h
#define sensornoise_refined_RefinedResults_h

#include "sensornoise/correlation/NoiseCorrelation.h"
#include "sensornoise/refined/PolishedSeries.h"
#include "sensornoise/refined/RefinedSettings.h"
#include "sensornoise/scene/StillScene.h"

#include <vector>

namespace sensornoise
{

/** What the passes of the refined method found, from which its report is made. */
struct RefinedResults
{
  const RefinedSettings &     settings;
  const StillScene &          scene;             ///< of the first pass
  const SceneSeries &         series;            ///< of the second
  const StaticVariance &      variance;          ///< of the third
  const PolishedSeries &      polished;          ///< of the second's sums, with the third's noise
  const std::vector<double> & correctedVariance; ///< NaN where it was not computed [DN^2]
  double                      blackDn;           ///< see BlackLevel()
  NoiseCorrelation            correlation{};     ///< of the third pass's sample

  /** Whether the light changes in some places in another way than in others. */
  bool
  HasLocalLight() const
  {
    return series.local.series.cols() > 0 && !polished.isOffsetDrift;
  }
};

} // namespace sensornoise

#endif
