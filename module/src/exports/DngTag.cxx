// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "files/ByteOrder.h"
#include "sensornoise/NoiseExport.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>
#include <vector>

// TIFF 6.0, section 2, and DNG 1.7, tag NoiseProfile. The new directory and the new values stand at the end of the
// file: no byte that another tag points to moves.
namespace sensornoise
{
namespace
{
constexpr std::size_t   headBytes = 8;
constexpr std::size_t   entryBytes = 12;
constexpr std::uint64_t noiseProfileTag = 51041;
constexpr std::uint64_t doubleType = 12;

std::uint64_t
NumberAt(const std::string & file, std::size_t offset, std::size_t bytes, bool isBigEndian)
{
  if (offset > file.size() || file.size() - offset < bytes)
  {
    throw ExportError("the TIFF file ends at byte " + std::to_string(file.size()) +
                      ", before the end of its first directory; expected a whole file");
  }
  return NumberInBytes(reinterpret_cast<const unsigned char *>(file.data()) + offset, bytes, isBigEndian);
}

bool
IsBigEndianTiff(const std::string & file)
{
  const std::string head = file.substr(0, 4);
  if (head == std::string("MM\0*", 4))
  {
    return true;
  }
  if (head != std::string("II*\0", 4))
  {
    throw ExportError("the file is no classic TIFF; expected a DNG file, which begins with II*\\0 or MM\\0*");
  }
  return false;
}
} // namespace

std::string
WithNoiseProfile(const std::string & file, const std::vector<std::pair<double, double>> & profile)
{
  const bool isBigEndian = IsBigEndianTiff(file);
  const auto directory = static_cast<std::size_t>(NumberAt(file, 4, 4, isBigEndian));
  const auto count = static_cast<std::size_t>(NumberAt(file, directory, 2, isBigEndian));
  const auto bytesOf = [&](std::uint64_t number, std::size_t bytes) {
    return BytesOfNumber(number, bytes, isBigEndian);
  };
  const auto  next = NumberAt(file, directory + 2 + count * entryBytes, 4, isBigEndian);
  std::string copy = file + std::string(file.size() % 2, '\0'); // values begin at even offsets

  const std::string entry =
    bytesOf(noiseProfileTag, 2) + bytesOf(doubleType, 2) + bytesOf(2 * profile.size(), 4) + bytesOf(copy.size(), 4);
  for (const auto & [scale, offset] : profile)
  {
    copy += BytesOfReal(scale, isBigEndian) + BytesOfReal(offset, isBigEndian);
  }
  std::vector<std::pair<std::uint64_t, std::string>> entries{ { noiseProfileTag, entry } };
  for (std::size_t i = 0; i < count; ++i)
  {
    const std::size_t at = directory + 2 + i * entryBytes;
    const auto        tag = NumberAt(file, at, 2, isBigEndian);
    if (tag != noiseProfileTag)
    {
      entries.emplace_back(tag, file.substr(at, entryBytes));
    }
  }
  std::stable_sort(entries.begin(), entries.end(), [](const auto & a, const auto & b) { return a.first < b.first; });

  const std::size_t begin = copy.size();
  copy += bytesOf(entries.size(), 2);
  for (const auto & [tag, bytes] : entries)
  {
    copy += bytes;
  }
  copy += bytesOf(next, 4);
  if (copy.size() > std::numeric_limits<std::uint32_t>::max() ||
      entries.size() > std::numeric_limits<std::uint16_t>::max())
  {
    throw ExportError("the file has " + std::to_string(file.size()) + " bytes and " + std::to_string(count) +
                      " tags; a TIFF file has at most 4 GiB and 65535 tags");
  }
  copy.replace(4, headBytes - 4, bytesOf(begin, 4));
  return copy;
}

} // namespace sensornoise
