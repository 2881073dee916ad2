// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_report_StackReport_h
#define sensornoise_report_StackReport_h

#include "SensorNoiseExport.h"
#include "base/PolynomialFit.h"
#include "moments/Exposures.h"
#include "moments/FrameThumbnails.h"
#include "moments/StackFrames.h"
#include "moments/StackMaps.h"
#include "sensornoise/FrameGeometry.h"
#include "sensornoise/Parallel.h"
#include "sensornoise/Report.h"
#include "sensornoise/Settings.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
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

/** Throws std::invalid_argument if the selected region has another size than a frame, or if the selected range has
 * another number of frames than the stack. */
SensorNoise_EXPORT void
RequireSelection(const StackSelection & selection, const FrameGeometry & geometry, std::size_t frames);

/** Returns the identification of the input with a hash that the caller computed. \a files is the number of files, 0 for
 * a hash of pixels, and \a bytes the size. Throws std::invalid_argument unless \a sha256 is empty or has 64 hexadecimal
 * digits in lower case. */
SensorNoise_EXPORT InputFiles
InputFilesOf(const std::string & sha256, std::size_t files, std::uint64_t bytes);

/** Records the given properties of the digital numbers in the settings of \a report: `bit_depth` [bit], `clip_low`,
 * `clip_high` and `quantisation_step` [DN]. A property that is not given has no setting. */
SensorNoise_EXPORT void
NoteDnSettings(Report & report, const DnSettings & dnSettings);

/** Records the mask of the user in the setting `mask_crc32`, unless \a mask is empty. The setting has 8 hexadecimal
 * digits: the CRC-32 of zlib and PNG over the text "<width>x<height>:" and one byte per pixel, row by row. The byte is
 * 1 if the mask is not 0, else 0. */
SensorNoise_EXPORT void
NoteMask(Report & report, const FrameGeometry & geometry, const std::vector<std::uint8_t> & mask);

/** Records the selection in the settings of \a report: the region as `roi_x`, `roi_y`, `roi_width` and `roi_height`
 * [pixel], the frames as `frame_range_first` and `frame_range_end` (one past the last). */
SensorNoise_EXPORT void
NoteSelection(Report & report, const StackSelection & selection);

/** Throws std::invalid_argument unless \a factor is a finite number of 1 or more. */
SensorNoise_EXPORT void
ValidateExcessNoiseFactor(double factor);

/** Throws std::invalid_argument unless both bounds are finite and the lower bound is below the upper bound. */
SensorNoise_EXPORT void
ValidateLevelRange(const LevelRange & range);

/** Throws std::invalid_argument unless sigma_y of a rolling shutter, \a rows [rows], is above 0 and at most 1e5. */
SensorNoise_EXPORT void
ValidateShutterRows(double rows);

/** Returns why a method cannot use a setting, as the end of "the method published ...": "fits all levels". Returns ""
 * if it can.
 * \param method "refined", "published" or "single-image"
 * \param setting "offset", "dark", "level_range", "exposures" or "maps"
 *
 * Throws std::invalid_argument for another name of a setting. */
SensorNoise_EXPORT std::string
ReasonUnused(const std::string & method, const std::string & setting);

/** Throws std::invalid_argument if the method cannot use the setting, see ReasonUnused(). \a words are the setting in
 * the message: "the offset". */
SensorNoise_EXPORT void
RequireUsed(const std::string & method, const std::string & setting, const std::string & words);

/** Divides the gain by the excess noise factor F = \a factor [1].
 *
 * A random amplification by M on average gives N electrons the level M N and the variance F M^2 N. The slope of the
 * variance against the level is F M, and a burst alone does not determine F and M separately (Robbins & Hadwen 2003,
 * https://doi.org/10.1109/TED.2003.813462).
 *
 * The function changes the gain, the gains of parts, their errors, the covariances of the gain, and the read noise in
 * electrons. The variance slope and all quantities in DN or DN^2 do not change. The settings record the factor as
 * `excess_noise_factor`. A factor of 1 changes nothing. */
SensorNoise_EXPORT void
DivideExcessNoise(Report & report, double factor);

} // namespace sensornoise

#endif
