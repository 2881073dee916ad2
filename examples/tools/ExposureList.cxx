// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "tools/ExposureList.h"

#include "tools/OptionHints.h"
#include "tools/TextColumns.h"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <stdexcept>

namespace sensornoise::tools
{
namespace
{
/** Returns the separator of all lines: a tab if there is one, else a semicolon, else a comma. */
std::string
SeparatorOf(const std::vector<std::string> & lines)
{
  for (const char separator : { '\t', ';' })
  {
    if (std::any_of(lines.begin(), lines.end(), [separator](const std::string & line) {
          return line.find(separator) != std::string::npos;
        }))
    {
      return { separator };
    }
  }
  return ",";
}

/** Reader of the columns of an exposure file, line by line. */
class ExposureFile
{
public:
  ExposureFile(const std::string & name, const std::string & separator)
    : m_Name(name)
    , m_Separator(separator)
  {}

  void
  AddLine(std::size_t number, const std::string & line)
  {
    const std::vector<std::string> columns = SplitColumns(line, m_Separator.c_str());
    const std::optional<double>    exposure = this->NumberIn(columns.back());
    m_AreAllAmbiguous =
      m_AreAllAmbiguous && columns.size() == 2 && std::all_of(columns.begin(), columns.end(), IsWholeNumber);
    if (m_Columns == 0)
    {
      m_Columns = columns.size();
      if (!exposure)
      {
        return; // this line is a header
      }
    }
    const std::string where = "--exposures: line " + std::to_string(number) + " of " + m_Name;
    if (columns.size() != m_Columns)
    {
      throw std::runtime_error(
        where + " has " + std::to_string(columns.size()) + " columns; expected " + std::to_string(m_Columns) +
        ", as the lines before" +
        (m_Separator == "," ? ". Write decimals with a point, or separate columns by semicolons" : ""));
    }
    if (!exposure)
    {
      throw std::runtime_error(where + " ends with \"" + columns.back().substr(0, 40) +
                               "\"; expected a number, the exposure of a frame");
    }
    m_Exposures.push_back(*exposure);
  }

  /** Returns the exposures. Throws std::runtime_error if there are none, or if each line may also be one number with a
   * decimal comma. */
  const std::vector<double> &
  GetExposures() const
  {
    if (m_Exposures.empty())
    {
      throw std::runtime_error("--exposures: " + m_Name + " holds no exposures; expected one line for each frame");
    }
    if (m_AreAllAmbiguous && m_Separator == ",")
    {
      throw std::runtime_error("--exposures: each line of " + m_Name +
                               " is two whole numbers and a comma: two columns, or one number with a decimal comma. "
                               "Name the columns in a first line, as frame,exposure, or write decimals with a point");
    }
    return m_Exposures;
  }

private:
  /** Returns the number of a column. A comma that does not separate columns is a decimal comma. */
  std::optional<double>
  NumberIn(std::string column) const
  {
    if (m_Separator != ",")
    {
      std::replace(column.begin(), column.end(), ',', '.');
    }
    return NumberOf(column);
  }

  std::string         m_Name;
  std::string         m_Separator;
  bool                m_AreAllAmbiguous{ true }; // all lines so far are two whole numbers
  std::size_t         m_Columns{ 0 };            // columns of the first line; 0: no line yet
  std::vector<double> m_Exposures;
};
} // namespace

bool
IsExposureList(const std::string & text)
{
  const std::vector<std::string> words = SplitColumns(text, ",");
  return std::all_of(words.begin(), words.end(), [](const std::string & word) { return NumberOf(word).has_value(); });
}

std::vector<double>
ReadExposures(const std::string & text)
{
  std::vector<double> exposures;
  if (IsExposureList(text))
  {
    for (const std::string & word : SplitColumns(text, ","))
    {
      exposures.push_back(*NumberOf(word));
    }
    return exposures;
  }
  std::vector<std::string> read =
    ReadLines(text,
              "--exposures: \"" + text +
                "\" is neither a list of numbers with commas nor a file that can be read; expected one "
                "exposure for each frame, for instance 0,0,10,10,20,20, or a file with one frame a line");
  for (std::string & line : read)
  {
    line = line.rfind('#', 0) == 0 ? "" : line; // a comment
  }
  ExposureFile lines(text, SeparatorOf(read));
  std::size_t  number = 0;
  for (const std::string & line : read)
  {
    ++number;
    if (!line.empty())
    {
      lines.AddLine(number, line);
    }
  }
  return lines.GetExposures();
}

} // namespace sensornoise::tools
