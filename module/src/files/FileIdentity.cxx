// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "files/FileIdentity.h"

#include "sensornoise/FrameFile.h"

#include <chrono>
#include <filesystem>
#include <system_error>
#if defined(__unix__) || defined(__APPLE__)
#  include <sys/stat.h>
#endif

namespace sensornoise
{
namespace
{
namespace fs = std::filesystem;

void
RequireRegularFile(const std::string & name)
{
  std::error_code       error;
  const fs::file_status status = fs::status(name, error);
  switch (status.type())
  {
    case fs::file_type::regular:
      return;
    case fs::file_type::not_found:
      throw FileError(name, "does not exist; expected an image file");
    case fs::file_type::directory:
      throw FileError(name, "is a folder; expected an image file");
    case fs::file_type::fifo:
    case fs::file_type::socket:
    case fs::file_type::block:
    case fs::file_type::character:
      throw FileError(name, "is a pipe, a socket or a device; expected an image file");
    default:
      throw FileError(name, "cannot be looked up (" + error.message() + "); expected an image file");
  }
}
} // namespace

bool
operator==(const FileIdentity & a, const FileIdentity & b)
{
  return AreSameFile(a, b) && a.size == b.size && a.modified == b.modified && a.statusChange == b.statusChange;
}

#if defined(__unix__) || defined(__APPLE__)

bool
AreSameFile(const FileIdentity & a, const FileIdentity & b)
{
  return a.device == b.device && a.inode == b.inode;
}

FileIdentity
IdentityOf(const std::string & name)
{
  RequireRegularFile(name);
  struct stat found = {};
  if (stat(name.c_str(), &found) != 0)
  {
    throw FileError(name, "does not exist; expected an image file");
  }
#  if defined(__APPLE__)
  const timespec modified = found.st_mtimespec;
  const timespec changed = found.st_ctimespec;
#  else
  const timespec modified = found.st_mtim;
  const timespec changed = found.st_ctim;
#  endif
  const auto nanoseconds = [](const timespec & time) {
    return std::int64_t{ time.tv_sec } * 1000000000 + time.tv_nsec;
  };
  return { name,
           static_cast<std::uint64_t>(found.st_dev),
           static_cast<std::uint64_t>(found.st_ino),
           static_cast<std::uint64_t>(found.st_size),
           nanoseconds(modified),
           nanoseconds(changed) };
}

#else

bool
AreSameFile(const FileIdentity & a, const FileIdentity & b)
{
  std::error_code error;
  return fs::equivalent(a.name, b.name, error);
}

FileIdentity
IdentityOf(const std::string & name)
{
  RequireRegularFile(name);
  using std::chrono::duration_cast;
  using std::chrono::nanoseconds;
  const auto modified = fs::last_write_time(name).time_since_epoch();
  return { name, 0, 0, fs::file_size(name), duration_cast<nanoseconds>(modified).count(), 0 };
}

#endif

FileIdentity
IdentityOfDataFile(const std::string & file, const std::string & dataFile)
{
  try
  {
    return IdentityOf(dataFile);
  }
  catch (const FileError & error)
  {
    throw FileError(file, "its data file " + std::string(error.what()));
  }
}

} // namespace sensornoise
