// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_exports_DngDirectory_h
#define sensornoise_exports_DngDirectory_h

#include "files/FileBytes.h"
#include "sensornoise/NoiseExport.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

/** \file
 * The directories of a DNG file: TIFF 6.0, section 2, and TIFF Technical Note 1 (SubIFDs). */

namespace sensornoise
{

/** A tag of a directory. */
struct TagEntry
{
  std::uint64_t tag{ 0 };
  std::uint64_t type{ 0 };
  std::uint64_t count{ 0 };
  std::size_t   valuePlace{ 0 }; ///< place of its value, or of the offset of its values, in the file
  std::string   bytes;           ///< the whole entry
};

/** A directory of tags. */
struct TagDirectory
{
  std::vector<TagEntry> entries;
  std::uint64_t         next{ 0 }; ///< offset of the next directory

  const TagEntry *
  Find(std::uint64_t tag) const
  {
    const auto found =
      std::find_if(entries.begin(), entries.end(), [tag](const auto & each) { return each.tag == tag; });
    return found == entries.end() ? nullptr : &*found;
  }
};

/** \class TagFile
 * \brief Reads numbers and directories of a classic TIFF file. Each throws ExportError if the file ends before. */
class TagFile
{
public:
  static constexpr std::size_t   EntryBytes = 12;
  static constexpr std::size_t   PointerBytes = 4;
  static constexpr std::size_t   FirstPointer = 4; // place of the offset of the first directory
  static constexpr std::uint64_t ShortType = 3;

  /** Throws ExportError unless \a file, which must outlive it, begins as a classic TIFF file. */
  explicit TagFile(const std::string & file)
    : m_File(file)
    , m_IsBigEndian(file.compare(0, FirstPointer, std::string("MM\0*", FirstPointer)) == 0)
  {
    if (!m_IsBigEndian && file.compare(0, FirstPointer, std::string("II*\0", FirstPointer)) != 0)
    {
      throw ExportError("the file is no classic TIFF; expected a DNG file, which begins with II*\\0 or MM\\0*");
    }
  }

  bool
  IsBigEndian() const
  {
    return m_IsBigEndian;
  }

  std::uint64_t
  NumberAt(std::size_t offset, std::size_t bytes, const char * directory) const
  {
    if (offset > m_File.size() || m_File.size() - offset < bytes)
    {
      throw ExportError("the TIFF file ends at byte " + std::to_string(m_File.size()) + ", before the end of its " +
                        directory + " directory; expected a whole file");
    }
    return NumberInBytes(reinterpret_cast<const unsigned char *>(m_File.data()) + offset, bytes, m_IsBigEndian);
  }

  /** Reads the directory whose offset is at \a pointer. */
  TagDirectory
  ReadDirectory(std::size_t pointer, const char * name) const
  {
    const auto   at = static_cast<std::size_t>(this->NumberAt(pointer, PointerBytes, name));
    const auto   count = static_cast<std::size_t>(this->NumberAt(at, 2, name));
    TagDirectory directory;
    directory.next = this->NumberAt(at + 2 + count * EntryBytes, PointerBytes, name);
    for (std::size_t place = at + 2; directory.entries.size() < count; place += EntryBytes)
    {
      directory.entries.push_back({ this->NumberAt(place, 2, name),
                                    this->NumberAt(place + 2, 2, name),
                                    this->NumberAt(place + 4, 4, name),
                                    place + 8,
                                    m_File.substr(place, EntryBytes) });
    }
    return directory;
  }

  /** Returns the kind of image of a directory, NewSubfileType: 0 is the main image, bit 0 a preview. */
  std::uint64_t
  SubfileTypeOf(const TagDirectory & directory) const
  {
    const TagEntry * const found = directory.Find(SubfileTypeTag);
    return found == nullptr ? 0 : this->NumberAt(found->valuePlace, found->type == ShortType ? 2 : 4, "first");
  }

  /** Returns the place of the offset of the raw directory, which is the main image in the SubIFDs of a preview; none if
   * the first directory has the main image itself, or there is none. */
  std::optional<std::size_t>
  FindRawPointer(const TagDirectory & first) const
  {
    const TagEntry * const subIfds = first.Find(SubIfdsTag);
    if (subIfds == nullptr || (this->SubfileTypeOf(first) & 1U) == 0)
    {
      return std::nullopt;
    }
    const auto count = static_cast<std::size_t>(std::min<std::uint64_t>(subIfds->count, MostSubIfds));
    const auto place = count == 1
                         ? subIfds->valuePlace
                         : static_cast<std::size_t>(this->NumberAt(subIfds->valuePlace, PointerBytes, "first"));
    for (std::size_t i = 0; i < count; ++i)
    {
      const std::size_t pointer = place + i * PointerBytes;
      if (this->SubfileTypeOf(this->ReadDirectory(pointer, "raw")) == 0)
      {
        return pointer;
      }
    }
    return std::nullopt;
  }

private:
  static constexpr std::size_t   MostSubIfds = 256;
  static constexpr std::uint64_t SubfileTypeTag = 254;
  static constexpr std::uint64_t SubIfdsTag = 330;

  const std::string & m_File;
  bool                m_IsBigEndian;
};

} // namespace sensornoise

#endif
