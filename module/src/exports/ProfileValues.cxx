// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "exports/NoiseProfile.h"

#include "base/Text.h"
#include "files/FileBytes.h"
#include "files/TextHeader.h"
#include "files/Zlib.h"
#include "sensornoise/NoiseExport.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
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

namespace
{
// ZIP: PKWARE's APPNOTE.TXT, 4.3.7 local header, 4.3.12 central directory, 4.3.16 its end. NPY: NumPy's format 1.0
// to 3.0.

constexpr std::size_t localHeadBytes = 30;
constexpr std::size_t centralHeadBytes = 46;
constexpr std::size_t endRecordBytes = 22;
/** Largest array [bytes] and most arrays of an archive, as several names may have one array. Chosen: a model of one
 * Gaussian has four arrays of at most 48 bytes behind 128 bytes of head. */
constexpr std::size_t   mostMemberBytes = 65536;
constexpr std::uint64_t mostMembers = 64;

/** Returns a number of little endian in an archive. Throws ExportError if the archive ends before it. */
std::uint64_t
ArchiveNumber(const std::string & bytes, std::size_t offset, std::size_t count)
{
  if (offset > bytes.size() || bytes.size() - offset < count)
  {
    throw ExportError("the NumPy archive ends at byte " + std::to_string(bytes.size()) +
                      ", before the end of its directory; expected a whole file");
  }
  return NumberInBytes(reinterpret_cast<const unsigned char *>(bytes.data()) + offset, count, false);
}

std::string
ArchiveText(const std::string & bytes, std::size_t offset, std::size_t count)
{
  ArchiveNumber(bytes, offset + count, 0); // throws if the text is not whole
  return bytes.substr(offset, count);
}

[[noreturn]] void
RefuseMember(const std::string & name, const std::string & found)
{
  throw ExportError("the member " + name + " of the NumPy archive " + found +
                    "; expected an array of float32 or float64 without compression, as numpy.savez() writes it");
}

/** Returns the values of an NPY file. */
std::vector<double>
ValuesOfNpy(const std::string & name, const std::string & npy)
{
  const bool isNpy = npy.size() > 12 && npy.compare(0, 6, "\x93NUMPY") == 0;
  if (!isNpy)
  {
    RefuseMember(name, "is no array");
  }
  const std::size_t lengthBytes = npy[6] == 1 ? 2 : 4;
  const std::size_t begin = 8 + lengthBytes;
  const std::string head = ArchiveText(npy, begin, ArchiveNumber(npy, 8, lengthBytes));
  const bool        isFloat = head.find("'<f4'") != std::string::npos;
  if ((!isFloat && head.find("'<f8'") == std::string::npos) || head.find("'fortran_order': True") != std::string::npos)
  {
    RefuseMember(name, "has the header " + head.substr(0, head.find('\n')));
  }
  const std::size_t   size = isFloat ? 4 : 8;
  std::vector<double> values;
  for (std::size_t at = begin + head.size(); at + size <= npy.size(); at += size)
  {
    const std::uint64_t bits = ArchiveNumber(npy, at, size);
    float               single = 0.0F;
    const auto          singleBits = static_cast<std::uint32_t>(bits);
    std::memcpy(&single, &singleBits, sizeof single);
    values.push_back(isFloat ? static_cast<double>(single) : RealOfBits(bits));
  }
  return values;
}

/** Returns the bytes of a member, whose central header is at \a at. */
std::string
ContentOfMember(const std::string & bytes, std::size_t at, const std::string & name)
{
  const auto        size = static_cast<std::size_t>(ArchiveNumber(bytes, at + 24, 4));
  const auto        local = static_cast<std::size_t>(ArchiveNumber(bytes, at + 42, 4));
  const std::size_t begin =
    local + localHeadBytes + ArchiveNumber(bytes, local + 26, 2) + ArchiveNumber(bytes, local + 28, 2);
  if (ArchiveNumber(bytes, at + 10, 2) != 0)
  {
    RefuseMember(name, "is compressed");
  }
  if (size > mostMemberBytes)
  {
    RefuseMember(name, "has " + std::to_string(size) + " bytes");
  }
  std::string  content = ArchiveText(bytes, begin, size);
  const auto * data = reinterpret_cast<const Bytef *>(content.data());
  if (crc32(crc32(0, nullptr, 0), data, static_cast<uInt>(content.size())) != ArchiveNumber(bytes, at + 16, 4))
  {
    RefuseMember(name, "is damaged: its checksum differs");
  }
  return content;
}
} // namespace

std::map<std::string, std::vector<double>>
ReadNpz(const std::string & bytes)
{
  const std::size_t end = bytes.rfind("PK\x05\x06");
  if (end == std::string::npos || bytes.size() - end < endRecordBytes)
  {
    throw ExportError("the NumPy archive has no directory at its end; expected a whole file");
  }
  std::map<std::string, std::vector<double>> arrays;
  auto                                       at = static_cast<std::size_t>(ArchiveNumber(bytes, end + 16, 4));
  const auto                                 members = ArchiveNumber(bytes, end + 10, 2);
  if (members > mostMembers)
  {
    throw ExportError("the NumPy archive has " + std::to_string(members) +
                      " arrays; expected the archive of one noise model, at most " + std::to_string(mostMembers));
  }
  for (std::uint64_t member = 0; member < members; ++member)
  {
    if (ArchiveText(bytes, at, 4) != "PK\x01\x02")
    {
      throw ExportError("the directory of the NumPy archive has no entry at byte " + std::to_string(at) +
                        "; expected a whole file");
    }
    const auto        nameBytes = static_cast<std::size_t>(ArchiveNumber(bytes, at + 28, 2));
    const std::string name = ArchiveText(bytes, at + centralHeadBytes, nameBytes);
    arrays[name.substr(0, name.rfind(".npy"))] = ValuesOfNpy(name, ContentOfMember(bytes, at, name));
    at += centralHeadBytes + nameBytes + ArchiveNumber(bytes, at + 30, 2) + ArchiveNumber(bytes, at + 32, 2);
  }
  return arrays;
}

} // namespace sensornoise
