// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_files_LosslessJpeg_h
#define sensornoise_files_LosslessJpeg_h

#include "files/FileBytes.h"

#include <cstdint>
#include <string>

namespace sensornoise
{

/** How many samples the JPEG without loss (ITU-T T.81, Annex H: SOF3) in these bytes declares. Throws FileError, of
 * which \a piece begins the sentence, where it is another JPEG, which loses something, or none, or where its only scan
 * does not go on to the end of the image within these bytes. */
std::uint64_t
SamplesOfLosslessJpeg(const std::string & piece, FileBytes & bytes, std::uint64_t offset, std::uint64_t count);

} // namespace sensornoise

#endif
