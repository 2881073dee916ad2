// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "files/TextHeader.h"

#include "sensornoise/FrameFile.h"
#include "base/Text.h"

#include <cstdlib>

namespace sensornoise
{
namespace
{
constexpr std::uint64_t MaximumHeaderBytes = 4 << 20;
constexpr std::size_t   MaximumHeaderLines = 100000;
constexpr std::size_t   MaximumLineBytes = 4096;
constexpr const char *  Blanks = " \t";

bool
IsText(int c)
{
  return c == '\t' || (c >= ' ' && c != 0x7F);
}
} // namespace

TextHeader::TextHeader(const std::string & file, FileBytes & bytes)
  : m_File(file)
  , m_Reader(bytes, 0, bytes.Size())
{}

std::optional<std::string>
TextHeader::Next()
{
  std::string line;
  int         c = m_Reader.Next();
  if (c < 0)
  {
    return std::nullopt;
  }
  ++m_Line;
  const std::string place = "line " + std::to_string(m_Line) + " of its header ";
  for (; c >= 0 && c != '\n'; c = m_Reader.Next())
  {
    if (!line.empty() && line.back() == '\r')
    {
      throw FileError(m_File, place + "has a carriage return within it; expected text");
    }
    if (c != '\r' && !IsText(c))
    {
      throw FileError(m_File, place + "has the character of code " + std::to_string(c) + "; expected text");
    }
    if (line.size() >= MaximumLineBytes)
    {
      throw FileError(m_File,
                      place + "has more than " + std::to_string(MaximumLineBytes) + " characters; expected fewer");
    }
    line += static_cast<char>(c);
  }
  m_Ended = c == '\n';
  if (!line.empty() && line.back() == '\r')
  {
    line.pop_back();
  }
  if (m_Reader.Offset() > MaximumHeaderBytes || m_Line > MaximumHeaderLines)
  {
    throw FileError(m_File,
                    "its header has more than " + std::to_string(MaximumHeaderLines) +
                      " lines, or more than 4 MiB; expected a MetaImage or NRRD file");
  }
  return line;
}

std::string
WithoutBlanks(const std::string & text)
{
  const std::size_t first = text.find_first_not_of(Blanks);
  return first == std::string::npos ? "" : text.substr(first, text.find_last_not_of(Blanks) - first + 1);
}

std::string
PrintableText(const std::string & text)
{
  constexpr std::size_t longest = 100;
  std::string           printable;
  for (const char c : text)
  {
    printable += c >= ' ' && c < 127 && printable.size() < longest ? std::string(1, c) : "";
  }
  return WithoutBlanks(printable);
}

std::vector<std::string>
WordsOf(const std::string & text)
{
  std::vector<std::string> words;
  for (std::size_t at = text.find_first_not_of(Blanks); at != std::string::npos;)
  {
    const std::size_t end = text.find_first_of(Blanks, at);
    words.push_back(text.substr(at, end - at));
    at = text.find_first_not_of(Blanks, end);
  }
  return words;
}

std::optional<std::uint64_t>
WholeNumber(const std::string & text)
{
  if (text.empty() || text.size() > 18 || text.find_first_not_of("0123456789") != std::string::npos)
  {
    return std::nullopt;
  }
  return std::strtoull(text.c_str(), nullptr, 10);
}

std::vector<double>
NumbersOf(const std::string & text)
{
  std::vector<double> numbers;
  for (const std::string & word : WordsOf(text))
  {
    const std::optional<double> number = FiniteNumber(word);
    if (!number)
    {
      return {};
    }
    numbers.push_back(*number);
  }
  return numbers;
}

} // namespace sensornoise
