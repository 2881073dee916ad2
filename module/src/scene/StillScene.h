// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_scene_StillScene_h
#define sensornoise_scene_StillScene_h

#include "SensorNoiseExport.h"
#include "base/NothingToMeasure.h"
#include "sensornoise/Parallel.h"
#include "moments/StackMaps.h"
#include "scene/MaskedBorder.h"
#include "scene/ProvisionalModel.h"
#include "scene/ReferenceFrame.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace sensornoise
{

/** The result of the first pass: the mean image, a rough model of its noise, and which pixels can serve. */
struct StillScene
{
  StackSummary              summary;
  MaskedBorder              border;     ///< strips that are no part of the scene, which are left out
  std::size_t               valid{ 0 }; ///< pixels that are finite, never at a clip level, and not masked by the user
  ReferenceFrame            frame;      ///< its `usable` pixels are those that serve
  ProvisionalModel          model;
  std::vector<std::uint8_t> pixelUse;                 ///< values of PixelUse, as far as one pass can tell
  double                    usable{ 0.0 };            ///< pixels that serve
  std::size_t               nearClip{ 0 };            ///< pixels that clipping could touch
  std::size_t               coarse{ 0 };              ///< pixels whose noise is below half a code step
  bool                      changesStrongly{ false }; ///< the illumination does

  /** Why the stack cannot be measured: then the model may be missing. Null: it can. */
  std::optional<NothingToMeasure> obstacle;
};

/** Makes the scene of the maps of a stack of \a frames distinct frames: \a mean, \a variance and \a valid as of
 * MakeStackMaps().
 * \a userMask, if not empty, has a nonzero value at the pixels to be used; \a frameMeans are the frames' means [DN].
 * \a darkestNoiseDn2, if given: the illumination changes strongly, \a variance is without these changes
 * (LevelProjection), and that is the variance that the noise of the darkest frame has at most [DN^2]. */
SensorNoise_EXPORT StillScene
MakeStillScene(const StackSummary &              summary,
               std::vector<double>               mean,
               std::vector<double>               variance,
               std::vector<std::uint8_t>         valid,
               const std::vector<std::uint8_t> & userMask,
               const FrameGeometry &             geometry,
               std::size_t                       frames,
               const std::vector<double> &       frameMeans,
               const ParallelFor &               parallelFor = SerialFor,
               const std::optional<double> &     darkestNoiseDn2 = std::nullopt);

} // namespace sensornoise

#endif
