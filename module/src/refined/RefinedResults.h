// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_refined_RefinedResults_h
#define sensornoise_refined_RefinedResults_h

#include "correlation/NoiseCorrelation.h"
#include "moments/ExposureFit.h"
#include "refined/PolishedSeries.h"
#include "sensornoise/Settings.h"
#include "refined/LineIllumination.h"
#include "refined/UnlikeNoise.h"
#include "scene/StillScene.h"
#include "series/Constants.h"

#include <algorithm>
#include <optional>
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
  FrameNoise                  frameNoise{};      ///< of the frames as given
  LineIllumination            lines{};           ///< of the third pass's sample
  /** What the frames' exposures tell; null: none were given. */
  const ExposureFit * exposures{ nullptr };
  /** The fraction of the signal that the dark frames hold, see FindDarkSignal() [1]; null: none. */
  std::optional<MeasuredNumber> darkSignal{};

  /** A level of the mean frame in the frame of the lowest or the highest illumination factor, where these differ so
   * much that the frames have a photon transfer of their own; else the level itself [DN]. */
  double
  InDarkestFrame(double levelDn) const
  {
    return variance.fromFrames.line.isDetermined
             ? this->InFrame(levelDn, *std::min_element(series.line.gamma.begin(), series.line.gamma.end()))
             : levelDn;
  }
  double
  InBrightestFrame(double levelDn) const
  {
    return variance.fromFrames.line.isDetermined
             ? this->InFrame(levelDn, *std::max_element(series.line.gamma.begin(), series.line.gamma.end()))
             : levelDn;
  }

  /** Whether the scene has one level, under strong changes of the illumination: its motion is not identifiable. */
  bool
  IsFlatUnderChange() const
  {
    return scene.changesStrongly && !(series.line.contrast > InSeries.leastContrast);
  }
  /** Whether the light changes in some places in another way than in others. */
  bool
  HasLocalLight() const
  {
    return series.local.series.cols() > 0 && !polished.isOffsetDrift;
  }

private:
  double
  InFrame(double levelDn, double gamma) const
  {
    const double offsetDn = series.offset + scene.model.centreDn; // gamma is about it
    return offsetDn + std::max(0.0, 1.0 + gamma) * (levelDn - offsetDn);
  }
};

} // namespace sensornoise

#endif
