// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sweep/NoiseInterpolation.h"

#include "base/Text.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>

namespace sensornoise
{
namespace
{
/** A point of the line: ln(setting), and the number or its logarithm. */
struct LinePoint
{
  double x{ 0.0 };
  double y{ 0.0 };
  double error{ 0.0 };
};

LinePoint
PointOf(const SettingNumber & number, bool isLogarithmic)
{
  const NumberWithError & of = number.number;
  return isLogarithmic ? LinePoint{ std::log(number.setting), std::log(of.value), of.standardError / of.value }
                       : LinePoint{ std::log(number.setting), of.value, of.standardError };
}

double
SecondDifference(const LinePoint & a, const LinePoint & b, const LinePoint & c)
{
  return ((c.y - b.y) / (c.x - b.x) - (b.y - a.y) / (b.x - a.x)) / (c.x - a.x);
}

/** Returns the place of the neighbour above a setting, which is between the first and the last of them. */
std::size_t
PlaceAbove(const std::vector<SettingNumber> & points, double setting)
{
  const auto above = std::find_if(
    points.begin() + 1, points.end() - 1, [setting](const SettingNumber & each) { return each.setting >= setting; });
  return static_cast<std::size_t>(above - points.begin());
}
} // namespace

NumberWithError
InterpolateNumber(const std::vector<SettingNumber> & points, double setting, bool isLogarithmic)
{
  if (points.size() < 2 || !(setting >= points.front().setting && setting <= points.back().setting))
  {
    throw std::invalid_argument("the setting is " + Text(setting) +
                                "; expected a setting between two measured ones, where nothing is extrapolated");
  }
  std::vector<LinePoint> line;
  line.reserve(points.size());
  for (const SettingNumber & each : points)
  {
    line.push_back(PointOf(each, isLogarithmic));
  }
  const std::size_t above = PlaceAbove(points, setting);
  const LinePoint & low = line[above - 1];
  const LinePoint & high = line[above];
  const double      x = std::log(setting);
  const double      weight = (x - low.x) / (high.x - low.x);
  const double      y = (1.0 - weight) * low.y + weight * high.y;
  double            curvature = above > 1 ? std::abs(SecondDifference(line[above - 2], low, high)) : 0.0;
  curvature =
    above + 1 < line.size() ? std::max(curvature, std::abs(SecondDifference(low, high, line[above + 1]))) : curvature;
  const double error =
    std::hypot((1.0 - weight) * low.error, weight * high.error, std::abs((x - low.x) * (high.x - x)) * curvature);
  return isLogarithmic ? NumberWithError{ std::exp(y), std::exp(y) * error } : NumberWithError{ y, error };
}

} // namespace sensornoise
