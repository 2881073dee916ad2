// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "tools/OutputTarget.h"

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <fcntl.h>
#include <stdexcept>
#include <system_error>
#include <unistd.h>

namespace sensornoise::tools
{
namespace
{
namespace fs = std::filesystem;

[[noreturn]] void
RefuseOutput(const std::string & name, const std::string & why)
{
  throw std::runtime_error("cannot write " + name + ": " + why);
}

/** Returns the number of the file descriptor if \a folder is the folder of descriptors, such as /dev/fd, and \a file
 * is a number; else -1. */
int
DescriptorOf(const fs::path & folder, const std::string & file)
{
  std::error_code ignored;
  const bool      isNumber = !file.empty() && file.size() < 8 &&
                        std::all_of(file.begin(), file.end(), [](unsigned char c) { return std::isdigit(c) != 0; });
  const bool isFolder =
    folder == fs::canonical("/proc/self/fd", ignored) || folder == fs::canonical("/dev/fd", ignored);
  return isNumber && isFolder ? std::stoi(file) : -1;
}

void
RequireFolder(const OutputTarget & target)
{
  const fs::path    folder = target.path.parent_path();
  const fs::path    given = fs::path(target.name).parent_path();
  const std::string words = given.empty() ? "." : given.string();
  if (!fs::is_directory(folder))
  {
    RefuseOutput(target.name, "there is no folder " + words + "; make it first, or name another");
  }
  if (access(folder.c_str(), W_OK | X_OK) != 0)
  {
    RefuseOutput(target.name, "no file can be made in folder " + words + ", " + std::generic_category().message(errno));
  }
}

/** Sets the kind of the target. Throws std::runtime_error if it cannot be written. */
void
FindKind(OutputTarget & target)
{
  std::error_code error;
  const auto      status = fs::status(target.path, error);
  switch (status.type())
  {
    case fs::file_type::not_found:
      RequireFolder(target);
      return;
    case fs::file_type::directory:
      RefuseOutput(target.name, "it is a folder");
    case fs::file_type::regular:
      RequireFolder(target);
      break;
    case fs::file_type::fifo:
    case fs::file_type::character:
      target.kind = OutputTarget::Kind::Special;
      break;
    default:
      RefuseOutput(target.name, error ? error.message() : "it is neither a file, a pipe nor a character device");
  }
  if (access(target.path.c_str(), W_OK) != 0)
  {
    RefuseOutput(target.name, "it is there and may not be written to, " + std::generic_category().message(errno));
  }
}
} // namespace

OutputTarget
FindTarget(const std::string & name)
{
  OutputTarget target;
  target.name = name;
  if (name.empty())
  {
    throw std::runtime_error("the name of an output is empty; expected the name of a file");
  }
  fs::path path = name;
  for (int links = 0; links < 40; ++links) // Linux follows 40 links as well
  {
    const fs::path  parent = path.has_parent_path() ? path.parent_path() : fs::path(".");
    std::error_code error;
    const fs::path  folder = fs::canonical(parent, error);
    if (error)
    {
      RefuseOutput(name, "there is no folder " + parent.string() + "; make it first, or name another");
    }
    target.descriptor = DescriptorOf(folder, path.filename().string());
    if (target.descriptor >= 0)
    {
      target.kind = OutputTarget::Kind::Descriptor;
      const int flags = fcntl(target.descriptor, F_GETFL);
      if (flags < 0 || (flags & O_ACCMODE) == O_RDONLY)
      {
        RefuseOutput(name, "it is not open for writing");
      }
      return target;
    }
    target.path = folder / path.filename();
    if (!fs::is_symlink(fs::symlink_status(target.path, error)))
    {
      FindKind(target);
      return target;
    }
    path = folder / fs::read_symlink(target.path);
  }
  RefuseOutput(name, "too many symbolic links follow one another");
}

} // namespace sensornoise::tools
