// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sweep/Setting.h"

#include "base/ChiSquare.h"
#include "base/Text.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <regex>
#include <stdexcept>

namespace sensornoise
{

namespace
{
/** Returns the number of a text of digits with a decimal point; NaN if it is too large for a double. */
double
NumberOfDigits(const std::string & digits)
{
  return FiniteNumber(digits).value_or(std::numeric_limits<double>::quiet_NaN());
}

/** Returns the seconds of a unit of time: "us", "ms" or "s". */
double
SecondsOf(const std::string & unit)
{
  return unit == "us" ? 1e-6 : unit == "ms" ? 1e-3 : 1.0;
}
} // namespace

const char *
NameOf(SettingKind kind)
{
  return kind == SettingKind::Iso ? "iso" : kind == SettingKind::Gain ? "gain" : "exposure";
}

SettingKind
SettingKindOf(const std::string & name)
{
  for (const SettingKind kind : { SettingKind::Iso, SettingKind::Gain, SettingKind::Exposure })
  {
    if (name == NameOf(kind))
    {
      return kind;
    }
  }
  throw std::invalid_argument("the settings are \"" + name + "\"; expected \"iso\", \"gain\" or \"exposure\"");
}

std::string
SettingText(SettingKind kind, double setting)
{
  return kind == SettingKind::Iso    ? "ISO " + Text(setting)
         : kind == SettingKind::Gain ? "gain " + Text(setting)
                                     : "exposure " + Text(setting) + " s";
}

double
GainOfDecibels(double decibels)
{
  return std::pow(10.0, decibels / 20.0);
}

std::optional<NamedSetting>
SettingInName(const std::string & name)
{
  static const std::regex iso("(?:^|.*[^a-z])iso[ _-]*([0-9]+(?:\\.[0-9]+)?)(?:[^0-9.].*)?");
  static const std::regex gain("(?:^|.*[^a-z])gain[ _]*([+-]?[0-9]+(?:\\.[0-9]+)?)[ _]*(db)?(?:[^0-9.].*)?");
  static const std::regex exposure(
    "(?:^|(?:.*[^a-z])?exp(?:osure)?[ _-]*)([0-9]+(?:\\.[0-9]+)?)[ _]*(us|ms|s)(?:[^a-z0-9.].*)?");
  static const std::regex number("[0-9]+(?:\\.[0-9]+)?");
  const std::string       text = LowerCase(name);
  std::smatch             found;
  NamedSetting            setting;
  if (std::regex_match(text, found, iso))
  {
    setting.value = NumberOfDigits(found[1].str());
  }
  else if (std::regex_match(text, found, gain))
  {
    setting.kind = SettingKind::Gain;
    const double value = NumberOfDigits(found[1].str());
    setting.value = found[2].matched ? GainOfDecibels(value) : value;
  }
  else if (std::regex_match(text, found, exposure))
  {
    setting.kind = SettingKind::Exposure;
    setting.value = NumberOfDigits(found[1].str()) * SecondsOf(found[2].str());
  }
  else if (std::regex_match(text, number))
  {
    setting.value = NumberOfDigits(text);
  }
  return std::isfinite(setting.value) && setting.value > 0.0 ? std::optional<NamedSetting>(setting) : std::nullopt;
}

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
    AddInQuadrature((1.0 - weight) * low.error, weight * high.error, std::abs((x - low.x) * (high.x - x)) * curvature);
  return isLogarithmic ? NumberWithError{ std::exp(y), std::exp(y) * error } : NumberWithError{ y, error };
}

} // namespace sensornoise
