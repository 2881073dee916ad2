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

#include <array>
#include <cstdint>
#include <fstream>
#include <string>

namespace sensornoise::tools
{

void
CheckPng(const std::string & file)
{
  std::ifstream       stream(file, std::ios::binary);
  const std::uint64_t size = SizeOfFile(file, file);
  std::uint64_t       chunk = 8;
  for (std::array<unsigned char, 8> head{};
       stream.seekg(chunk) && stream.read(reinterpret_cast<char *>(head.data()), head.size());)
  {
    const std::uint64_t length = (std::uint64_t{ head[0] } << 24) | (head[1] << 16) | (head[2] << 8) | head[3];
    chunk += length + 12;
    if (std::string(head.begin() + 4, head.end()) == "IEND" && chunk <= size)
    {
      return;
    }
  }
  Refuse(file, "truncated: " + std::to_string(size) + " bytes without the IEND chunk that ends a PNG file");
}

} // namespace sensornoise::tools
