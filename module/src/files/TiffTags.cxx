// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "files/TiffTags.h"

#include "sensornoise/FrameFile.h"

#include <algorithm>
#include <optional>
#include <vector>

namespace sensornoise
{

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
TiffTags::OfStrips(unsigned tag, const char * name, std::uint64_t strips) const
{
  const TiffEntry * const entry = m_Directory.Find(tag);
  const bool              isNumbers = entry != nullptr && (entry->type == 3 || entry->type == 4 || entry->type == 16);
  if (!isNumbers || entry->count != strips)
  {
    Refuse("damaged: its tag " + std::to_string(tag) + " (" + name + ") has " +
           std::to_string(entry == nullptr ? 0 : entry->count) + " values" +
           (entry == nullptr || isNumbers ? "" : " of type " + std::to_string(entry->type)) + "; expected " +
           std::to_string(strips) + ", one for each strip");
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
