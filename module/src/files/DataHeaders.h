// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_files_DataHeaders_h
#define sensornoise_files_DataHeaders_h

#include "files/FileBytes.h"

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace sensornoise
{

/** The fields of a MetaImage's header. */
struct MetaImageHeader
{
  std::map<std::string, std::string> fields{};
  std::vector<std::string>           list{};   // the names behind "ElementDataFile = LIST"
  std::uint64_t                      end{ 0 }; // where the pixels begin if they are in the same file

  /** The value of a field, empty where there is none. */
  std::string
  Field(const std::string & key) const;
};

/** Reads the header. Each line is a name, a separator and a value; known fields have the values that they must have;
 * none comes twice. Throws FileError. */
MetaImageHeader
ReadMetaImageHeader(const std::string & file, FileBytes & bytes);

/** The fields of a NRRD file's header, by their names in small letters and with their blanks. */
struct NrrdHeader
{
  std::map<std::string, std::string> fields{};
  std::vector<std::string>           list{};   // the names behind "data file: LIST"
  std::uint64_t                      end{ 0 }; // where the pixels begin if they are in the same file

  /** The value of a field, empty where there is none. */
  std::string
  Field(const std::string & key) const;
};

/** Reads the header. Throws FileError for lines that are no fields of NRRD or come twice, and where the end of the
 * header is missing. */
NrrdHeader
ReadNrrdHeader(const std::string & file, FileBytes & bytes);

} // namespace sensornoise

#endif
