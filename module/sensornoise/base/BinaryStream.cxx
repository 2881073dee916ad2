// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/base/BinaryStream.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <istream>
#include <ostream>
#include <stdexcept>
#include <string>

namespace sensornoise
{

void
WriteCount(std::ostream & out, std::uint64_t count)
{
  WriteNumbers(out, &count, 1);
}

std::uint64_t
ReadCount(std::istream & in)
{
  std::uint64_t count = 0;
  ReadNumbers(in, &count, 1);
  return count;
}

void
RequireCount(const char * what, std::uint64_t found, std::uint64_t expected)
{
  if (found != expected)
  {
    throw std::runtime_error("the sums of a stream do not fit: found " + std::to_string(found) + " " + what +
                             ", expected " + std::to_string(expected));
  }
}

void
RequireSameStart(std::uint64_t found, std::uint64_t expected)
{
  if (found != expected)
  {
    throw std::runtime_error("sums cannot be merged: they are made with other settings, another mask or other sums of "
                             "the passes before");
  }
}

void
WriteSumsHeader(std::ostream & out, const std::string & name, std::uint64_t pixels, std::uint64_t frames)
{
  std::array<char, 32> word{};
  std::copy_n(name.begin(), std::min(name.size(), word.size()), word.begin());
  WriteNumbers(out, word.data(), word.size());
  WriteNumbers(out, &SumsVersion, 1);
  WriteCount(out, pixels);
  WriteCount(out, frames);
}

std::uint64_t
ReadSumsHeader(std::istream & in, const std::string & name, std::uint64_t pixels)
{
  std::array<char, 32> word{};
  ReadNumbers(in, word.data(), word.size());
  std::string found(word.data(), std::find(word.begin(), word.end(), '\0'));
  if (found != name)
  {
    std::replace_if(found.begin(), found.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
    throw std::runtime_error("a stream holds other sums: found \"" + found + "\", expected \"" + name + "\"");
  }
  std::uint32_t version = 0;
  ReadNumbers(in, &version, 1);
  if (version != SumsVersion)
  {
    throw std::runtime_error("a stream holds another version of \"" + name + "\": found " + std::to_string(version) +
                             ", expected " + std::to_string(SumsVersion));
  }
  RequireCount("pixels", ReadCount(in), pixels);
  return ReadCount(in);
}

} // namespace sensornoise
