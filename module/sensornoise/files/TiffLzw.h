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
#ifndef sensornoise_files_TiffLzw_h
#define sensornoise_files_TiffLzw_h

#include "sensornoise/files/FileBytes.h"

#include <cstdint>
#include <string>

namespace sensornoise
{

/** How many bytes the codes of a strip that is compressed by LZW stand for. Only their lengths are followed: LZW has no
 * checksum that would tell whether they are the right ones. */
struct LzwLength
{
  std::uint64_t bytes{ 0 };
  std::string   error{}; // empty where all codes have a meaning
};

/** Follows the codes in the bytes [offset, offset + count) until they stand for \a expected bytes, or, where a writer
 * has filled the strip up, for \a whole, or end. */
LzwLength
LengthOfLzw(FileBytes & bytes, std::uint64_t offset, std::uint64_t count, std::uint64_t expected, std::uint64_t whole);

} // namespace sensornoise

#endif
