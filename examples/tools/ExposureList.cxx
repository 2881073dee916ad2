// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "tools/ExposureList.h"

#include "tools/TextColumns.h"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <stdexcept>

namespace sensornoise::tools
{
namespace
{
/** Reader of the columns of an exposure file, line by line. */
class ExposureFile
{
public:
  explicit ExposureFile(const std::string & name)
    : m_Name(name)
  {}

  void
  AddLine(std::size_t number, const std::string & line)
  {
    const std::vector<std::string> columns = SplitColumns(line, ",;\t");
    const std::optional<double>    exposure = NumberOf(columns.back());
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
      throw std::runtime_error(where + " has " + std::to_string(columns.size()) + " columns; expected " +
                               std::to_string(m_Columns) + ", as the lines before");
    }
    if (!exposure)
    {
      throw std::runtime_error(where + " ends with \"" + columns.back().substr(0, 40) +
                               "\"; expected a number, the exposure of a frame");
    }
    m_Exposures.push_back(*exposure);
  }

  const std::vector<double> &
  GetExposures() const
  {
    return m_Exposures;
  }

private:
  std::string         m_Name;
  std::size_t         m_Columns{ 0 }; // columns of the first line; 0: no line yet
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
  const std::vector<std::string> read =
    ReadLines(text,
              "--exposures: \"" + text +
                "\" is neither a list of numbers with commas nor a file that can be read; expected one "
                "exposure for each frame, for instance 0,0,10,10,20,20, or a file with one frame a line");
  ExposureFile lines(text);
  std::size_t  number = 0;
  for (const std::string & line : read)
  {
    ++number;
    if (!line.empty() && line.front() != '#')
    {
      lines.AddLine(number, line);
    }
  }
  if (lines.GetExposures().empty())
  {
    throw std::runtime_error("--exposures: " + text + " holds no exposures; expected one line for each frame");
  }
  return lines.GetExposures();
}

} // namespace sensornoise::tools
