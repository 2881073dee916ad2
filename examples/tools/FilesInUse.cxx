// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "tools/FilesInUse.h"

#include "files/FileIdentity.h"
#include "tools/LowerCase.h"
#include "tools/OutputTarget.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>
#include <stdexcept>
#include <sys/stat.h>
#include <vector>

namespace sensornoise::tools
{
namespace
{
namespace fs = std::filesystem;

/** What an ordinary file, or one that is not there yet, is told by; empty for others. */
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

/** The other file of a Photron camera's recording. */
std::vector<fs::path>
OtherFilesOf(const fs::path & recording)
{
  std::vector<fs::path> files;
  for (const char * const ending : { ".mraw", ".MRAW", ".cihx", ".CIHX", ".cih", ".CIH" })
  {
    fs::path        other = recording;
    std::error_code ignored;
    if (fs::is_regular_file(other.replace_extension(ending), ignored) && other != recording)
    {
      files.push_back(other);
    }
  }
  return files;
}

/** The files that the header of a MetaImage or NRRD file names, and what else belongs to a file. */
std::vector<fs::path>
DataFilesOf(const fs::path & header)
{
  if (const std::string ending = LowerCaseEnding(header); ending == ".mraw" || ending == ".cihx" || ending == ".cih")
  {
    return OtherFilesOf(header);
  }
  const std::set<std::string> headers{ ".mha", ".mhd", ".nhdr", ".nrrd" };
  std::vector<fs::path>       files;
  if (headers.count(LowerCaseEnding(header)) == 0 || !fs::is_regular_file(header))
  {
    return files;
  }
  constexpr std::size_t longest = 1 << 20; // of a header, a list of files included
  std::string           text(longest, '\0');
  std::ifstream         file(header, std::ios::binary);
  file.read(text.data(), longest);
  text.resize(static_cast<std::size_t>(std::max<std::streamsize>(file.gcount(), 0)));
  std::istringstream lines(text);
  bool               isList = false;
  for (std::string line; std::getline(lines, line);)
  {
    const auto        separator = line.find_first_of("=:");
    const std::string key = LowerCase(line.substr(0, separator));
    const bool        isKey = key.rfind("elementdatafile", 0) == 0 || key == "data file" || key == "datafile";
    if (isKey || isList)
    {
      const std::string value = isList || separator == std::string::npos ? line : line.substr(separator + 1);
      const auto        first = value.find_first_not_of(" \t\r");
      const auto        last = value.find_last_not_of(" \t\r");
      const std::string name = first == std::string::npos ? "" : value.substr(first, last + 1 - first);
      std::error_code   ignored;
      isList = isList || LowerCase(name).rfind("list", 0) == 0;
      if (!name.empty() && fs::is_regular_file(header.parent_path() / name, ignored))
      {
        files.push_back(header.parent_path() / name);
      }
    }
  }
  return files;
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
  for (const fs::path & data : DataFilesOf(file))
  {
    const bool isHeader = LowerCaseEnding(data).rfind(".cih", 0) == 0;
    use(data, data.string() + (isHeader ? ", the header of " : ", the pixels of ") + role + " " + file);
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
