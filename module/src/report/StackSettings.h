// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_report_StackSettings_h
#define sensornoise_report_StackSettings_h

#include "SensorNoiseExport.h"
#include "sensornoise/Settings.h"
#include "sensornoise/FrameGeometry.h"
#include "sensornoise/Report.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace sensornoise
{

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
NoteCodes(Report & report, const CodeSettings & codes);

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

/** Throws std::invalid_argument unless both bounds are finite and the lower one is below the upper one. */
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
