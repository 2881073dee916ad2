// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_single_MeasuredPlane_h
#define sensornoise_single_MeasuredPlane_h

#include "base/PixelLayout.h"
#include "sensornoise/FrameGeometry.h"
#include "sensornoise/StepResults.h"
#include "single/ImageNoise.h"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace sensornoise
{

/** A frame, or a plane of it, and what was found of it so far. */
struct MeasuredPlane
{
  PixelLayout                            layout;
  FrameGeometry                          geometry;
  CodeRange                              codes; ///< found from the first frame that can be measured
  std::vector<std::optional<ImageNoise>> frames;
  std::size_t                            clipped{ 0 };   ///< pixels at a clip level, in that frame
  std::size_t                            notFinite{ 0 }; ///< pixels that are NaN or infinite, in that frame
  std::size_t                            masked{ 0 };    ///< pixels that the mask leaves out
  std::string                            reason;         ///< why no frame so far can be measured; "": one can
};

} // namespace sensornoise

#endif
