// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_scene_UsablePixels_h
#define sensornoise_scene_UsablePixels_h

#include "SensorNoiseExport.h"
#include "sensornoise/Parallel.h"
#include "sensornoise/StepResults.h"
#include "scene/ProvisionalModel.h"
#include "scene/ReferenceFrame.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace sensornoise
{

/** Whether each pixel can be used, or why not, before any model of the noise: values of PixelUse. \a valid is the
 * map of which \a frame was made; \a userMask, if not empty, is 0 at pixels that are masked. */
SensorNoise_EXPORT std::vector<std::uint8_t>
FindPixelUse(const ReferenceFrame &            frame,
             const std::vector<std::uint8_t> & valid,
             const std::vector<std::uint8_t> & userMask,
             const ParallelFor &               parallelFor = SerialFor);

/** The usable pixels of a frame that are free of clipping, its guard band and coarse codes. */
struct UsablePixels
{
  std::vector<std::uint8_t> usable;        ///< 1: the pixel serves
  std::vector<std::uint8_t> pixelUse;      ///< values of PixelUse
  double                    count{ 0.0 };  ///< pixels that serve
  std::size_t               nearClip{ 0 }; ///< usable pixels of the frame in the guard band
  std::size_t               coarse{ 0 };   ///< usable pixels of the frame whose noise is below half a code step
  /** Of the coarse pixels, the brighter ones of companded codes: the others tell the line without them. */
  std::size_t coarseInLight{ 0 };
};

/** Leaves out what clipping could touch (FindGuardBand), and pixels whose noise is below half a code step, where the
 * codes hide it. \a frameMeans are the frames' means, for the brightest and the darkest one; \a pixelUse is that of
 * FindPixelUse. \a darkestNoiseDn2, if given: the illumination changes strongly, the frame's variance is without
 * these changes, and that is the variance that the noise of the darkest frame has at most [DN^2]. */
SensorNoise_EXPORT UsablePixels
LeaveOutCoarseAndGuarded(const ReferenceFrame &        frame,
                         const ProvisionalModel &      model,
                         const CodeRange &             codes,
                         const std::vector<double> &   frameMeans,
                         std::vector<std::uint8_t>     pixelUse,
                         const ParallelFor &           parallelFor,
                         const std::optional<double> & darkestNoiseDn2 = std::nullopt);

/** Throws NothingToMeasure, CodesTooCoarse, if codes of spacing \a stepDn hide the noise of more than a fifth of the
 * pixels. */
SensorNoise_EXPORT void
RequireFineCodes(const UsablePixels & pixels, double stepDn);

} // namespace sensornoise

#endif
