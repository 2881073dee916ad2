// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_files_TextHeader_h
#define sensornoise_files_TextHeader_h

#include "files/FileBytes.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace sensornoise
{

/** The lines at the head of a MetaImage or NRRD file: text without control characters, at most 4096 bytes in a line
 * (the longest path of Linux), 100,000 lines, and 4 MiB. */
class TextHeader
{
public:
  TextHeader(const std::string & file, FileBytes & bytes);

  /** The next line, without its end; nothing at the end of the file. Throws FileError. */
  std::optional<std::string>
  Next();

  /** Whether the line that came last had an end, other than that of the file. */
  bool
  LineWasEnded() const
  {
    return m_Ended;
  }

  /** Of the line that came last, from 1. */
  std::size_t
  LineNumber() const
  {
    return m_Line;
  }

  /** Of the byte behind the line that came last. */
  std::uint64_t
  Offset() const
  {
    return m_Reader.Offset();
  }

private:
  std::string m_File;
  ByteReader  m_Reader;
  std::size_t m_Line{ 0 };
  bool        m_Ended{ false };
};

/** Without the blanks around it. */
std::string
WithoutBlanks(const std::string & text);

/** With small letters, of ASCII. */
std::string
InSmallLetters(std::string text);

/** The characters of ASCII that are no control characters, without blanks around them, at most 100. */
std::string
PrintableText(const std::string & text);

/** The words of a text, which blanks part. */
std::vector<std::string>
WordsOf(const std::string & text);

/** A whole number of digits alone, below 2^63. */
std::optional<std::uint64_t>
WholeNumber(const std::string & text);

/** The number that a text is, with a point whatever the program's locale; infinite and NaN: nothing. */
std::optional<double>
FiniteNumber(const std::string & text);

/** The finite numbers in a text, which blanks part; empty where a word is none. */
std::vector<double>
NumbersOf(const std::string & text);

} // namespace sensornoise

#endif
