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
#include "input/TextHeader.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>

namespace sensornoise::tools
{

std::string
Trimmed(const std::string & text)
{
  const std::size_t first = text.find_first_not_of(" \t\r");
  return first == std::string::npos ? "" : text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

TextHeader
ReadTextHeader(const std::string & file, const char * separators, const std::string & last)
{
  TextHeader    header;
  std::ifstream stream(file, std::ios::binary);
  std::string   line;
  while (std::getline(stream, line) && !(last.empty() && Trimmed(line).empty()))
  {
    const std::size_t separator = line.find_first_of(separators);
    if (separator == std::string::npos || line[0] == '#')
    {
      continue;
    }
    const std::string key = Trimmed(line.substr(0, separator));
    header.fields[key] = Trimmed(line.substr(separator + 1));
    if (key == last)
    {
      break;
    }
  }
  header.end = stream ? static_cast<std::uint64_t>(stream.tellg()) : std::filesystem::file_size(file);
  if (header.Field(last).rfind("LIST", 0) == 0)
  {
    // MetaIO drops a last line that has no end
    while (std::getline(stream, line) && !stream.eof())
    {
      header.lines.push_back(Trimmed(line));
    }
  }
  return header;
}

} // namespace sensornoise::tools
