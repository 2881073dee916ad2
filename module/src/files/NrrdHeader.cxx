// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "files/NrrdHeader.h"

#include "sensornoise/FrameFile.h"
#include "files/TextHeader.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>

namespace sensornoise
{
namespace
{
constexpr std::array<const char *, 32> NrrdFields{ "content",
                                                   "number",
                                                   "type",
                                                   "block size",
                                                   "dimension",
                                                   "space",
                                                   "space dimension",
                                                   "sizes",
                                                   "spacings",
                                                   "thicknesses",
                                                   "axis mins",
                                                   "axis maxs",
                                                   "space directions",
                                                   "centers",
                                                   "centerings",
                                                   "kinds",
                                                   "labels",
                                                   "units",
                                                   "min",
                                                   "max",
                                                   "old min",
                                                   "old max",
                                                   "endian",
                                                   "encoding",
                                                   "line skip",
                                                   "byte skip",
                                                   "sample units",
                                                   "space units",
                                                   "space origin",
                                                   "measurement frame",
                                                   "data file",
                                                   "datafile" };

/** The name of the field that `key` is, in any of its spellings; empty where it is none. */
std::string
FieldNamed(const std::string & key)
{
  const std::string name = InSmallLetters(key);
  for (const char * const field : NrrdFields)
  {
    std::string joined = field;
    joined.erase(std::remove(joined.begin(), joined.end(), ' '), joined.end());
    if (name == field || name == joined)
    {
      return name == "datafile" ? "data file" : name == "centers" ? "centerings" : field;
    }
  }
  return "";
}

/** Parts a line and keeps what it says. Returns the name of its field, empty where it is a comment or a key. */
std::string
AddNrrdField(const std::string & file, const TextHeader & text, const std::string & line, NrrdHeader & header)
{
  if (line[0] == '#')
  {
    return "";
  }
  const std::string place = "line " + std::to_string(text.LineNumber()) + " of its header ";
  const std::size_t colon = line.find(": ");
  std::string       name = colon == std::string::npos ? "" : FieldNamed(line.substr(0, colon));
  if (name.empty())
  {
    if (line.find(":=") == std::string::npos)
    {
      throw FileError(file, place + "is neither a field of NRRD nor a comment nor a key with its value");
    }
    return "";
  }
  const std::size_t first = line.find_first_not_of(" \t", colon + 1);
  if (first == std::string::npos)
  {
    throw FileError(file, place + "gives no value for " + name + "; expected one");
  }
  if (!header.fields.emplace(name, line.substr(first)).second)
  {
    throw FileError(file, place + "gives " + name + " a second time; expected each field once");
  }
  return name;
}
} // namespace

std::string
InSmallLetters(std::string text)
{
  std::transform(text.begin(), text.end(), text.begin(), [](char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  });
  return text;
}

std::string
NrrdHeader::Field(const std::string & key) const
{
  const auto found = fields.find(key);
  return found == fields.end() ? "" : found->second;
}

NrrdHeader
ReadNrrdHeader(const std::string & file, FileBytes & bytes)
{
  NrrdHeader                 header;
  TextHeader                 text(file, bytes);
  std::optional<std::string> line = text.Next();
  if (!line || line->size() != 8 || line->rfind("NRRD000", 0) != 0 || line->back() < '1' || line->back() > '5')
  {
    throw FileError(file, "its first line is not NRRD0001 to NRRD0005; expected a NRRD file of one of these versions");
  }
  bool ended = false;
  bool isList = false;
  while (!ended && (line = text.Next()))
  {
    if (!text.LineWasEnded())
    {
      throw FileError(file, "truncated: the last line of its header has no end");
    }
    if (isList && !line->empty())
    {
      header.list.push_back(*line);
    }
    else if (line->empty())
    {
      ended = !isList;
    }
    else
    {
      isList =
        AddNrrdField(file, text, *line, header) == "data file" && header.Field("data file").rfind("LIST", 0) == 0;
    }
  }
  header.end = text.Offset();
  if (!ended && header.Field("data file").empty())
  {
    throw FileError(file, "truncated: its header does not end with an empty line, and names no data file");
  }
  return header;
}

} // namespace sensornoise
