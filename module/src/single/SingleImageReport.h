// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_single_SingleImageReport_h
#define sensornoise_single_SingleImageReport_h

#include "base/PixelLayout.h"
#include "sensornoise/FrameGeometry.h"
#include "sensornoise/Report.h"
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

struct SingleImageSettings;

/** Results of the single-image method for a frame or a plane. */
struct SingleImageFindings
{
  const SingleImageSettings &            settings;
  FrameGeometry                          geometry; ///< of the frame, or of the plane
  CodeRange                              codes;
  std::vector<std::optional<ImageNoise>> frames;         ///< null: the frame cannot be measured
  std::optional<NoiseLine>               meanImage;      ///< line of the mean image, times the number of frames
  std::size_t                            clipped{ 0 };   ///< pixels at a clip level, in the first frame
  std::size_t                            notFinite{ 0 }; ///< pixels that are NaN or infinite there
  std::size_t                            masked{ 0 };    ///< pixels that the mask leaves out
  std::string                            reason;         ///< why the first frame cannot be measured; "": it can
};

/** Makes the report: fits one line to the level sets of all frames, checks its error by the scatter of the frames, and
 * warns where texture dominates. */
Report
MakeSingleImageReport(const SingleImageFindings & found);

/** Fits one line to the level sets of all frames. */
NoiseLine
FitAllFrames(const std::vector<std::optional<ImageNoise>> & frames, const LevelLimits & limits);

} // namespace sensornoise

#endif
