// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_report_StackReport_h
#define sensornoise_report_StackReport_h

#include "SensorNoiseExport.h"
#include "sensornoise/FrameGeometry.h"
#include "sensornoise/Parallel.h"
#include "base/PolynomialFit.h"
#include "moments/StackMaps.h"
#include "sensornoise/Report.h"
#include "moments/StackFrames.h"
#include "moments/FrameThumbnails.h"
#include "moments/Exposures.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace sensornoise
{

/** Sets the members of the report that describe the stack: frames, size, digital numbers, clip levels and numbers of
 * pixels.
 * \param frames number of distinct frames
 * \param valid number of pixels that are finite, never at a clip level, and not masked
 * \param pixelUse value of PixelUse of every pixel */
SensorNoise_EXPORT void
DescribeStack(Report &                          report,
              const FrameGeometry &             geometry,
              std::size_t                       frames,
              const StackSummary &              summary,
              std::size_t                       valid,
              const std::vector<std::uint8_t> & pixelUse);

/** Adds warnings about the stack: few frames, clip levels found from the data, companded or rescaled digital numbers,
 * and pixels that are not finite. \a frames is the number of distinct frames. */
SensorNoise_EXPORT void
WarnOfStack(Report & report, std::size_t frames, const StackSummary & summary);

/** Adds a warning if the levels of the temporal mean [DN] alternate as behind a colour mosaic, see RecogniseMosaic().
 */
SensorNoise_EXPORT void
WarnOfMosaic(Report &                    report,
             const std::vector<double> & mean,
             const FrameGeometry &       geometry,
             const ParallelFor &         parallelFor);

/** Returns a mask: 1 where \a pixelUse is PixelUse::Used, else 0. */
SensorNoise_EXPORT std::vector<std::uint8_t>
MaskOfUsed(const std::vector<std::uint8_t> & pixelUse);

/** Sets the noise curve of the report, Report::Scatter: averages over 256 intensity bins of equal numbers of pixels.
 * Only pixels with \a used not 0 count. The maps have one value per pixel: mean [DN] and variances [DN^2]. */
SensorNoise_EXPORT void
FillScatter(Report &                          report,
            const std::vector<double> &       mean,
            const std::vector<double> &       variance,
            const std::vector<double> &       correctedVariance,
            const std::vector<std::uint8_t> & used,
            const ParallelFor &               parallelFor);

/** Sets the line and the parabola through the uncorrected variance \a raw, the results of tools that ignore flicker. */
SensorNoise_EXPORT void
FillBaselines(Report & report, const RegressionData & raw, const ParallelFor & parallelFor);

/** Completes the report of the distinct frames with the other given frames. Sets the numbers of frames and the list of
 * frames that are left out. Extends the series to all given frames: a repeated frame has the values of its original,
 * and a frame that is left out has NaN. Adds the warnings `repeated-frames` and `frames-left-out`. */
SensorNoise_EXPORT void
ReportAllFrames(Report & report, const DistinctFrames & frames, const std::vector<LeftOutFrame> & leftOut);

/** Sets the linearity of the response. The linearity error is an upper limit if its 95 % interval contains 0. It is
 * `not-identifiable` if too few levels are in the range, or if no exposures were given: \a fit is null. */
SensorNoise_EXPORT void
ReportLinearity(Report & report, const std::optional<ExposureFit> & fit);

/** Adds the warning `scene-changes` if the gain is not identified and the frames do not show one static scene. It
 * replaces all warnings that the change of the scene may have caused. */
SensorNoise_EXPORT void
ReportSceneChange(Report & report, const SceneChange & change);

} // namespace sensornoise

#endif
