// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "tools/SweepTable.h"

#include "tools/LowerCase.h"
#include "tools/TextColumns.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

namespace sensornoise::tools
{
namespace
{
/** The places of the columns of a table. */
struct SweepTableColumns
{
  std::size_t setting{ 0 };
  SettingKind kind{ SettingKind::Iso };
  bool        isDecibels{ false };
  double      unit{ 1.0 }; ///< factor of the settings to seconds, 0.001 for milliseconds; 1 for other kinds
  std::size_t frames{ 0 };
  std::optional<std::size_t> dark;
};

std::optional<std::size_t>
PlaceOf(const std::vector<std::string> & header, const std::string & name)
{
  const auto found =
    std::find_if(header.begin(), header.end(), [&name](const std::string & each) { return LowerCase(each) == name; });
  return found == header.end() ? std::nullopt
                               : std::optional<std::size_t>(static_cast<std::size_t>(found - header.begin()));
}

/** Throws std::runtime_error unless the header has one column for the setting, frames, and dark at most once. */
void
RequireKnownColumns(const std::vector<std::string> & header, const std::string & setting, const std::string & where)
{
  const std::array<std::string, 3> known{ setting, "frames", "dark" };
  for (std::size_t place = 0; place < header.size(); ++place)
  {
    const std::string name = LowerCase(header[place]);
    if (std::find(known.begin(), known.end(), name) == known.end())
    {
      throw std::runtime_error(
        where + " has the columns " + setting + " and \"" + header[place].substr(0, 40) + "\"; expected " + setting +
        ", frames and, if there are dark frames, dark. There is no " + "other column: leave it out, or rename it");
    }
    if (*PlaceOf(header, name) != place)
    {
      throw std::runtime_error(where + " has the column " + name + " twice; expected each column once");
    }
  }
}

SweepTableColumns
ColumnsOf(const std::vector<std::string> & header, const std::string & where)
{
  SweepTableColumns                                      columns;
  std::optional<std::size_t>                             setting;
  const std::vector<std::pair<std::string, SettingKind>> names{ { "iso", SettingKind::Iso },
                                                                { "gain", SettingKind::Gain },
                                                                { "gain_db", SettingKind::Gain },
                                                                { "exposure", SettingKind::Exposure },
                                                                { "exposure_ms", SettingKind::Exposure } };
  for (const auto & [name, kind] : names)
  {
    if (const auto place = PlaceOf(header, name))
    {
      setting = place;
      columns.kind = kind;
      columns.isDecibels = name == "gain_db";
      columns.unit = name == "exposure_ms" ? 1e-3 : 1.0;
      break;
    }
  }
  const auto frames = PlaceOf(header, "frames");
  if (!setting || !frames)
  {
    throw std::runtime_error(where + " has no column " +
                             (setting ? "frames" : "iso, gain, gain_db, exposure or exposure_ms") +
                             "; expected a header such as iso,frames,dark");
  }
  RequireKnownColumns(header, LowerCase(header[*setting]), where);
  columns.setting = *setting;
  columns.frames = *frames;
  columns.dark = PlaceOf(header, "dark");
  return columns;
}

SweepTableRow
RowOf(const std::vector<std::string> & cells,
      const SweepTableColumns &        columns,
      const std::filesystem::path &    folder,
      const std::string &              where)
{
  const std::optional<double> number = NumberOf(cells[columns.setting]);
  SweepTableRow               row;
  row.setting.kind = columns.kind;
  row.setting.value = columns.isDecibels ? GainOfDecibels(number.value_or(0.0)) : number.value_or(0.0) * columns.unit;
  if (!number || !(row.setting.value > 0.0) || !std::isfinite(row.setting.value))
  {
    throw std::runtime_error(where + " has the setting \"" + cells[columns.setting].substr(0, 40) +
                             "\"; expected a finite number" + (columns.isDecibels ? "" : " above 0"));
  }
  const auto inFolder = [&folder](const std::string & name) { return name.empty() ? "" : (folder / name).string(); };
  row.frames = inFolder(cells[columns.frames]);
  row.dark = columns.dark ? inFolder(cells[*columns.dark]) : "";
  if (row.frames.empty())
  {
    throw std::runtime_error(where + " has no frames; expected a file, a folder or a pattern");
  }
  return row;
}
} // namespace

std::vector<SweepTableRow>
ReadSweepTable(const std::string & file)
{
  const std::string expected =
    "--sweep: the table " + file + " cannot be read; expected a text file with a header such as iso,frames,dark";
  if (std::filesystem::is_directory(file))
  {
    throw std::runtime_error(expected);
  }
  const std::filesystem::path      folder = std::filesystem::path(file).parent_path();
  std::optional<SweepTableColumns> columns;
  std::size_t                      width = 0;
  std::vector<SweepTableRow>       rows;
  std::size_t                      number = 0;
  for (const std::string & line : ReadLines(file, expected))
  {
    ++number;
    if (line.empty() || line.front() == '#')
    {
      continue;
    }
    const std::string              where = "--sweep: line " + std::to_string(number) + " of " + file;
    const std::vector<std::string> cells = SplitColumns(line, ",;\t");
    if (!columns)
    {
      columns = ColumnsOf(cells, where);
      width = cells.size();
      continue;
    }
    if (cells.size() != width)
    {
      throw std::runtime_error(where + " has " + std::to_string(cells.size()) + " columns; expected " +
                               std::to_string(width) + ", as the header");
    }
    rows.push_back(RowOf(cells, *columns, folder, where));
  }
  if (rows.empty())
  {
    throw std::runtime_error("--sweep: " + file +
                             " has no line with a setting; expected a header such as "
                             "iso,frames,dark and a line for each setting");
  }
  return rows;
}

} // namespace sensornoise::tools
