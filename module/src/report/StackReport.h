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
#include "moments/UnlikeFrames.h"
#include "moments/ExposureFit.h"
#include "moments/FrameThumbnails.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace sensornoise
{

/** Files what the report says of the stack itself, whatever the method; \a valid pixels are finite, never at a clip
 * level, and not masked. */
SensorNoise_EXPORT void
DescribeStack(Report &                          report,
              const FrameGeometry &             geometry,
              std::size_t                       frames,
              const StackSummary &              summary,
              std::size_t                       valid,
              const std::vector<std::uint8_t> & pixelUse);

/** What was found that the user should know of before trusting the numbers. */
SensorNoise_EXPORT void
WarnOfStack(Report & report, std::size_t frames, const StackSummary & summary);

/** Warns if the mean over time [DN] looks as a mosaic of colour filters does, see RecogniseMosaic(). */
SensorNoise_EXPORT void
WarnOfMosaic(Report &                    report,
             const std::vector<double> & mean,
             const FrameGeometry &       geometry,
             const ParallelFor &         parallelFor);

/** 1 where the value of \a pixelUse is PixelUse::Used. */
SensorNoise_EXPORT std::vector<std::uint8_t>
MaskOfUsed(const std::vector<std::uint8_t> & pixelUse);

/** Files Figure 4: averages over 256 bins of equal count of the pixels that are \a used, the mask's. */
SensorNoise_EXPORT void
FillScatter(Report &                          report,
            const std::vector<double> &       mean,
            const std::vector<double> &       variance,
            const std::vector<double> &       correctedVariance,
            const std::vector<std::uint8_t> & used,
            const ParallelFor &               parallelFor);

/** Files the line and the parabola through the uncorrected variance, what tools that ignore flicker would say. */
SensorNoise_EXPORT void
FillBaselines(Report & report, const RegressionData & raw, const ParallelFor & parallelFor);

/** Makes of the report of the distinct frames that of the frames given: their number, which are left out, the series
 * with the values of a frame's original, or NaN where it is left out, and the warnings `repeated-frames` and
 * `frames-left-out`. */
SensorNoise_EXPORT void
ReportAllFrames(Report & report, const DistinctFrames & frames, const std::vector<LeftOutFrame> & leftOut);

/** Files the linearity of the response. The linearity error is an upper limit where its 95 % interval holds 0, and
 * `not-identifiable` where no exposures were given (null) or too few of their levels are in the range. */
SensorNoise_EXPORT void
ReportLinearity(Report & report, const std::optional<ExposureFit> & fit);

/** Where there is no gain, and the frames show no still scene, says so in place of what else was found wrong, which
 * follows from it. */
SensorNoise_EXPORT void
ReportSceneChange(Report & report, const SceneChange & change);

} // namespace sensornoise

#endif
