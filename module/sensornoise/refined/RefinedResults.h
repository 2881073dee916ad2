// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
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
  double                      blackDn{ 0.0 };    ///< see BlackLevel()
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
