// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_single_ImageNoise_h
#define sensornoise_single_ImageNoise_h

#include "sensornoise/Parallel.h"
#include "sensornoise/Settings.h"
#include "sensornoise/StepResults.h"
#include "sensornoise/FrameGeometry.h"
#include "sensornoise/Report.h"
#include "base/PixelLayout.h"
#include "single/LevelSums.h"
#include "single/NoiseLine.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace sensornoise
{

/** Pixels of a frame, or of a plane of a mosaic. */
template <typename TPixel>
struct PlaneOfFrame
{
  const TPixel *       pixels{ nullptr };
  PixelLayout          layout;
  std::size_t          height{ 0 };
  const std::uint8_t * mask{ nullptr }; ///< values at the places of the pixels; 0: left out; null: no mask
};

/** Noise of one frame. */
struct ImageNoise
{
  std::vector<LevelSet> diagonal;      ///< level sets, with variances from the diagonal details
  std::vector<LevelSet> sides;         ///< level sets, with variances from horizontal and vertical details
  NoiseLine             line;          ///< line through the variances of the diagonal details
  DetailCorrelation     correlation;   ///< correlation of neighbouring diagonal details, in a sample of the frame
  double                finite{ 0.0 }; ///< number of positions whose pixels are all finite
  double                even{ 0.0 };   ///< number of positions without edges and texture
};

/** Levels that the frames can have. */
struct LevelLimits
{
  ClipLevels clip;
  double     stepDn{ 0.0 }; ///< quantization step [DN]; 0: none
};

/** Returns the clip levels and the step of \a dnRange. */
LevelLimits
LimitsOf(const DnRange & dnRange);

/** Finds the quantization of a frame from a part of its rows, or uses the given values of \a settings: FindDnRange(),
 * or FindLevels() for floating-point pixels. Throws NothingToMeasure as MeasureFrame(). */
template <typename TPixel>
DnRange
FindDnRangeOfFrame(const PlaneOfFrame<TPixel> & plane, const DnSettings & settings, const ParallelFor & parallelFor);

/** Measures the variance of the level sets of a frame, and fits the line. A line through a sample of the frame selects
 * the windows without edges, and is fitted again. The last line selects the windows of the whole frame. The result has
 * the same bits for any number of threads. Throws NothingToMeasure for a frame that is too small, or whose pixels have
 * one level. */
template <typename TPixel>
ImageNoise
MeasureFrame(const PlaneOfFrame<TPixel> & plane, const LevelLimits & limits, const ParallelFor & parallelFor);

/** A frame, or a plane of it, and what was found of it so far. */
struct MeasuredPlane
{
  PixelLayout                            layout;
  FrameGeometry                          geometry;
  DnRange                                dnRange; ///< found from the first frame that can be measured
  std::vector<std::optional<ImageNoise>> frames;
  std::size_t                            clipped{ 0 };   ///< pixels at a clip level, in that frame
  std::size_t                            notFinite{ 0 }; ///< pixels that are NaN or infinite, in that frame
  std::size_t                            masked{ 0 };    ///< pixels that the mask leaves out
  std::string                            reason; ///< reason why no frame so far can be measured; "": a frame can
};

struct SingleImageSettings;

/** Results of the single-image method for a frame or a plane. */
struct SingleImageFindings
{
  const SingleImageSettings &            settings;
  FrameGeometry                          geometry; ///< size of the frame, or of the plane
  DnRange                                dnRange;
  std::vector<std::optional<ImageNoise>> frames;         ///< null: the frame cannot be measured
  std::optional<NoiseLine>               meanImage;      ///< line of the mean image, times the number of frames
  std::size_t                            clipped{ 0 };   ///< pixels at a clip level, in the first frame
  std::size_t                            notFinite{ 0 }; ///< pixels that are NaN or infinite there
  std::size_t                            masked{ 0 };    ///< pixels that the mask leaves out
  std::string                            reason;         ///< reason why the first frame cannot be measured; "": it can
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
