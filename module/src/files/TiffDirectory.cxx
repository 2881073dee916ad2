// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "files/TiffDirectory.h"

#include "sensornoise/FrameFile.h"
#include "files/FileBytes.h"

#include <algorithm>
#include <array>

namespace sensornoise
{
namespace
{
// libtiff reads at most this number of entries
constexpr std::uint64_t MaximumEntries = 4096;

bool
IsWholeNumberType(unsigned type)
{
  // BYTE, SHORT, LONG, LONG8
  return type == 1 || type == 3 || type == 4 || type == 16;
}
} // namespace

const TiffEntry *
TiffDirectory::Find(unsigned tag) const
{
  const auto found =
    std::find_if(entries.begin(), entries.end(), [tag](const TiffEntry & entry) { return entry.tag == tag; });
  return found == entries.end() ? nullptr : &*found;
}

std::size_t
SizeOfTiffType(unsigned type)
{
  static constexpr std::array<std::size_t, 19> sizes{ 0, 1, 1, 2, 4, 8, 1, 1, 2, 4, 8, 4, 8, 4, 0, 0, 8, 8, 8 };
  return type < sizes.size() ? sizes[type] : 0;
}

bool
TiffBytes::IsTiff(const unsigned char * head, std::size_t count)
{
  if (count < 4)
  {
    return false;
  }
  const bool isBigEndian = head[0] == 'M' && head[1] == 'M';
  const auto version = NumberInBytes(head + 2, 2, isBigEndian);
  return (isBigEndian || (head[0] == 'I' && head[1] == 'I')) && (version == 42 || version == 43);
}

TiffBytes::TiffBytes(const std::string & file, FileBytes & bytes)
  : m_Bytes(bytes)
{
  std::array<unsigned char, 16> head{};
  bytes.Read(0, head.data(), 8);
  m_IsBigEndian = head[0] == 'M';
  m_IsBig = At(head.data() + 2, 2) == 43;
  m_First = At(head.data() + 4, 4);
  if (m_IsBig)
  {
    bytes.Read(0, head.data(), head.size());
    if (At(head.data() + 4, 2) != 8 || At(head.data() + 6, 2) != 0)
    {
      throw FileError(
        file, "damaged: a BigTIFF whose offsets have " + std::to_string(At(head.data() + 4, 2)) + " bytes; expected 8");
    }
    m_First = At(head.data() + 8, 8);
  }
}

std::uint64_t
TiffBytes::At(const unsigned char * bytes, std::size_t width) const
{
  return NumberInBytes(bytes, width, m_IsBigEndian);
}

void
TiffBytes::CheckEntry(const std::string & page, const TiffEntry & entry) const
{
  const std::string   name = "its tag " + std::to_string(entry.tag);
  const std::uint64_t size = SizeOfTiffType(entry.type);
  if (size == 0)
  {
    throw FileError(page,
                    "damaged: " + name + " is of type " + std::to_string(entry.type) + ", which TIFF does not have");
  }
  if (!entry.inside && (entry.count > m_Bytes.Size() / size || !m_Bytes.Holds(entry.offset, entry.count * size)))
  {
    throw FileError(page,
                    "damaged or truncated: " + name + " has " + std::to_string(entry.count) + " values of " +
                      std::to_string(size) + " bytes from byte " + std::to_string(entry.offset) +
                      " on, but the file has " + std::to_string(m_Bytes.Size()) + " bytes");
  }
}

TiffDirectory
TiffBytes::ReadDirectory(const std::string & page, std::uint64_t offset)
{
  const std::size_t             countWidth = m_IsBig ? 8 : 2;
  const std::size_t             offsetWidth = m_IsBig ? 8 : 4;
  const std::size_t             entryWidth = m_IsBig ? 20 : 12;
  std::array<unsigned char, 20> buffer{};
  if (!m_Bytes.Holds(offset, countWidth))
  {
    throw FileError(page,
                    "truncated: its directory is at byte " + std::to_string(offset) + ", but the file has " +
                      std::to_string(m_Bytes.Size()) + " bytes");
  }
  m_Bytes.Read(offset, buffer.data(), countWidth);
  const std::uint64_t count = At(buffer.data(), countWidth);
  if (count == 0 || count > MaximumEntries)
  {
    throw FileError(page,
                    "damaged: its directory at byte " + std::to_string(offset) + " has " + std::to_string(count) +
                      " entries; expected 1 to " + std::to_string(MaximumEntries));
  }
  TiffDirectory directory;
  directory.offset = offset;
  directory.bytes = countWidth + count * entryWidth + offsetWidth;
  if (!m_Bytes.Holds(offset, directory.bytes))
  {
    throw FileError(page,
                    "truncated: its directory at byte " + std::to_string(offset) + " has " + std::to_string(count) +
                      " entries and does not end in the file of " + std::to_string(m_Bytes.Size()) + " bytes");
  }
  for (std::uint64_t i = 0; i < count; ++i)
  {
    const std::uint64_t at = offset + countWidth + i * entryWidth;
    m_Bytes.Read(at, buffer.data(), entryWidth);
    TiffEntry entry;
    entry.tag = static_cast<unsigned>(At(buffer.data(), 2));
    entry.type = static_cast<unsigned>(At(buffer.data() + 2, 2));
    entry.count = At(buffer.data() + 4, offsetWidth);
    entry.inside = entry.count <= offsetWidth && entry.count * SizeOfTiffType(entry.type) <= offsetWidth;
    entry.offset = entry.inside ? at + 4 + offsetWidth : At(buffer.data() + 4 + offsetWidth, offsetWidth);
    CheckEntry(page, entry);
    directory.entries.push_back(entry);
  }
  m_Bytes.Read(offset + directory.bytes - offsetWidth, buffer.data(), offsetWidth);
  directory.next = At(buffer.data(), offsetWidth);
  return directory;
}

std::optional<std::uint64_t>
TiffBytes::Number(const std::string & page, const TiffDirectory & directory, unsigned tag, const char * name)
{
  const TiffEntry * const entry = directory.Find(tag);
  if (entry == nullptr)
  {
    return std::nullopt;
  }
  if (entry->count != 1 || !IsWholeNumberType(entry->type))
  {
    throw FileError(page,
                    "damaged: its tag " + std::to_string(tag) + " (" + name + ") has " + std::to_string(entry->count) +
                      " values of type " + std::to_string(entry->type) + "; expected one whole number");
  }
  return Numbers(*this, *entry).Next();
}

double
TiffBytes::Quotient(const TiffDirectory & directory, unsigned tag)
{
  const TiffEntry * const entry = directory.Find(tag);
  if (entry == nullptr || entry->count != 1 || entry->type != 5)
  {
    return 0.0;
  }
  std::array<unsigned char, 8> bytes{};
  m_Bytes.Read(entry->offset, bytes.data(), bytes.size());
  const auto above = static_cast<double>(At(bytes.data(), 4));
  const auto below = static_cast<double>(At(bytes.data() + 4, 4));
  return below == 0.0 ? 0.0 : above / below;
}

bool
TiffBytes::HasEntry(std::uint64_t begin, std::uint64_t end, unsigned tag, std::uint64_t value)
{
  const auto text = [this](std::uint64_t number, std::size_t width) {
    std::string bytes;
    for (std::size_t i = 0; i < width; ++i)
    {
      bytes += static_cast<char>((number >> (8 * (m_IsBigEndian ? width - 1 - i : i))) & 255);
    }
    return bytes;
  };
  const std::size_t offsetWidth = m_IsBig ? 8 : 4;
  const auto        entry = [&](unsigned type) {
    return text(tag, 2) + text(type, 2) + text(1, offsetWidth) + text(value, SizeOfTiffType(type));
  };
  const std::string asShort = entry(3);
  const std::string asLong = entry(4);
  std::string       held;
  std::string       piece(65536, '\0');
  while (begin < end)
  {
    const std::size_t count = static_cast<std::size_t>(std::min<std::uint64_t>(end - begin, piece.size()));
    m_Bytes.Read(begin, piece.data(), count);
    begin += count;
    held.append(piece, 0, count);
    if (held.find(asLong) != std::string::npos || (value < 65536 && held.find(asShort) != std::string::npos))
    {
      return true;
    }
    held.erase(0, held.size() - std::min(held.size(), asLong.size()));
  }
  return false;
}

TiffBytes::Numbers::Numbers(TiffBytes & tiff, const TiffEntry & entry)
  : m_Reader(tiff.m_Bytes, entry.offset, entry.offset + entry.count * SizeOfTiffType(entry.type))
  , m_Width(SizeOfTiffType(entry.type))
  , m_IsBigEndian(tiff.m_IsBigEndian)
{}

std::uint64_t
TiffBytes::Numbers::Next()
{
  std::array<unsigned char, 8> bytes{};
  for (std::size_t i = 0; i < m_Width; ++i)
  {
    bytes[i] = static_cast<unsigned char>(m_Reader.Next());
  }
  return NumberInBytes(bytes.data(), m_Width, m_IsBigEndian);
}

std::uint64_t
TiffTags::Number(unsigned tag, const char * name, std::uint64_t otherwise) const
{
  return m_Tiff.Number(m_Page, m_Directory, tag, name).value_or(otherwise);
}

std::uint64_t
TiffTags::Required(unsigned tag, const char * name) const
{
  const std::optional<std::uint64_t> number = m_Tiff.Number(m_Page, m_Directory, tag, name);
  if (!number)
  {
    Refuse("damaged: has no tag " + std::to_string(tag) + " (" + name + "); expected one");
  }
  return *number;
}

TiffEntry
TiffTags::EntryOfEach(unsigned tag, const char * name, std::uint64_t count, const char * piece) const
{
  const TiffEntry * const entry = m_Directory.Find(tag);
  const bool              isNumbers = entry != nullptr && (entry->type == 3 || entry->type == 4 || entry->type == 16);
  if (!isNumbers || entry->count != count)
  {
    Refuse("damaged: its tag " + std::to_string(tag) + " (" + name + ") has " +
           std::to_string(entry == nullptr ? 0 : entry->count) + " values" +
           (entry == nullptr || isNumbers ? "" : " of type " + std::to_string(entry->type)) + "; expected " +
           std::to_string(count) + ", one for each " + piece);
  }
  return *entry;
}

void
TiffTags::RequireEachOnce() const
{
  std::vector<unsigned> numbers;
  for (const TiffEntry & entry : m_Directory.entries)
  {
    numbers.push_back(entry.tag);
  }
  std::sort(numbers.begin(), numbers.end());
  const auto twice = std::adjacent_find(numbers.begin(), numbers.end());
  if (twice != numbers.end())
  {
    Refuse("damaged: its tag " + std::to_string(*twice) + " comes twice; expected each once");
  }
}

void
TiffTags::Refuse(const std::string & what) const
{
  throw FileError(m_Page, what);
}

} // namespace sensornoise
