// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "browser/ToolArguments.h"

#include "base/Text.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstddef>

namespace sensornoise::browser
{
namespace
{
/** Returns a word of a command line: in quotes, unless a shell takes all of its characters as they are. */
std::string
ShellWord(const std::string & text)
{
  const auto isPlain = [](unsigned char letter) {
    return std::isalnum(letter) != 0 || std::string("_./,:=+-@%").find(static_cast<char>(letter)) != std::string::npos;
  };
  std::string word = text.rfind('-', 0) == 0 ? "./" + text : text; // no option
  if (std::all_of(word.begin(), word.end(), isPlain))
  {
    return word;
  }
  std::string quoted = "\"";
  for (const char letter : word)
  {
    quoted += (std::string("\"\\$`").find(letter) == std::string::npos ? "" : "\\") + std::string(1, letter);
  }
  return quoted + "\"";
}

/** Returns the part that f(name) returns for all names; "": it differs. */
template <typename TFunction>
std::string
CommonPart(const std::vector<std::string> & names, const TFunction & f)
{
  const std::string part = f(names.front());
  return std::all_of(names.begin(), names.end(), [&](const std::string & name) { return f(name) == part; }) ? part : "";
}

std::string
NamesAsArguments(const std::vector<std::string> & names, const std::string & otherwise)
{
  constexpr std::size_t mostNames = 4;
  if (names.empty() || names.size() > mostNames)
  {
    const auto folderOf = [](const std::string & name) { return name.substr(0, name.rfind('/') + 1); };
    const auto endingOf = [](const std::string & name) {
      const std::size_t dot = name.rfind('.');
      return dot == std::string::npos ? std::string() : name.substr(dot);
    };
    const std::string folder = names.empty() ? "" : CommonPart(names, folderOf);
    const std::string ending = names.empty() ? "" : CommonPart(names, endingOf);
    if (!folder.empty())
    {
      return ShellWord(folder);
    }
    return ending.empty() || ShellWord(ending) != ending ? otherwise : "*" + ending;
  }
  std::string text;
  for (const std::string & name : names)
  {
    text += (text.empty() ? "" : " ") + ShellWord(name);
  }
  return text;
}

/** Returns the names as the user has them. */
std::vector<std::string>
WithoutDarkFolder(std::vector<std::string> names)
{
  const std::string folder = "dark/";
  for (std::string & name : names)
  {
    name = name.rfind(folder, 0) == 0 ? name.substr(folder.size()) : name;
  }
  return names;
}
} // namespace

std::string
ArgumentsOfTool(const ToolRequest & request)
{
  const BurstOptions & options = request.options;
  std::string          text = NamesAsArguments(request.files, "FRAMES");
  text += request.dark.empty() ? "" : " --dark " + NamesAsArguments(WithoutDarkFolder(request.dark), "DARK");
  text += options.method == BurstOptions().method ? "" : " --method " + ShellWord(options.method);
  text += options.bayer == BurstOptions().bayer ? "" : " --bayer " + ShellWord(options.bayer);
  text += options.bitDepth == 0 ? "" : " --bit-depth " + std::to_string(options.bitDepth);
  text += std::isnan(options.offsetDn) ? "" : " --offset " + ShortestText(options.offsetDn);
  text += request.raw.empty() ? "" : " --raw " + ShellWord(request.raw);
  return text;
}

} // namespace sensornoise::browser
