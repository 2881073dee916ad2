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
#include "input/FormatCompleteness.h"
#include "input/TextHeader.h"

#include <cstdint>
#include <cstdlib>
#include <string>

namespace sensornoise::tools
{

void
CheckNrrd(const std::string & file, std::uint64_t bytes)
{
  const TextHeader  header = ReadTextHeader(file, ":", "");
  const std::string dataFile = header.Field("data file") + header.Field("datafile");
  const std::string skip = header.Field("byte skip") + header.Field("byteskip");
  const bool        severalFiles = dataFile.rfind("LIST", 0) == 0 || dataFile.find('%') != std::string::npos;
  if (header.Field("encoding") != "raw" || severalFiles)
  {
    return;
  }
  // a skip of -1 means that the pixels are at the end
  const std::uint64_t         skipped = skip.empty() || skip[0] == '-' ? 0 : std::strtoull(skip.c_str(), nullptr, 10);
  const std::filesystem::path path =
    dataFile.empty() ? std::filesystem::path(file) : std::filesystem::path(file).parent_path() / dataFile;
  RequireBytes(file, path, skipped + (dataFile.empty() ? header.end : 0), bytes);
}

} // namespace sensornoise::tools
