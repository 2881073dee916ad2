// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_files_FileError_h
#define sensornoise_files_FileError_h

#include "SensorNoiseExport.h"

#include <stdexcept>
#include <string>

namespace sensornoise
{

/** What is wrong with a file: one sentence that begins with the file's name and says what was found and what was
 * expected. It is one line of UTF-8, whatever is in the file: other characters are shown as "?". */
class SensorNoise_EXPORT FileError : public std::runtime_error
{
public:
  FileError(const std::string & file, const std::string & what);
};

} // namespace sensornoise

#endif
