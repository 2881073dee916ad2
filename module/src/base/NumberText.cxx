// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "base/NumberText.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <locale>
#include <sstream>
#include <string>

namespace sensornoise
{
namespace
{
constexpr std::size_t BufferCharacters = 400; // a double has at most 309 digits before the point
constexpr int         MostDecimals = 20;
} // namespace

#if defined(__cpp_lib_to_chars)

std::string
ShortestText(double number)
{
  char buffer[BufferCharacters];
  return { buffer, std::to_chars(buffer, buffer + sizeof(buffer), number).ptr };
}

std::string
FixedText(double number, int decimals)
{
  char      buffer[BufferCharacters];
  const int digits = std::clamp(decimals, 0, MostDecimals);
  return { buffer, std::to_chars(buffer, buffer + sizeof(buffer), number, std::chars_format::fixed, digits).ptr };
}

std::string
GeneralText(double number, int digits)
{
  char buffer[BufferCharacters];
  return { buffer, std::to_chars(buffer, buffer + sizeof(buffer), number, std::chars_format::general, digits).ptr };
}

#else

// The C++ library of Emscripten 3.1 has no std::to_chars() for floating-point numbers. It has one locale, whose point
// is ".".
std::string
ShortestText(double number)
{
  constexpr int always = 17; // digits with which every double is read again
  std::string   text;
  for (int digits = 1; digits <= always; ++digits)
  {
    text = GeneralText(number, digits);
    if (std::strtod(text.c_str(), nullptr) == number)
    {
      break;
    }
  }
  return text;
}

std::string
FixedText(double number, int decimals)
{
  char buffer[BufferCharacters];
  std::snprintf(buffer, sizeof(buffer), "%.*f", std::clamp(decimals, 0, MostDecimals), number);
  return buffer;
}

std::string
GeneralText(double number, int digits)
{
  char buffer[BufferCharacters];
  std::snprintf(buffer, sizeof(buffer), "%.*g", digits, number);
  return buffer;
}

#endif

std::optional<double>
FiniteNumber(const std::string & text)
{
  // not strtod(), which uses the decimal comma of some locales
  std::istringstream stream(text);
  stream.imbue(std::locale::classic());
  double number = 0;
  if (!(stream >> number) || !std::isfinite(number) || stream.peek() != std::istringstream::traits_type::eof())
  {
    return std::nullopt;
  }
  return number;
}

} // namespace sensornoise
