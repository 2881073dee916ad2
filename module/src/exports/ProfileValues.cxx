// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "exports/ProfileValues.h"

#include "exports/NoiseProfile.h"
#include "base/NumberText.h"
#include "base/Text.h"
#include "files/TextHeader.h"

#include <cmath>
#include <cstddef>
#include <sstream>
#include <utility>

namespace sensornoise
{
namespace
{
bool
EndsWith(const std::string & text, const std::string & end)
{
  return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

/** One line of YAML: a name, and the text behind the colon, which may be empty. */
struct YamlLine
{
  std::string name;
  std::string value;
};

/** Returns the name and the value of a line without its indentation. A name may be a string in quotation marks. None:
 * the line has no name. */
std::optional<YamlLine>
YamlLineOf(const std::string & line)
{
  const bool        isQuoted = line.front() == '"' || line.front() == '\'';
  const std::size_t end = isQuoted ? line.find(line.front(), 1) : line.find(':');
  const std::size_t colon = end == std::string::npos ? end : line.find(':', end);
  if (colon == std::string::npos)
  {
    return std::nullopt;
  }
  const std::string rest = line.substr(colon + 1);
  const std::size_t comment = rest.find(" #");
  return YamlLine{ WithoutBlanks(line.substr(isQuoted ? 1 : 0, end - (isQuoted ? 1 : 0))),
                   WithoutBlanks(rest.substr(0, comment)) };
}
} // namespace

bool
ProfileValues::Has(const std::string & member) const
{
  const auto has = [&](const auto & values) {
    for (const auto & [pointer, value] : values)
    {
      if (EndsWith(pointer, "/" + member) || pointer.find("/" + member + "/") != std::string::npos)
      {
        return true;
      }
    }
    return false;
  };
  return has(m_Record.numbers) || has(m_Record.texts);
}

std::optional<double>
ProfileValues::Find(const std::string & member) const
{
  std::optional<double> found;
  for (const auto & [pointer, value] : m_Record.numbers)
  {
    if (EndsWith(pointer, "/" + member))
    {
      if (found)
      {
        throw ExportError("the profile " + this->File() + " has several values of " + member +
                          "; expected one. Leave only the camera and the mode of these frames in a copy of the file.");
      }
      found = value;
    }
  }
  return found;
}

double
ProfileValues::Number(const std::string & member) const
{
  const std::optional<double> found = this->Find(member);
  if (!found || !std::isfinite(*found))
  {
    throw ExportError("the profile " + this->File() + " has no number " + member +
                      ", which its program needs. Expected a whole file of this program.");
  }
  return *found;
}

double
ProfileValues::Positive(const std::string & member) const
{
  const double number = this->Number(member);
  if (!(number > 0.0))
  {
    throw ExportError("the profile " + this->File() + " has " + member + " = " + Text(number) +
                      "; expected a number above 0");
  }
  return number;
}

double
ProfileValues::NotNegative(const std::string & member) const
{
  const double number = this->Number(member);
  if (number < 0.0)
  {
    throw ExportError("the profile " + this->File() + " has " + member + " = " + Text(number) + "; expected 0 or more");
  }
  return number;
}

std::vector<double>
ProfileValues::List(const std::string & list) const
{
  std::vector<double> numbers;
  for (std::size_t i = 0;; ++i)
  {
    const auto found = m_Record.numbers.find("/" + list + "/" + std::to_string(i));
    if (found == m_Record.numbers.end())
    {
      return numbers;
    }
    numbers.push_back(found->second);
  }
}

std::vector<std::string>
ProfileValues::Texts(const std::string & list) const
{
  std::vector<std::string> texts;
  for (std::size_t i = 0;; ++i)
  {
    const auto found = m_Record.texts.find("/" + list + "/" + std::to_string(i));
    if (found == m_Record.texts.end())
    {
      return texts;
    }
    texts.push_back(found->second);
  }
}

StoredReport
ReadYamlValues(const std::string & file, const std::string & text)
{
  StoredReport record;
  record.name = file;
  std::vector<std::pair<std::size_t, std::string>> parents; // indentation and pointer
  std::istringstream                               stream(text);
  for (std::string line; std::getline(stream, line);)
  {
    const std::size_t indent = line.find_first_not_of(" \t\r");
    const auto        found =
      indent == std::string::npos || line[indent] == '#' ? std::nullopt : YamlLineOf(line.substr(indent));
    if (!found)
    {
      continue;
    }
    while (!parents.empty() && parents.back().first >= indent)
    {
      parents.pop_back();
    }
    if (found->name.size() > MostProfileNameBytes)
    {
      throw ExportError("the profile " + file + " has a name of " + std::to_string(found->name.size()) +
                        " bytes; expected at most " + std::to_string(MostProfileNameBytes));
    }
    const std::string pointer = (parents.empty() ? "" : parents.back().second) + "/" + found->name;
    const auto        number = FiniteNumber(found->value);
    if (found->value.empty())
    {
      parents.emplace_back(indent, pointer);
    }
    else if (number)
    {
      record.numbers[pointer] = *number;
    }
    else
    {
      record.texts[pointer] = found->value;
    }
  }
  return record;
}

} // namespace sensornoise
