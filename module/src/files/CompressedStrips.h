// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_files_CompressedStrips_h
#define sensornoise_files_CompressedStrips_h

#include "files/FileBytes.h"

#include <cstdint>
#include <string>

namespace sensornoise
{

/** Number of decoded bytes of a strip that is compressed by LZW. LZW has no checksum, so that wrong bytes are not
 * detected. */
struct LzwLength
{
  std::uint64_t bytes{ 0 };
  std::string   error{}; // empty where all codes have a meaning
};

/** Follows the codes in the bytes [offset, offset + count) until they stand for \a expected bytes, or, where a writer
 * has filled the strip up, for \a whole, or end. The first \a expected of these bytes go to \a out, where there is one.
 */
LzwLength
LengthOfLzw(FileBytes &     bytes,
            std::uint64_t   offset,
            std::uint64_t   count,
            std::uint64_t   expected,
            std::uint64_t   whole,
            unsigned char * out = nullptr);

/** Returns the number of samples that the lossless JPEG (ITU-T T.81, Annex H: SOF3) in these bytes declares. Throws
 * FileError, of which \a piece begins the sentence, where it is another JPEG, which loses something, or none, or where
 * its only scan does not go on to the end of the image within these bytes. */
std::uint64_t
SamplesOfLosslessJpeg(const std::string & piece, FileBytes & bytes, std::uint64_t offset, std::uint64_t count);

} // namespace sensornoise

#endif
