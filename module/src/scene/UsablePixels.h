// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_scene_UsablePixels_h
#define sensornoise_scene_UsablePixels_h

#include "SensorNoiseExport.h"
#include "sensornoise/Parallel.h"
#include "sensornoise/StepResults.h"
#include "scene/InitialNoiseModel.h"
#include "scene/ReferenceFrame.h"
#include "scene/Constants.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace sensornoise
{

/** Returns whether each pixel can be used, or the reason why not, before any model of the noise: values of PixelUse.
 * \a valid is the map from which \a frame was made; \a userMask, if not empty, is 0 at pixels that are masked. */
SensorNoise_EXPORT std::vector<std::uint8_t>
FindPixelUse(const ReferenceFrame &            frame,
             const std::vector<std::uint8_t> & valid,
             const std::vector<std::uint8_t> & userMask,
             const ParallelFor &               parallelFor = SerialFor);

/** The usable pixels of a frame: without clipping, guard band and coarse quantization. */
struct UsablePixels
{
  std::vector<std::uint8_t> usable;        ///< 1: the pixel is usable
  std::vector<std::uint8_t> pixelUse;      ///< values of PixelUse
  double                    count{ 0.0 };  ///< number of usable pixels
  std::size_t               nearClip{ 0 }; ///< number of excluded pixels in the guard band
  std::size_t               coarse{ 0 };   ///< number of excluded pixels whose noise is below half a quantization step
  /** Number of the coarse pixels of companded codes that are brighter than the centre; the fit does not need them. */
  std::size_t coarseWhereBright{ 0 };
};

/** Excludes the pixels that clipping could affect (FindGuardBand), and pixels whose noise is below half a quantization
 * step, which hides it.
 * \param frameMeans means of the frames [DN], for the brightest and the darkest one
 * \param pixelUse result of FindPixelUse()
 * \param darkestNoiseDn2 if given, the illumination changes strongly and the variance of \a frame is without these
 * changes; it is an upper bound of the noise variance in the darkest frame [DN^2] */
SensorNoise_EXPORT UsablePixels
ExcludeCoarseAndGuarded(const ReferenceFrame &        frame,
                        const InitialNoiseModel &     model,
                        const CodeRange &             codes,
                        const std::vector<double> &   frameMeans,
                        std::vector<std::uint8_t>     pixelUse,
                        const ParallelFor &           parallelFor,
                        const std::optional<double> & darkestNoiseDn2 = std::nullopt);

/** Throws NothingToMeasure, CodesTooCoarse, if the quantization step \a stepDn [DN] hides the noise of more than a
 * fifth of the pixels, without the bright ones of companded codes. */
SensorNoise_EXPORT void
RequireFineQuantization(const UsablePixels & pixels, double stepDn);

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

/** Marks outlier pixels, which are no part of a static scene as far as one pass determines it. Returns 1 where the
 * variance is far above the model, 2 where this is true of many of the 7 x 7 neighbours, else 0. */
SensorNoise_EXPORT std::vector<std::uint8_t>
FindOutlierPixels(const ReferenceFrame & frame, const InitialNoiseModel & model, const ParallelFor & parallelFor);

} // namespace sensornoise

#endif
