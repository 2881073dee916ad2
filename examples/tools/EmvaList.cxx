// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "tools/EmvaList.h"

#include "tools/FileNames.h"
#include "tools/LowerCase.h"
#include "tools/TextColumns.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <utility>
#include <vector>

namespace sensornoise::tools
{
namespace
{
constexpr double NanosecondsPerSecond = 1e9;

/** Place in a list, and the error that names it. */
struct ListLine
{
  std::string file;
  std::size_t number;
  std::string text;

  std::string
  Where() const
  {
    return "line " + std::to_string(number) + " of " + file;
  }
  [[noreturn]] void
  Refuse(const std::string & expected) const
  {
    throw std::runtime_error(Where() + " is \"" + text.substr(0, 60) + "\"; expected " + expected);
  }
  double
  Number(const std::string & word, const std::string & what) const
  {
    const std::optional<double> found = NumberOf(word);
    if (!found || !(*found >= 0.0))
    {
      this->Refuse(what + ", a finite number of 0 or more, where \"" + word.substr(0, 40) + "\" stands");
    }
    return *found;
  }
};

/** Returns the lines that say something: without empty ones and comments. */
std::vector<ListLine>
LinesOf(const std::string & file)
{
  std::vector<ListLine> lines;
  std::size_t           number = 0;
  for (const std::string & text :
       ReadLines(file, file + " cannot be read; expected a list of exposures: a table or a descriptor of emva1288"))
  {
    ++number;
    if (!text.empty() && text.front() != '#')
    {
      lines.push_back({ file, number, text });
    }
  }
  if (lines.empty())
  {
    throw std::runtime_error(file + " is empty; expected a list of exposures");
  }
  return lines;
}

std::vector<std::string>
WordsOf(const std::string & text)
{
  std::istringstream       stream(text);
  std::vector<std::string> words;
  for (std::string word; stream >> word;)
  {
    words.push_back(word);
  }
  return words;
}

/** Returns the name in the folder of the list, unless it is absolute. */
std::string
InFolderOf(const std::string & list, const std::string & name)
{
  return (std::filesystem::path(list).parent_path() / name).string();
}

/** Reader of the descriptor of the package emva1288, line by line. */
class Descriptor
{
public:
  void
  Add(const ListLine & line)
  {
    const std::vector<std::string> words = WordsOf(line.text);
    const std::string &            kind = words.front();
    if (kind == "n" && words.size() == 4)
    {
      m_List.bitDepth = static_cast<unsigned int>(line.Number(words[1], "the bit depth"));
      m_List.width = static_cast<std::size_t>(line.Number(words[2], "the width"));
      m_List.height = static_cast<std::size_t>(line.Number(words[3], "the height"));
    }
    else if ((kind == "b" && words.size() == 3) || (kind == "d" && words.size() == 2))
    {
      EmvaSource source;
      source.exposure = Decimal(line, words[1]) / NanosecondsPerSecond;
      source.photons = kind == "b" ? Decimal(line, words[2]) : 0.0;
      source.isDark = kind == "d" || *source.photons == 0.0;
      source.where = line.Where();
      m_List.sources.push_back(source);
    }
    else if (kind == "i" && words.size() >= 2 && !m_List.sources.empty())
    {
      std::string name = Trim(line.text.substr(1));
      std::replace(name.begin(), name.end(), '\\', '/');
      m_List.sources.back().files.push_back(InFolderOf(line.file, name));
    }
    else if (kind != "v")
    {
      line.Refuse(
        "\"n BITS WIDTH HEIGHT\", \"b EXPOSURE PHOTONS\", \"d EXPOSURE\", or \"i FILE\" behind one of these two");
    }
  }

  EmvaSourceList
  Take()
  {
    m_List.exposureUnit = "s";
    return std::move(m_List);
  }

private:
  static double
  Decimal(const ListLine & line, std::string word)
  {
    std::replace(word.begin(), word.end(), ',', '.');
    return line.Number(word, "an exposure or photons");
  }

  EmvaSourceList m_List;
};

/** Returns the seconds of one unit of the column of the exposure; empty: the column has no unit. */
std::optional<double>
SecondsOf(const std::string & column)
{
  static const std::map<std::string, double> units{
    { "exposure_s", 1.0 }, { "exposure_ms", 1e-3 }, { "exposure_us", 1e-6 }, { "exposure_ns", 1e-9 }
  };
  const auto found = units.find(column);
  return found == units.end() ? std::nullopt : std::optional<double>(found->second);
}

/** Reader of a table, whose first line has the names of the columns. */
class Table
{
public:
  explicit Table(const ListLine & header)
  {
    for (const std::string & name : SplitColumns(header.text, Separators))
    {
      m_Columns.push_back(LowerCase(name) == "file" ? "files" : LowerCase(name));
    }
    for (const std::string & name : m_Columns)
    {
      const bool isExposure = name == "exposure" || SecondsOf(name);
      if (!isExposure && name != "files" && name != "photons" && name != "kind")
      {
        header.Refuse("the names of the columns: exposure (or exposure_s, exposure_ms, exposure_us, exposure_ns), "
                      "files, and optionally photons and kind. There is no column \"" +
                      name.substr(0, 40) + "\"");
      }
      if (isExposure && !m_Exposure.empty())
      {
        header.Refuse("one column of exposures; there are \"" + m_Exposure + "\" and \"" + name + "\"");
      }
      m_Exposure = isExposure ? name : m_Exposure;
    }
    if (m_Exposure.empty() || std::find(m_Columns.begin(), m_Columns.end(), "files") == m_Columns.end())
    {
      header.Refuse("the names of the columns, with exposure and files among them");
    }
  }

  EmvaSource
  SourceOf(const ListLine & line, bool areRaw) const
  {
    const std::vector<std::string> cells = SplitColumns(line.text, Separators);
    if (cells.size() != m_Columns.size())
    {
      line.Refuse(std::to_string(m_Columns.size()) + " columns, as the first line has; there are " +
                  std::to_string(cells.size()));
    }
    EmvaSource source;
    source.where = line.Where();
    std::string kind;
    for (std::size_t k = 0; k < cells.size(); ++k)
    {
      const std::string & name = m_Columns[k];
      if (name == m_Exposure)
      {
        source.exposure = line.Number(cells[k], "an exposure") * SecondsOf(name).value_or(1.0);
      }
      else if (name == "photons" && !cells[k].empty())
      {
        source.photons = line.Number(cells[k], "photons");
      }
      else if (name == "kind")
      {
        kind = LowerCase(cells[k]);
      }
      else if (name == "files")
      {
        source.files = FilesOf(line, cells[k], areRaw);
      }
    }
    if (!kind.empty() && kind != "dark" && kind != "flat")
    {
      line.Refuse("the kind flat or dark");
    }
    source.isDark = kind == "dark" || (kind.empty() && source.photons.value_or(source.exposure) == 0.0);
    source.photons = source.isDark ? 0.0 : source.photons;
    return source;
  }

  std::string
  Unit() const
  {
    return SecondsOf(m_Exposure) ? "s" : "";
  }

private:
  static constexpr const char * Separators = ",\t";

  static std::vector<std::string>
  FilesOf(const ListLine & line, const std::string & cell, bool areRaw)
  {
    std::vector<std::string> names;
    for (const std::string & name : SplitColumns(cell, ";"))
    {
      if (name.empty())
      {
        line.Refuse("names of files, with semicolons between them");
      }
      names.push_back(InFolderOf(line.file, name));
    }
    return ExpandNames(names, areRaw);
  }

  std::vector<std::string> m_Columns;
  std::string              m_Exposure; // name of its column
};

/** Returns whether the line begins like a line of an EMVA descriptor, with a single letter. */
bool
IsOfDescriptor(const ListLine & line)
{
  const std::vector<std::string> words = WordsOf(line.text);
  return words.size() > 1 && words.front().size() == 1 && std::string("nbdiv").find(words.front()) != std::string::npos;
}
} // namespace

bool
IsEmvaList(const std::string & file)
{
  const std::string ending = LowerCaseEnding(file);
  return ending == ".csv" || ending == ".tsv" || ending == ".txt";
}

EmvaSourceList
ReadEmvaList(const std::string & file, bool areRaw)
{
  const std::vector<ListLine> lines = LinesOf(file);
  EmvaSourceList              list;
  if (IsOfDescriptor(lines.front()))
  {
    Descriptor descriptor;
    for (const ListLine & line : lines)
    {
      descriptor.Add(line);
    }
    list = descriptor.Take();
  }
  else
  {
    const Table table(lines.front());
    for (std::size_t i = 1; i < lines.size(); ++i)
    {
      list.sources.push_back(table.SourceOf(lines[i], areRaw));
    }
    list.exposureUnit = table.Unit();
  }
  if (list.sources.empty())
  {
    throw std::runtime_error(file + " holds no series; expected flat fields and dark frames at several exposures");
  }
  for (const EmvaSource & source : list.sources)
  {
    if (source.files.empty())
    {
      throw std::runtime_error(source.where + " is followed by no file; expected lines \"i FILE\"");
    }
  }
  return list;
}

} // namespace sensornoise::tools
