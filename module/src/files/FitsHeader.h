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

/** The header of one unit (HDU) of a FITS file, and where its data are. */
struct FitsHeader
{
  std::string                        name{};   // of the unit, for errors: "file.fits, HDU 1"
  std::map<std::string, std::string> values{}; // by keyword; of texts without quotation marks
  std::vector<std::uint64_t>         axes{};   // NAXIS1 first
  std::int64_t                       bitsOfPixel{ 0 };
  std::uint64_t                      dataBegin{ 0 }; // [byte]
  std::uint64_t                      dataBytes{ 0 }; // without what fills the last block
  std::uint64_t                      next{ 0 };      // where the next unit would be [byte]

  /** The value of a keyword as text; empty where there is none. */
  std::string
  Text(const std::string & key) const;

  /** The value of a keyword as a number; nothing where there is no such keyword. Throws FileError unless it is a finite
   * number. */
  std::optional<double>
  Number(const std::string & key) const;

  /** The value of a keyword as a whole number, as Number() returns others. */
  std::optional<std::int64_t>
  Integer(const std::string & key) const;
};

/** Reads the header of the unit that begins at a byte of the file. Throws FileError unless it is one of the FITS
 * standard, version 4, and all its data are in the file. */
FitsHeader
ReadFitsHeader(const std::string & name, FileBytes & bytes, std::uint64_t offset);

} // namespace sensornoise

#endif
