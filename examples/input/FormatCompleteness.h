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
#ifndef FormatCompleteness_h
#define FormatCompleteness_h

#include "input/InputError.h"

#include "itkMetaImageIO.h"

#include <cstdint>
#include <filesystem>
#include <string>

namespace sensornoise::tools
{

// One check for each format, for CheckFileIsComplete(). Each throws InputError.

void
CheckMetaImage(const std::string & file, itk::MetaImageIO & io);

/** The header says that there are `bytes` bytes of pixels. */
void
CheckNrrd(const std::string & file, std::uint64_t bytes);

void
CheckPng(const std::string & file);

void
CheckTiff(const std::string & file, const itk::ImageIOBase & io);

/** Throws InputError. */
[[noreturn]] inline void
Refuse(const std::string & file, const std::string & what)
{
  throw InputError(file + ": " + what);
}

/** The size of a file that `file` names, or that it is. */
std::uint64_t
SizeOfFile(const std::string & file, const std::filesystem::path & dataFile);

/** Throws InputError unless `dataFile` holds `expected` bytes from `offset` on. */
void
RequireBytes(const std::string &           file,
             const std::filesystem::path & dataFile,
             std::uint64_t                 offset,
             std::uint64_t                 expected);

} // namespace sensornoise::tools

#endif
