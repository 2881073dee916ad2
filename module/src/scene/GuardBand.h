// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_scene_GuardBand_h
#define sensornoise_scene_GuardBand_h

#include "SensorNoiseExport.h"
#include "sensornoise/Parallel.h"
#include "sensornoise/StepResults.h"
#include "scene/Constants.h"
#include "scene/ProvisionalModel.h"
#include "scene/ReferenceFrame.h"

#include <cstdint>
#include <vector>

namespace sensornoise
{

/** Marks the pixels that clipping could touch, whether it did or not: those whose expected extreme, in the brightest
 * or darkest frame and \a sds standard deviations out, reaches a clip level.
 *
 * Leaving out only the pixels that happened to clip would select on the noise: the others' variance is too small
 * (estimator.md, 3.2). \a brightest and \a darkest are the extreme relative brightness of a frame, above -1; 0: the
 * mean's. */
SensorNoise_EXPORT std::vector<std::uint8_t>
FindGuardBand(const ReferenceFrame &   frame,
              const ProvisionalModel & model,
              const CodeRange &        codes,
              double                   brightest,
              double                   darkest,
              const ParallelFor &      parallelFor,
              double                   sds = InScene.guardBandSds);

/** How far the illumination and the offset go, as far as the frames' levels and a rough model tell. */
struct IlluminationRange
{
  double lowestDn;        ///< mean of the darkest frame less that of all frames [DN]
  double highestDn;       ///< of the brightest frame [DN]
  double lowestOffsetDn;  ///< [DN]
  double highestOffsetDn; ///< at most the mean of the darkest frame [DN]
  double lowestNoiseDn2;  ///< variance that the noise of the darkest frame has at most, whatever the model says [DN^2]
};

/** The same where the illumination changes strongly: marks the pixels that reach a clip level about the lowest or the
 * highest offset, with the noise that they have at the level that they reach. */
SensorNoise_EXPORT std::vector<std::uint8_t>
FindGuardBand(const ReferenceFrame &    frame,
              const ProvisionalModel &  model,
              const CodeRange &         codes,
              const IlluminationRange & range,
              const ParallelFor &       parallelFor,
              double                    sds = InScene.guardBandSds);

} // namespace sensornoise

#endif
