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
#include "sensornoise/simulation/Interpolation.h"

#include <array>
#include <stdexcept>
#include <utility>

namespace sensornoise
{
namespace
{
constexpr std::array<std::pair<Interpolation, const char *>, 3> InterpolationNames{
  { { Interpolation::Nearest, "nearest" }, { Interpolation::Linear, "linear" }, { Interpolation::Cubic, "cubic" } }
};
} // namespace

const char *
NameOf(Interpolation interpolation)
{
  for (const auto & [known, name] : InterpolationNames)
  {
    if (known == interpolation)
    {
      return name;
    }
  }
  return "unknown";
}

Interpolation
InterpolationOf(const std::string & name)
{
  for (const auto & [interpolation, known] : InterpolationNames)
  {
    if (name == known)
    {
      return interpolation;
    }
  }
  throw std::invalid_argument("the interpolation \"" + name + "\" is not known; expected nearest, linear or cubic");
}

} // namespace sensornoise
