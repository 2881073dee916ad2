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

/** Fields of the header of a MetaImage. */
struct MetaImageHeader
{
  std::map<std::string, std::string> fields{};
  std::vector<std::string>           list{};   // names of the data files behind "ElementDataFile = LIST"
  std::uint64_t                      end{ 0 }; // size of the header [bytes]

  /** Returns the value of a field; "" if the header lacks it. */
  std::string
  Field(const std::string & key) const;
};

/** Reads the header. Each line must be a name, a separator and a value. Required fields must be present, known fields
 * must have allowed values, and no field may occur twice. Throws FileError otherwise. A list of data files may end in
 * an incomplete line, which is left out. */
MetaImageHeader
ReadMetaImageHeader(const std::string & file, FileBytes & bytes);

/** Fields of the header of a NRRD file, by their names in lower case and with spaces. */
struct NrrdHeader
{
  std::map<std::string, std::string> fields{};
  std::vector<std::string>           list{};   // names of the data files behind "data file: LIST"
  std::uint64_t                      end{ 0 }; // size of the header [bytes]

  /** Returns the value of a field; "" if the header lacks it. */
  std::string
  Field(const std::string & key) const;
};

/** Reads the header. Throws FileError for another version than 1 to 5, an incomplete line, a field that occurs twice,
 * and a line that is no field, comment or key. The empty line at the end may be missing only if the header names a data
 * file. */
NrrdHeader
ReadNrrdHeader(const std::string & file, FileBytes & bytes);

} // namespace sensornoise

#endif
