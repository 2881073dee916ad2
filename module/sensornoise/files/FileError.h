/*=========================================================================
 *
 *  Copyright the ITKSensorNoise contributors
 *
 *  Licensed under the Apache License, Version 2.0 (the "License");
 *  you may not use this file except in compliance with the License.
 *  You may obtain a copy of the License at
 *
 *         https://www.apache.org/licenses/LICENSE-2.0.txt
 *
 *  Unless required by applicable law or agreed to in writing, software
 *  distributed under the License is distributed on an "AS IS" BASIS,
 *  WITHOUT WARRANTIES OR CONDITIONS OF ANY KIND, either express or implied.
 *  See the License for the specific language governing permissions and
 *  limitations under the License.
 *
 *=========================================================================*/
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
