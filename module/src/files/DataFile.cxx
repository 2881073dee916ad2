// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "files/DataFile.h"

#include "files/FileBytes.h"
#include "files/FileIdentity.h"
#include "files/FrameReader.h"
#include "files/InflatedFrames.h"
#include "files/PackedFrames.h"
#include "files/StoredNumber.h"

#include <cstddef>
#include <filesystem>
#include <memory>
#include <utility>

namespace sensornoise
{
std::string
InDataFile(const std::string & file, const DataPlace & place)
{
  return file == place.path ? "" : " in its data file " + place.path;
}

void
RequireNothingLeft(const std::string & file, const DataPlace & place, std::uint64_t left)
{
  if (left > 0)
  {
    throw FileError(file,
                    std::to_string(left) + " bytes" + InDataFile(file, place) +
                      " are left over after its pixels; expected none");
  }
}

std::string
PathOfDataFile(const std::string & file, const std::string & name)
{
  return (std::filesystem::path(file).parent_path() / name).string();
}

void
AddDataFile(const std::string & file, const std::string & path, std::vector<FileIdentity> & identities)
{
  const FileIdentity identity = IdentityOfDataFile(file, path);
  if (AreSameFile(identity, identities.front()))
  {
    throw FileError(file, "its data file " + path + " is the file itself; expected another one");
  }
  for (const FileIdentity & other : identities)
  {
    if (AreSameFile(identity, other))
    {
      throw FileError(file, "its data file " + path + " comes twice in its list; expected each once");
    }
  }
  identities.push_back(identity);
}

std::uint64_t
RequireExactly(const std::string & file, const DataPlace & place, std::uint64_t expected, std::uint64_t frameBytes)
{
  const std::uint64_t size = FileBytes(file, place.path).Size();
  const std::uint64_t found = size > place.offset ? size - place.offset : 0;
  if (found < expected)
  {
    throw FileError(file,
                    "truncated: " + std::to_string(found) + " bytes of pixels" + InDataFile(file, place) +
                      ", expected " + std::to_string(expected));
  }
  if (!place.fromEnd)
  {
    RequireNothingLeft(file, place, found - expected);
    return place.offset;
  }
  if (found - expected >= frameBytes)
  {
    throw FileError(file,
                    std::to_string(found - expected) + " bytes" + InDataFile(file, place) +
                      " before its pixels, enough for another frame; expected the number of bytes to skip, not -1");
  }
  return size - expected;
}

namespace
{
/** Frames of several files, the same number in each. */
class JoinedFrames : public FrameReader
{
public:
  explicit JoinedFrames(std::vector<std::unique_ptr<const FrameReader>> parts)
    : m_Parts(std::move(parts))
  {}

  void
  Read(const FrameFile & file, std::size_t first, std::size_t count, void * buffer) const override
  {
    const std::size_t frameBytes = file.width * file.height * SizeOf(file.pixel);
    for (std::size_t i = 0; i < count; ++i)
    {
      m_Parts.at(first + i)->Read(file, 0, 1, static_cast<char *>(buffer) + i * frameBytes);
    }
  }

private:
  std::vector<std::unique_ptr<const FrameReader>> m_Parts;
};

/** Checks the \a bytes of pixels at a place, and makes the reader of them. */
std::unique_ptr<const FrameReader>
ReaderOfPlace(const FrameFile & file, const DataPlace & place, const DataCoding & coding, std::uint64_t bytes)
{
  if (coding.compression)
  {
    const CompressedPlace from{ place, *coding.compression, coding.compressedBytes, bytes };
    RequireInflates(file.name, from);
    return std::make_unique<InflatedFrames>(from, coding.sample);
  }
  FramePlaces places;
  places.path = place.path;
  places.frameBytes = StoredBytesOf(file) / file.frames;
  places.offset = RequireExactly(file.name, place, bytes, places.frameBytes);
  places.sample = coding.sample;
  return std::make_unique<PackedFrames>(places);
}
} // namespace

void
SetDataFrames(FrameFile &                    file,
              const std::vector<DataPlace> & places,
              const DataCoding &             coding,
              const BeforeInflating &        beforeInflating)
{
  if (coding.compression && beforeInflating)
  {
    beforeInflating(file);
  }
  const std::uint64_t                             bytes = StoredBytesOf(file) / places.size();
  std::vector<std::unique_ptr<const FrameReader>> readers;
  for (const DataPlace & place : places)
  {
    if (!place.attached)
    {
      AddDataFile(file.name, place.path, file.identities);
    }
    readers.push_back(ReaderOfPlace(file, place, coding, bytes));
  }
  if (readers.size() == 1)
  {
    file.reader = std::move(readers.front());
  }
  else
  {
    file.reader = std::make_shared<JoinedFrames>(std::move(readers));
  }
}

} // namespace sensornoise
