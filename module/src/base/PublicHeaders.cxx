// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/FrameGeometry.h"
#include "sensornoise/Settings.h"
#include "sensornoise/Version.h"

#include <stdexcept>
#include <string>

// Bodies of the functions of public headers that belong to no component.

namespace sensornoise
{
#ifndef SENSORNOISE_VERSION
#  error "SENSORNOISE_VERSION is not defined; expected the version in quotes, as CMakeLists.txt gives it"
#endif

const char *
GetModuleVersion()
{
  return SENSORNOISE_VERSION;
}

namespace
{
constexpr std::array<BayerPattern, 4> Patterns{
  { BayerPattern::RGGB, BayerPattern::GRBG, BayerPattern::GBRG, BayerPattern::BGGR }
};
} // namespace

const char *
NameOf(BayerPattern pattern)
{
  constexpr std::array<const char *, 4> names{ { "RGGB", "GRBG", "GBRG", "BGGR" } };
  return names.at(static_cast<std::size_t>(pattern));
}

const char *
NameOf(BayerPlane plane)
{
  constexpr std::array<const char *, 4> names{ { "R", "G1", "G2", "B" } };
  return names.at(static_cast<std::size_t>(plane));
}

BayerPattern
BayerPatternOf(const std::string & name)
{
  for (const BayerPattern pattern : Patterns)
  {
    if (name == NameOf(pattern))
    {
      return pattern;
    }
  }
  throw std::invalid_argument("the Bayer pattern is \"" + name + "\"; expected RGGB, GRBG, GBRG or BGGR");
}

BayerPlane
BayerPlaneOf(const std::string & name)
{
  for (const BayerPlane plane : BayerPlanes)
  {
    if (name == NameOf(plane))
    {
      return plane;
    }
  }
  throw std::invalid_argument("the plane of a Bayer mosaic is \"" + name + "\"; expected R, G1, G2 or B");
}

std::array<std::size_t, 2>
CornerOf(BayerPattern pattern, BayerPlane plane)
{
  // Position in RGGB; the other patterns begin one column, one row, or both, further on.
  const std::size_t column = plane == BayerPlane::G1 || plane == BayerPlane::B ? 1 : 0;
  const std::size_t row = plane == BayerPlane::G2 || plane == BayerPlane::B ? 1 : 0;
  const std::size_t shiftX = pattern == BayerPattern::GRBG || pattern == BayerPattern::BGGR ? 1 : 0;
  const std::size_t shiftY = pattern == BayerPattern::GBRG || pattern == BayerPattern::BGGR ? 1 : 0;
  return { { (column + shiftX) % 2, (row + shiftY) % 2 } };
}

BayerPattern
CutPattern(BayerPattern pattern, std::size_t columns, std::size_t rows)
{
  const std::array<std::size_t, 2> red = CornerOf(pattern, BayerPlane::R);
  for (const BayerPattern cut : Patterns)
  {
    const std::array<std::size_t, 2> corner = CornerOf(cut, BayerPlane::R);
    if (corner[0] == (red[0] + columns) % 2 && corner[1] == (red[1] + rows) % 2)
    {
      return cut;
    }
  }
  return pattern;
}

RollingShutter
RollingShutterOf(const std::string & name)
{
  if (name != "off" && name != "auto" && name != "fixed")
  {
    throw std::invalid_argument("the rolling shutter is \"" + name + "\"; expected off, auto or fixed");
  }
  return name == "off" ? RollingShutter::Off : name == "auto" ? RollingShutter::Auto : RollingShutter::Fixed;
}

const char *
NameOf(RollingShutter mode)
{
  return mode == RollingShutter::Off ? "off" : mode == RollingShutter::Auto ? "auto" : "fixed";
}

} // namespace sensornoise
