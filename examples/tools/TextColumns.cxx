// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "tools/TextColumns.h"

#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <fstream>
#include <stdexcept>

namespace sensornoise::tools
{

std::string
Trim(const std::string & text)
{
  const char * const space = " \r\n";
  const std::size_t  first = text.find_first_not_of(space);
  return first == std::string::npos ? "" : text.substr(first, text.find_last_not_of(space) + 1 - first);
}

std::vector<std::string>
SplitColumns(const std::string & text, const char * separators)
{
  std::vector<std::string> parts;
  std::size_t              begin = 0;
  for (std::size_t end = 0; end != std::string::npos; begin = end + 1)
  {
    end = text.find_first_of(separators, begin);
    parts.push_back(Trim(text.substr(begin, end == std::string::npos ? end : end - begin)));
  }
  return parts;
}

std::optional<double>
NumberOf(const std::string & word)
{
  char *       end = nullptr;
  const double number = std::strtod(word.c_str(), &end);
  return word.empty() || *end != '\0' || !std::isfinite(number) ? std::nullopt : std::optional<double>(number);
}

std::vector<std::string>
ReadLines(const std::string & file, const std::string & expected)
{
  std::ifstream stream(file);
  if (!stream)
  {
    throw std::runtime_error(expected);
  }
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);)
  {
    const bool hasMark = lines.empty() && line.rfind("\xEF\xBB\xBF", 0) == 0; // byte order mark of UTF-8
    lines.push_back(Trim(hasMark ? line.substr(3) : line));
  }
  return lines;
}

} // namespace sensornoise::tools
