// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "tools/FileNames.h"

#include "files/FrameFormats.h"
#include "tools/LowerCase.h"

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <glob.h>
#include <iostream>
#include <stdexcept>

namespace sensornoise::tools
{
namespace
{
namespace fs = std::filesystem;

bool
IsDigit(char c)
{
  return std::isdigit(static_cast<unsigned char>(c)) != 0;
}

/** Returns the digits that begin at position \a at, without leading zeros. Moves \a at behind them. */
std::string
TakeNumber(const std::string & text, std::size_t & at)
{
  std::string digits;
  for (; at < text.size() && IsDigit(text[at]); ++at)
  {
    if (!digits.empty() || text[at] != '0')
    {
      digits += text[at];
    }
  }
  return digits;
}

bool
IsImage(const fs::path & file)
{
  std::string   head(512, '\0');
  std::ifstream stream(file, std::ios::binary);
  stream.read(head.data(), static_cast<std::streamsize>(head.size()));
  head.resize(static_cast<std::size_t>(stream.gcount()));
  return FindFrameFormat(head, file.string()) != nullptr;
}

/** Returns whether the file is the header of a Photron recording whose pixels are in a file of the same folder. That
 * file stands for the whole recording. */
bool
IsHeaderOfOther(const fs::path & file)
{
  const std::string ending = LowerCaseEnding(file);
  return (ending == ".cihx" || ending == ".cih") && !DataFilesOf(file.string()).empty();
}

std::vector<std::string>
ImagesIn(const std::string & folder, bool areRaw)
{
  std::vector<std::string> names;
  std::vector<std::string> others;
  for (const fs::directory_entry & entry : fs::directory_iterator(folder))
  {
    if (!entry.is_regular_file() || entry.path().filename().string().front() == '.')
    {
      continue;
    }
    const bool isTaken = areRaw || (IsImage(entry.path()) && !IsHeaderOfOther(entry.path()));
    (isTaken ? names : others).push_back(entry.path().string());
  }
  if (names.empty() && others.empty())
  {
    throw std::invalid_argument(folder + ": there is no file in this folder, and folders in it are not searched; "
                                         "expected the folder of the frames");
  }
  if (names.empty())
  {
    throw std::invalid_argument(folder + ": none of the " + std::to_string(others.size()) +
                                " files in this folder is an image; expected " + NamesOfFrameFormats());
  }
  if (!others.empty())
  {
    std::cerr << "note: " << folder << ": " << others.size() << " of " << names.size() + others.size() << " files "
              << (others.size() == 1 ? "is no image and is" : "are no images and are") << " left out, "
              << (others.size() == 1 ? "" : "the first ") << *std::min_element(others.begin(), others.end(), IsBefore)
              << (others.size() == 1 ? "" : " by name") << '\n';
  }
  return names;
}

std::vector<std::string>
FilesLike(const std::string & pattern)
{
  glob_t                   found{};
  std::vector<std::string> names;
  if (glob(pattern.c_str(), GLOB_NOSORT, nullptr, &found) == 0) // NOLINT(concurrency-mt-unsafe)
  {
    names.assign(found.gl_pathv, found.gl_pathv + found.gl_pathc);
  }
  globfree(&found);
  if (names.empty())
  {
    throw std::invalid_argument(pattern + ": no file matches this pattern; expected the names of image files");
  }
  return names;
}

void
NoteOrderOfText(const std::vector<std::string> & names)
{
  if (names.size() > 1 && std::is_sorted(names.begin(), names.end()) &&
      !std::is_sorted(names.begin(), names.end(), IsBefore))
  {
    const auto out = std::is_sorted_until(names.begin(), names.end(), IsBefore);
    std::cerr << "note: " << *out << " is read after " << *(out - 1)
              << ", as the shell sorts names as text; for the order of numbers quote the pattern: 'frame_*.tif'\n";
  }
}
} // namespace

bool
IsBefore(const std::string & a, const std::string & b)
{
  std::size_t i = 0;
  std::size_t j = 0;
  while (i < a.size() && j < b.size())
  {
    if (IsDigit(a[i]) && IsDigit(b[j]))
    {
      const std::string x = TakeNumber(a, i);
      const std::string y = TakeNumber(b, j);
      if (x != y)
      {
        return x.size() != y.size() ? x.size() < y.size() : x < y;
      }
      continue;
    }
    if (a[i] != b[j])
    {
      return a[i] < b[j];
    }
    ++i;
    ++j;
  }
  const bool isEnd = i == a.size() && j == b.size();
  return isEnd ? a < b : i == a.size();
}

std::vector<std::string>
ExpandNames(const std::vector<std::string> & names, bool areRaw)
{
  std::vector<std::string> expanded;
  NoteOrderOfText(names);
  for (const std::string & name : names)
  {
    if (name.empty())
    {
      throw std::invalid_argument("the name of a file is empty, as of a shell's variable that is not set; expected the "
                                  "names of image files");
    }
    std::error_code          ignored;
    const bool               isPattern = name.find_first_of("*?[") != std::string::npos && !fs::exists(name, ignored);
    std::vector<std::string> found{ name };
    if (isPattern || fs::is_directory(name, ignored))
    {
      found = isPattern ? FilesLike(name) : ImagesIn(name, areRaw);
      std::sort(found.begin(), found.end(), IsBefore);
    }
    expanded.insert(expanded.end(), found.begin(), found.end());
  }
  return expanded;
}

} // namespace sensornoise::tools
