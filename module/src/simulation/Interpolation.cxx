// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/SensorFlaws.h"

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
