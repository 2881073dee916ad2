// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/FrameFile.h"

#include <cstddef>

namespace sensornoise
{
namespace
{
/** The number of bytes of the character of UTF-8 that begins at `at`; 0 where none does. */
std::size_t
CharacterBytes(const std::string & text, std::size_t at)
{
  const auto        byte = [&text](std::size_t i) { return static_cast<unsigned char>(i < text.size() ? text[i] : 0); };
  const unsigned    first = byte(at);
  const std::size_t count = first < 0x80                    ? 1
                            : first >= 0xC2 && first < 0xE0 ? 2
                            : first >= 0xE0 && first < 0xF0 ? 3
                            : first >= 0xF0 && first < 0xF5 ? 4
                                                            : 0;
  for (std::size_t i = 1; i < count; ++i)
  {
    if ((byte(at + i) & 0xC0) != 0x80)
    {
      return 0;
    }
  }
  const unsigned second = byte(at + 1);
  const bool     isTooLong = (first == 0xE0 && second < 0xA0) || (first == 0xF0 && second < 0x90);
  const bool     isNoCharacter = (first == 0xED && second >= 0xA0) || (first == 0xF4 && second >= 0x90);
  const bool     isControl = first < ' ' || first == 0x7F || (first == 0xC2 && second < 0xA0);
  return isTooLong || isNoCharacter || isControl ? 0 : count;
}

std::string
OneLine(const std::string & text)
{
  std::string line;
  for (std::size_t at = 0; at < text.size();)
  {
    const std::size_t count = CharacterBytes(text, at);
    line += count == 0 ? "?" : text.substr(at, count);
    at += count == 0 ? 1 : count;
  }
  return line;
}
} // namespace

FileError::FileError(const std::string & file, const std::string & what)
  : std::runtime_error(OneLine(file + ": " + what))
{}

} // namespace sensornoise
