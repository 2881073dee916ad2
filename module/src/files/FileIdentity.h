// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_files_FileIdentity_h
#define sensornoise_files_FileIdentity_h

#include "SensorNoiseExport.h"

#include <cstdint>
#include <string>

namespace sensornoise
{

/** Which file a name stands for, and in which state: while it stays equal, nobody has replaced the file or written to
 * it (to the resolution of the file system's clock). */
struct FileIdentity
{
  std::string   name{};
  std::uint64_t device{ 0 };
  std::uint64_t inode{ 0 };
  std::uint64_t size{ 0 };         // [bytes]
  std::int64_t  modified{ 0 };     // the contents [ns since the file system's epoch]
  std::int64_t  statusChange{ 0 }; // contents or rights; unlike `modified` it cannot be set back [ns]
};

SensorNoise_EXPORT bool
operator==(const FileIdentity & a, const FileIdentity & b);

inline bool
operator!=(const FileIdentity & a, const FileIdentity & b)
{
  return !(a == b);
}

/** Whether both are the same file, in whichever state, by whichever names. */
SensorNoise_EXPORT bool
AreSameFile(const FileIdentity & a, const FileIdentity & b);

/** The identity of the regular file that \a name, or the link of that name, stands for. It is not opened: pipes and
 * devices cannot make this wait. Throws FileError where there is no file, or no regular one. */
SensorNoise_EXPORT FileIdentity
IdentityOf(const std::string & name);

/** The same of a file whose name stands in another one, \a file, with which the errors then begin. */
SensorNoise_EXPORT FileIdentity
IdentityOfDataFile(const std::string & file, const std::string & dataFile);

} // namespace sensornoise

#endif
