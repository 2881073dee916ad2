// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "report/TextSigns.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstring>
#include <string>
#include <utility>

namespace sensornoise
{

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

} // namespace sensornoise
