// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "base/Text.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <iomanip>
#include <locale>
#include <sstream>
#include <string>
#include <utility>

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
  char          text[BufferCharacters];
  int           decimals = -1;
  do
  {
    std::snprintf(text, sizeof(text), "%.*e", ++decimals, number);
  } while (decimals + 1 < always && std::strtod(text, nullptr) != number);
  const std::string shortest = text;
  const int         exponent = std::atoi(shortest.c_str() + shortest.find('e') + 1);
  std::snprintf(text, sizeof(text), "%.*f", std::max(0, decimals - exponent), number);
  return std::strlen(text) <= shortest.size() ? text : shortest;
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
  // strtod() is not used: it reads the decimal comma of some locales
  std::istringstream stream(text);
  stream.imbue(std::locale::classic());
  double number = 0;
  if (!(stream >> number) || !std::isfinite(number) || stream.peek() != std::istringstream::traits_type::eof())
  {
    return std::nullopt;
  }
  return number;
}

std::optional<double>
FortranNumber(std::string text)
{
  std::replace(text.begin(), text.end(), 'D', 'E');
  return FiniteNumber(text);
}

namespace
{
/** A string, and the string that replaces it. */
using Replacement = std::pair<const char *, const char *>;

/** Returns the text with the first string of each pair replaced by the second. */
template <std::size_t VCount>
std::string
Replace(std::string text, const std::array<Replacement, VCount> & replacements)
{
  for (const auto & [part, other] : replacements)
  {
    const std::string found = part;
    const std::string by = other;
    for (std::size_t at = text.find(found); at != std::string::npos; at = text.find(found, at + by.size()))
    {
      text.replace(at, found.size(), by);
    }
  }
  return text;
}

/** Returns the blanks that fill the text up to \a width characters. */
std::string
BlanksFor(const std::string & text, std::size_t width)
{
  const std::size_t characters = CharactersIn(text);
  return std::string(width > characters ? width - characters : 0, ' ');
}
} // namespace

std::string
WithSigns(std::string text)
{
  constexpr std::array<Replacement, 4> signs{
    { { " +- ", " \u00B1 " }, { "DN/e-", "DN/e\u207B" }, { "[e-]", "[e\u207B]" }, { "^2", "\u00B2" } }
  };
  return text == "e-" ? "e\u207B" : Replace(std::move(text), signs);
}

std::string
WithoutSigns(const std::string & text)
{
  constexpr std::array<Replacement, 10> letters{ { { "\u00A0", " " },
                                                   { "\u2212", "-" },
                                                   { "\u00B1", "+-" },
                                                   { "\u00B2", "^2" },
                                                   { "\u207B", "-" },
                                                   { "\u03C7", "chi" },
                                                   { "\u03C3", "sigma" },
                                                   { "\u03BC", "mu" },
                                                   { "\u00D7", "x" },
                                                   { "\u2013", "-" } } };
  std::string                           ascii;
  std::size_t                           excess = 0; // number of characters added to the current line
  for (std::size_t at = 0; at < text.size();)
  {
    const auto sign = std::find_if(letters.begin(), letters.end(), [&](const Replacement & letter) {
      return text.compare(at, std::strlen(letter.first), letter.first) == 0;
    });
    if (sign != letters.end())
    {
      ascii += sign->second;
      excess += std::strlen(sign->second) - 1;
      at += std::strlen(sign->first);
      continue;
    }
    const bool isPadding = text[at] == ' ' && !ascii.empty() && ascii.back() == ' ' && excess > 0;
    excess = text[at] == '\n' ? 0 : excess - (isPadding ? 1 : 0);
    ascii += isPadding ? std::string() : std::string(1, text[at]);
    ++at;
  }
  return ascii;
}

std::size_t
CharactersIn(const std::string & text)
{
  // A byte 10xxxxxx continues the character before it.
  return static_cast<std::size_t>(
    std::count_if(text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; }));
}

std::string
PaddedRight(const std::string & text, std::size_t width)
{
  return text + BlanksFor(text, width);
}

std::string
PaddedLeft(const std::string & text, std::size_t width)
{
  return BlanksFor(text, width) + text;
}

namespace
{
/** Returns the number of bytes of the UTF-8 character at `at`; 0 for invalid bytes and control characters. */
std::size_t
CharacterBytes(const std::string & text, std::size_t at)
{
  const auto        byte = [&text](std::size_t i) { return static_cast<unsigned char>(i < text.size() ? text[i] : 0); };
  const unsigned    first = byte(at);
  const std::size_t count = first < 0x80                    ? 1
                            : first >= 0xC2 && first < 0xE0 ? 2
                            : first >= 0xE0 && first < 0xF0 ? 3
                            : first >= 0xF0 && first < 0xF5 ? 4
                                                            : 0;
  for (std::size_t i = 1; i < count; ++i)
  {
    if ((byte(at + i) & 0xC0) != 0x80)
    {
      return 0;
    }
  }
  const unsigned second = byte(at + 1);
  const bool     isTooLong = (first == 0xE0 && second < 0xA0) || (first == 0xF0 && second < 0x90);
  const bool     isNoCharacter = (first == 0xED && second >= 0xA0) || (first == 0xF4 && second >= 0x90);
  const bool     isControl = first < ' ' || first == 0x7F || (first == 0xC2 && second < 0xA0);
  return isTooLong || isNoCharacter || isControl ? 0 : count;
}
} // namespace

std::string
OneLine(const std::string & text)
{
  std::string line;
  for (std::size_t at = 0; at < text.size();)
  {
    const std::size_t count = CharacterBytes(text, at);
    line += count == 0 ? "?" : text.substr(at, count);
    at += count == 0 ? 1 : count;
  }
  return line;
}

} // namespace sensornoise
