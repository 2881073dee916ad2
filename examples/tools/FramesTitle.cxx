// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "tools/FramesTitle.h"

#include <array>
#include <cstddef>
#include <ctime>
#include <filesystem>
#include <string>
#include <sys/stat.h>

namespace sensornoise::tools
{
namespace
{
std::string
WithoutFolders(const std::string & name)
{
  return std::filesystem::path(name).filename().string();
}

std::string
TimeOfChange(const std::string & name)
{
  struct stat          properties = {};
  std::tm              time = {};
  std::array<char, 40> text{};
  if (stat(name.c_str(), &properties) != 0 || gmtime_r(&properties.st_mtime, &time) == nullptr)
  {
    return "";
  }
  const std::size_t length = std::strftime(text.data(), text.size(), "%Y-%m-%d %H:%M UTC", &time);
  return std::string(text.data(), length);
}
} // namespace

PageTitle
TitleOf(const FrameList & list)
{
  const std::string first = WithoutFolders(list.files.front().name);
  const std::string last = list.files.back().name;
  return { list.files.size() == 1 ? first : first + " to " + WithoutFolders(last), TimeOfChange(last) };
}

} // namespace sensornoise::tools
