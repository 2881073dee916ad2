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
#include "studies/RealSensorFormat.h"

#include <cmath>
#include <cstdio>

namespace sensornoise::tools
{

std::string
FormatNumber(double number, const char * format)
{
  char text[64] = "-";
  if (std::isfinite(number))
  {
    std::snprintf(text, sizeof(text), format, number);
  }
  return text;
}

std::string
FormatShare(const Share & share)
{
  return share.count == 0 ? "-" : std::to_string(share.met) + '/' + std::to_string(share.count);
}

std::string
FormatPercent(const Share & share)
{
  return FormatNumber(100.0 * share.Get(), "%.1f");
}

} // namespace sensornoise::tools
