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
#ifndef TextHeader_h
#define TextHeader_h

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace sensornoise::tools
{

/** The text without the blanks around it. */
std::string
Trimmed(const std::string & text);

/** A text header: lines of a key, a separator and a value. */
struct TextHeader
{
  std::map<std::string, std::string> fields;
  std::vector<std::string>           lines; // what follows the header, of interest if it is a list of files
  std::uint64_t                      end{ 0 };

  std::string
  Field(const std::string & key) const
  {
    const auto found = fields.find(key);
    return found == fields.end() ? "" : found->second;
  }
};

/** Reads up to the line with the key `last`, or, without one, up to a line that is empty. */
TextHeader
ReadTextHeader(const std::string & file, const char * separators, const std::string & last);

} // namespace sensornoise::tools

#endif
