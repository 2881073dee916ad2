// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_report_StackSettings_h
#define sensornoise_report_StackSettings_h

#include "SensorNoiseExport.h"
#include "sensornoise/Settings.h"
#include "sensornoise/FrameGeometry.h"
#include "sensornoise/Report.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace sensornoise
{

/** Throws std::invalid_argument if what was selected is not of the size of a stack. */
SensorNoise_EXPORT void
RequireSelection(const StackSelection & selection, const FrameGeometry & geometry, std::size_t frames);

/** What was read, by a hash that was computed elsewhere. Throws std::invalid_argument unless that is empty or 64
 * hexadecimal digits in small letters. */
SensorNoise_EXPORT InputFiles
InputFilesOf(const std::string & sha256, std::size_t files, std::uint64_t bytes);

/** Notes what was given of the codes in the settings of \a report: `bit_depth`, `clip_low`, `clip_high`,
 * `quantisation_step`. What was to be found is left out. */
SensorNoise_EXPORT void
NoteCodes(Report & report, const CodeSettings & codes);

/** Notes the pixels that a user left in, if there is a \a mask: `mask_crc32`, 8 hexadecimal digits, the CRC-32 (as
 * zlib's and PNG's) of the text "<width>x<height>:" and one byte a pixel, row by row, 1 where the mask is not 0. */
SensorNoise_EXPORT void
NoteMask(Report & report, const FrameGeometry & geometry, const std::vector<std::uint8_t> & mask);

/** Notes what the stack was cut out of: `roi_x`, `roi_y`, `roi_width`, `roi_height` and `frame_range_first`,
 * `frame_range_end`. */
SensorNoise_EXPORT void
NoteSelection(Report & report, const StackSelection & selection);

/** Throws std::invalid_argument unless \a factor is a finite number of 1 or more. */
SensorNoise_EXPORT void
ValidateExcessNoiseFactor(double factor);

/** Divides the excess noise factor F = \a factor out of the gain: g = slope / F, where the slope is that of the
 * variance against the level. Random amplification of each electron by M on average makes the variance F M^2 N of N
 * electrons, whose level is M N: the slope is F M, and a burst alone tells F and M not apart (Robbins & Hadwen 2003,
 * https://doi.org/10.1109/TED.2003.813462). The gain, those of the parts, their errors, its part of the covariance, and
 * the read noise in electrons change; everything in DN stays as it is, variance slope and intercepts included. The
 * factor is noted in the settings. A factor of 1 changes nothing. */
SensorNoise_EXPORT void
DivideExcessNoise(Report & report, double factor);

} // namespace sensornoise

#endif
