// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "exports/ExportFormats.h"

#include "files/FileBytes.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace sensornoise
{
namespace
{
// TIFF 6.0, section 2, TIFF Technical Note 1 (SubIFDs), and DNG 1.7, tag NoiseProfile. New directories and values stand
// at the end of the file: no byte that another tag points to moves.

using NoisePairs = std::vector<std::pair<double, double>>;

constexpr std::size_t   entryBytes = 12;
constexpr std::size_t   pointerBytes = 4;
constexpr std::size_t   firstPointer = 4; // place of the offset of the first directory
constexpr std::size_t   mostSubIfds = 256;
constexpr std::uint64_t subfileTypeTag = 254;
constexpr std::uint64_t subIfdsTag = 330;
constexpr std::uint64_t noiseProfileTag = 51041;
constexpr std::uint64_t shortType = 3;
constexpr std::uint64_t doubleType = 12;

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
  /** Throws ExportError unless \a file, which must outlive it, begins as a classic TIFF file. */
  explicit TagFile(const std::string & file)
    : m_File(file)
    , m_IsBigEndian(file.compare(0, firstPointer, std::string("MM\0*", firstPointer)) == 0)
  {
    if (!m_IsBigEndian && file.compare(0, firstPointer, std::string("II*\0", firstPointer)) != 0)
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
    const auto   at = static_cast<std::size_t>(this->NumberAt(pointer, pointerBytes, name));
    const auto   count = static_cast<std::size_t>(this->NumberAt(at, 2, name));
    TagDirectory directory;
    directory.next = this->NumberAt(at + 2 + count * entryBytes, pointerBytes, name);
    for (std::size_t place = at + 2; directory.entries.size() < count; place += entryBytes)
    {
      directory.entries.push_back({ this->NumberAt(place, 2, name),
                                    this->NumberAt(place + 2, 2, name),
                                    this->NumberAt(place + 4, 4, name),
                                    place + 8,
                                    m_File.substr(place, entryBytes) });
    }
    return directory;
  }

  /** Returns the kind of image of a directory, NewSubfileType: 0 is the main image, bit 0 a preview. */
  std::uint64_t
  SubfileTypeOf(const TagDirectory & directory) const
  {
    const TagEntry * const found = directory.Find(subfileTypeTag);
    return found == nullptr ? 0 : this->NumberAt(found->valuePlace, found->type == shortType ? 2 : 4, "first");
  }

  /** Returns the place of the offset of the raw directory, which is the main image in the SubIFDs of a preview; none if
   * the first directory has the main image itself, or there is none. */
  std::optional<std::size_t>
  FindRawPointer(const TagDirectory & first) const
  {
    const TagEntry * const subIfds = first.Find(subIfdsTag);
    if (subIfds == nullptr || (this->SubfileTypeOf(first) & 1U) == 0)
    {
      return std::nullopt;
    }
    const auto count = static_cast<std::size_t>(std::min<std::uint64_t>(subIfds->count, mostSubIfds));
    const auto place = count == 1
                         ? subIfds->valuePlace
                         : static_cast<std::size_t>(this->NumberAt(subIfds->valuePlace, pointerBytes, "first"));
    for (std::size_t i = 0; i < count; ++i)
    {
      const std::size_t pointer = place + i * pointerBytes;
      if (this->SubfileTypeOf(this->ReadDirectory(pointer, "raw")) == 0)
      {
        return pointer;
      }
    }
    return std::nullopt;
  }

private:
  const std::string & m_File;
  bool                m_IsBigEndian;
};

/** Appends a directory with the tag NoiseProfile to a file, and sets its offset, which is at \a pointer. A tag that is
 * there is replaced. \a values: place of the pairs in the file. */
void
AppendDirectory(std::string & file, TagDirectory directory, std::size_t pointer, std::size_t values, std::size_t pairs)
{
  const bool isBigEndian = TagFile(file).IsBigEndian();
  const auto bytesOf = [isBigEndian](std::uint64_t number, std::size_t bytes) {
    return BytesOfNumber(number, bytes, isBigEndian);
  };
  auto & entries = directory.entries;
  entries.erase(
    std::remove_if(entries.begin(), entries.end(), [](const TagEntry & each) { return each.tag == noiseProfileTag; }),
    entries.end());
  const std::string bytes =
    bytesOf(noiseProfileTag, 2) + bytesOf(doubleType, 2) + bytesOf(2 * pairs, 4) + bytesOf(values, pointerBytes);
  entries.push_back({ noiseProfileTag, doubleType, 2 * pairs, 0, bytes });
  std::stable_sort(entries.begin(), entries.end(), [](const auto & a, const auto & b) { return a.tag < b.tag; });
  const std::size_t begin = file.size();
  file += bytesOf(entries.size(), 2);
  for (const TagEntry & entry : entries)
  {
    file += entry.bytes;
  }
  file += bytesOf(directory.next, pointerBytes);
  if (file.size() > std::numeric_limits<std::uint32_t>::max() ||
      entries.size() > std::numeric_limits<std::uint16_t>::max())
  {
    throw ExportError("the file has " + std::to_string(begin) + " bytes and " + std::to_string(entries.size()) +
                      " tags; a TIFF file has at most 4 GiB and 65535 tags");
  }
  file.replace(pointer, pointerBytes, bytesOf(begin, pointerBytes));
}

/** Returns the pairs of a tag NoiseProfile. */
NoisePairs
PairsOf(const TagFile & tiff, const TagEntry & entry, const char * directory)
{
  constexpr std::size_t numberBytes = sizeof(double);
  constexpr std::size_t mostPlanes = 4;
  if (entry.type != doubleType || entry.count < 2 || entry.count % 2 != 0 || entry.count > 2 * mostPlanes)
  {
    throw ExportError("the tag NoiseProfile has " + std::to_string(entry.count) + " numbers of TIFF's type " +
                      std::to_string(entry.type) + "; expected pairs of DOUBLE (12), at most " +
                      std::to_string(mostPlanes));
  }
  const auto values = static_cast<std::size_t>(tiff.NumberAt(entry.valuePlace, pointerBytes, directory));
  const auto number = [&](std::size_t i) {
    return RealOfBits(tiff.NumberAt(values + i * numberBytes, numberBytes, directory));
  };
  NoisePairs profile;
  for (std::size_t i = 0; i < entry.count; i += 2)
  {
    profile.emplace_back(number(i), number(i + 1));
  }
  return profile;
}
} // namespace

std::string
WithNoiseProfile(const std::string & file, const NoisePairs & profile)
{
  const TagFile     tiff(file);
  const auto        raw = tiff.FindRawPointer(tiff.ReadDirectory(firstPointer, "first"));
  std::string       copy = file + std::string(file.size() % 2, '\0'); // values begin at even offsets
  const std::size_t values = copy.size();
  for (const auto & [scale, offset] : profile)
  {
    copy += BytesOfReal(scale, tiff.IsBigEndian()) + BytesOfReal(offset, tiff.IsBigEndian());
  }
  if (raw)
  {
    AppendDirectory(copy, tiff.ReadDirectory(*raw, "raw"), *raw, values, profile.size());
  }
  // Read from the copy: the offset of the raw directory may stand in its entry.
  AppendDirectory(copy, TagFile(copy).ReadDirectory(firstPointer, "first"), firstPointer, values, profile.size());
  return copy;
}

NoisePairs
NoiseProfileIn(const std::string & file)
{
  const TagFile      tiff(file);
  const TagDirectory first = tiff.ReadDirectory(firstPointer, "first");
  if (const TagEntry * const found = first.Find(noiseProfileTag))
  {
    return PairsOf(tiff, *found, "first");
  }
  if (const auto pointer = tiff.FindRawPointer(first))
  {
    const TagDirectory raw = tiff.ReadDirectory(*pointer, "raw");
    if (const TagEntry * const found = raw.Find(noiseProfileTag))
    {
      return PairsOf(tiff, *found, "raw");
    }
  }
  throw ExportError("the file has no tag NoiseProfile (51041) in its first directory, nor in its raw directory "
                    "(SubIFDs), where DNG files have it");
}

} // namespace sensornoise
