// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_scene_GuardBand_h
#define sensornoise_scene_GuardBand_h

#include "SensorNoiseExport.h"
#include "sensornoise/Parallel.h"
#include "sensornoise/StepResults.h"
#include "scene/Constants.h"
#include "scene/InitialNoiseModel.h"
#include "scene/ReferenceFrame.h"

#include <cstdint>
#include <vector>

namespace sensornoise
{

/** Marks the pixels that clipping could affect, whether it did or not: those whose expected extreme reaches a clip
 * level. The expected extreme is in the brightest or darkest frame, \a sds standard deviations from the level.
 *
 * Excluding only the pixels that happened to clip would select by the noise: the variance of the others would be too
 * small (estimator.md, 3.2). \a brightest and \a darkest are the extreme relative changes of the brightness of a
 * frame, above -1 [1]; 0 is the brightness of the mean frame. */
SensorNoise_EXPORT std::vector<std::uint8_t>
FindGuardBand(const ReferenceFrame &    frame,
              const InitialNoiseModel & model,
              const CodeRange &         codes,
              double                    brightest,
              double                    darkest,
              const ParallelFor &       parallelFor,
              double                    sds = InScene.guardBandSds);

/** Range of the illumination and the offset, estimated from the levels of the frames and a rough model. */
struct IlluminationRange
{
  double lowestDn;        ///< mean of the darkest frame minus the mean of all frames [DN]
  double highestDn;       ///< mean of the brightest frame minus the mean of all frames [DN]
  double lowestOffsetDn;  ///< smallest possible offset [DN]
  double highestOffsetDn; ///< largest possible offset, at most the mean of the darkest frame [DN]
  double lowestNoiseDn2;  ///< upper bound of the noise variance in the darkest frame, for any model [DN^2]
};

/** Marks the pixels that clipping could affect where the illumination changes strongly. A pixel is marked if it reaches
 * a clip level with the lowest or the highest offset, with the noise at the level that is reached. */
SensorNoise_EXPORT std::vector<std::uint8_t>
FindGuardBand(const ReferenceFrame &    frame,
              const InitialNoiseModel & model,
              const CodeRange &         codes,
              const IlluminationRange & range,
              const ParallelFor &       parallelFor,
              double                    sds = InScene.guardBandSds);

} // namespace sensornoise

#endif
