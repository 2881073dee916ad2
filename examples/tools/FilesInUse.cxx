// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "tools/FilesInUse.h"

#include "files/FrameFormats.h"
#include "tools/LowerCase.h"
#include "tools/OutputTarget.h"

#include <filesystem>
#include <set>
#include <stdexcept>
#include <sys/stat.h>

namespace sensornoise::tools
{
namespace
{
namespace fs = std::filesystem;

/** Returns the identity of an ordinary file (device and inode), or the path if there is no such file. It is empty
 * for pipes and devices. */
std::string
IdentityOf(const fs::path & path)
{
  struct stat file = {};
  if (stat(path.c_str(), &file) != 0)
  {
    return path.string();
  }
  return S_ISREG(file.st_mode) ? std::to_string(file.st_dev) + ":" + std::to_string(file.st_ino) : "";
}

std::string
IdentityOf(const OutputTarget & target)
{
  return IdentityOf(target.kind == OutputTarget::Kind::Descriptor
                      ? fs::path("/dev/fd") / std::to_string(target.descriptor)
                      : target.path);
}

} // namespace

void
FilesInUse::Read(const std::string & file, const std::string & role)
{
  std::error_code ignored;
  const auto      use = [&](const fs::path & path, const std::string & words) {
    const std::string identity = IdentityOf(fs::absolute(path, ignored));
    if (!identity.empty())
    {
      m_Uses.emplace(identity, words);
    }
  };
  use(file, role + " " + file);
  for (const std::string & data : DataFilesOf(file))
  {
    const bool isHeader = LowerCaseEnding(data).rfind(".cih", 0) == 0;
    use(data, data + (isHeader ? ", the header of " : ", the pixels of ") + role + " " + file);
  }
}

void
FilesInUse::Write(const std::string & file, const std::string & option)
{
  const std::string identity = IdentityOf(FindTarget(file));
  const auto        use = m_Uses.find(identity);
  if (!identity.empty() && use != m_Uses.end())
  {
    throw std::runtime_error("cannot write " + file + " (" + option + "): it is the same file as " + use->second +
                             "; expected another name");
  }
  m_Uses.emplace(identity, file + " (" + option + ")");
}

void
RequireReportName(const std::string & file, const std::string & option)
{
  static const std::set<std::string> images{ ".avi", ".bin",  ".cih",  ".cihx", ".bmp",  ".bz2",  ".cr2",  ".dcm",
                                             ".dng", ".fit",  ".fits", ".fts",  ".gif",  ".gipl", ".gz",   ".h5",
                                             ".hdr", ".img",  ".jpg",  ".jpeg", ".lsm",  ".mha",  ".mhd",  ".mraw",
                                             ".nef", ".nhdr", ".nii",  ".npy",  ".nrrd", ".pgm",  ".png",  ".ppm",
                                             ".raw", ".ser",  ".stk",  ".tif",  ".tiff", ".vtk",  ".webp", ".zraw" };
  const std::string                  ending = fs::path(file).extension().string();
  if (images.count(LowerCase(ending)) != 0)
  {
    throw std::runtime_error("cannot write " + file + " (" + option + "): a report is text, and " + ending +
                             " is the ending of an image; was the report's name forgotten? Expected for example " +
                             option + " report.json");
  }
}

} // namespace sensornoise::tools
