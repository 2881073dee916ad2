// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_refined_RefinedResults_h
#define sensornoise_refined_RefinedResults_h

#include "correlation/NoiseCorrelation.h"
#include "moments/ExposureFit.h"
#include "refined/ReestimatedComponents.h"
#include "sensornoise/Settings.h"
#include "refined/LineIllumination.h"
#include "refined/UnlikeNoise.h"
#include "scene/StaticScene.h"
#include "series/Constants.h"

#include <algorithm>
#include <optional>
#include <vector>

namespace sensornoise
{

/** Results of the passes of the refined method, from which its report is made. */
struct RefinedResults
{
  const RefinedSettings &       settings;
  const StaticScene &           scene;             ///< from the first pass
  const SceneSeries &           series;            ///< from the second pass
  const StaticVariance &        variance;          ///< from the third pass
  const ReestimatedComponents & reestimated;       ///< from the sums of the second pass, with the noise from the third
  const std::vector<double> &   correctedVariance; ///< NaN where it was not computed [DN^2]
  double                        blackDn{ 0.0 };    ///< see BlackLevel()
  NoiseCorrelation              correlation{};     ///< from the sample of the third pass
  FrameNoise                    frameNoise{};      ///< groups by the indices of the frames in the stack
  LineIllumination              lines{};           ///< from the sample of the third pass
  /** Results from the frames' exposures; null: none were given. */
  const ExposureFit * exposures{ nullptr };
  /** Fraction of the signal in the dark frames, see FindDarkSignal() [1]; null: none. */
  std::optional<MeasuredNumber> darkSignal{};

  /** Return a level of the mean frame in the frame of the lowest or the highest illumination factor, if the frames have
   * a photon transfer; else the level itself [DN]. */
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

  /** Returns whether the scene has one level, under strong changes of the illumination: its motion is not identifiable.
   */
  bool
  IsFlatUnderChange() const
  {
    return scene.changesStrongly && !(series.line.contrast > InSeries.leastContrast);
  }
  /** Returns whether the illumination changes differently over the frame. */
  bool
  HasLocalIllumination() const
  {
    return series.local.series.cols() > 0 && !reestimated.isOffsetDrift;
  }

private:
  double
  InFrame(double levelDn, double gamma) const
  {
    const double offsetDn = series.offset + scene.model.centreDn; // the offset to which gamma refers
    return offsetDn + std::max(0.0, 1.0 + gamma) * (levelDn - offsetDn);
  }
};

} // namespace sensornoise

#endif
