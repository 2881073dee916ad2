// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_scene_UsablePixels_h
#define sensornoise_scene_UsablePixels_h

#include "SensorNoiseExport.h"
#include "sensornoise/Parallel.h"
#include "sensornoise/StepResults.h"
#include "scene/InitialNoiseModel.h"
#include "scene/ReferenceFrame.h"

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

} // namespace sensornoise

#endif
