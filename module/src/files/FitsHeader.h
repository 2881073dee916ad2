// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_files_FitsHeader_h
#define sensornoise_files_FitsHeader_h

#include "files/FileBytes.h"

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace sensornoise
{

/** Header of one unit (HDU) of a FITS file, and the place of its data. */
struct FitsHeader
{
  std::string                        name{};   // name of the unit for messages: "file.fits, HDU 1"
  std::map<std::string, std::string> values{}; // values by keyword, texts without quotation marks
  std::vector<std::uint64_t>         axes{};   // sizes of the axes, NAXIS1 first
  std::int64_t                       bitsOfPixel{ 0 };
  std::uint64_t                      dataBegin{ 0 }; // offset of the data [bytes]
  std::uint64_t                      dataBytes{ 0 }; // size of the data without padding [bytes]
  std::uint64_t                      next{ 0 };      // offset behind the last block [bytes]

  /** Returns the value of a keyword as text; "" if the header lacks it. */
  std::string
  Text(const std::string & key) const;

  /** Returns the value of a keyword as a number; none if the header lacks it. Throws FileError unless it is a finite
   * number. */
  std::optional<double>
  Number(const std::string & key) const;

  /** Returns the value of a keyword as an integer; none if the header lacks it. Throws FileError unless it is an
   * integer of at most 18 digits. */
  std::optional<std::int64_t>
  Integer(const std::string & key) const;
};

/** Reads the header of the unit at \a offset [bytes]. Throws FileError unless it is a header of the FITS standard,
 * version 4, and the file has all blocks of its data. */
FitsHeader
ReadFitsHeader(const std::string & name, FileBytes & bytes, std::uint64_t offset);

} // namespace sensornoise

#endif
