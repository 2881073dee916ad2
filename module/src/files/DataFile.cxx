// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "files/DataFile.h"

#include "files/FileBytes.h"
#include "sensornoise/FrameFile.h"
#include "files/FileIdentity.h"
#include "files/Inflate.h"

#include <algorithm>

namespace sensornoise
{
namespace
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
} // namespace

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

void
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
  }
  else if (found - expected >= frameBytes)
  {
    throw FileError(file,
                    std::to_string(found - expected) + " bytes" + InDataFile(file, place) +
                      " before its pixels, enough for another frame; expected the number of bytes to skip, not -1");
  }
}

void
RequireInflates(const std::string & file,
                const DataPlace &   place,
                std::uint64_t       compressed,
                std::uint64_t       expected,
                bool                orZlib)
{
  FileBytes           bytes(file, place.path);
  const std::uint64_t found = bytes.Size() - std::min(bytes.Size(), place.offset);
  if (found < compressed)
  {
    throw FileError(file,
                    "truncated: " + std::to_string(found) + " bytes of compressed pixels" + InDataFile(file, place) +
                      ", expected " + std::to_string(compressed));
  }
  Inflater inflater(orZlib ? InflateContainer::ZlibOrGzip : InflateContainer::Gzip, expected);
  InflateFrom(bytes, place.offset, compressed == 0 ? found : compressed, inflater);
  if (!inflater.IsWhole())
  {
    throw FileError(file,
                    "damaged: its compressed pixels" + InDataFile(file, place) + " give " + inflater.ReceivedBytes() +
                      ", expected " + std::to_string(expected) + " bytes and the end of the stream");
  }
  RequireNothingLeft(file, place, found - inflater.UsedBytes());
}

} // namespace sensornoise
