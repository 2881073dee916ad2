// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "base/Text.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>

namespace sensornoise
{

std::string
Text(double number)
{
  std::ostringstream text;
  text.precision(6);
  text << number;
  return text.str();
}

std::string
Rounded(double number)
{
  const bool         isLarge = std::abs(number) >= 999.5;
  std::ostringstream text;
  text.precision(isLarge ? 15 : 3);
  text << (isLarge ? std::round(number) : number);
  return text.str();
}

std::string
RoundedApart(double number, double bound)
{
  const std::string other = Rounded(bound);
  std::string       text = Rounded(number);
  constexpr int     most = 15; // number of digits of a double
  for (int digits = 4; text == other && number != bound && digits <= most; ++digits)
  {
    std::ostringstream longer;
    longer.precision(digits);
    longer << number;
    text = longer.str();
  }
  return text;
}

std::string
Percent(double fraction)
{
  return Rounded(100.0 * fraction) + " %";
}

std::string
PercentApart(double fraction, double bound)
{
  return RoundedApart(100.0 * fraction, 100.0 * bound) + " %";
}

std::string
Measured(double value, double standardError)
{
  constexpr double least = 1e-300; // smaller numbers may have fewer than two digits, which std::stod does not read
  if (!(standardError > least) || !std::isfinite(standardError) || !std::isfinite(value))
  {
    return Text(value) + " +- " + Text(standardError);
  }
  // Place of the second digit of the error, after rounding it to two digits: 0.0996 is 0.10.
  std::ostringstream twoDigits;
  twoDigits << std::scientific << std::setprecision(1) << standardError;
  const int  place = static_cast<int>(std::floor(std::log10(std::stod(twoDigits.str())) + 1e-9)) - 1;
  const auto rounded = [unit = std::pow(10.0, place), place](double number) {
    return place > 0 ? std::round(number / unit) * unit : number;
  };
  std::ostringstream text;
  text << std::fixed << std::setprecision(std::max(0, -place));
  text << rounded(value) << " +- " << rounded(standardError);
  return text.str();
}

} // namespace sensornoise
