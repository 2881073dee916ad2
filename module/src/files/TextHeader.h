// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_files_TextHeader_h
#define sensornoise_files_TextHeader_h

#include "files/FileBytes.h"

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace sensornoise
{

/** Lines of the header of a MetaImage or NRRD file: text without control characters, at most 4096 bytes per line (the
 * longest path in Linux), 100,000 lines, and 4 MiB. */
class TextHeader
{
public:
  TextHeader(const std::string & file, FileBytes & bytes);

  /** Returns the next line without its end; none at the end of the file. Throws FileError for other characters and for
   * more than these limits. */
  std::optional<std::string>
  Next();

  /** Returns whether a line feed ended the line that Next() returned, not the end of the file. */
  bool
  LineWasEnded() const
  {
    return m_Ended;
  }

  /** Returns the number of the line that Next() returned, from 1. */
  std::size_t
  LineNumber() const
  {
    return m_Line;
  }

  /** Returns the offset of the byte behind the line that Next() returned [bytes]. */
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

/** Returns \a text without spaces and tabs around it. */
std::string
WithoutBlanks(const std::string & text);

/** Returns the first 100 printable ASCII characters of \a text, without spaces around them. */
std::string
PrintableText(const std::string & text);

/** Returns the words of a text, which spaces and tabs separate. */
std::vector<std::string>
WordsOf(const std::string & text);

/** Returns the whole number of a text that has only digits, at most 18; else none. */
std::optional<std::uint64_t>
WholeNumber(const std::string & text);

/** Returns the finite numbers of a text, which spaces and tabs separate; empty if a word is no finite number. */
std::vector<double>
NumbersOf(const std::string & text);

/** Header of one unit (HDU) of a FITS file, and the place of its data. */
struct FitsHeader
{
  std::string                        name{};   // name of the unit for messages: "file.fits, HDU 1"
  std::map<std::string, std::string> values{}; // values by keyword, texts without quotation marks
  std::vector<std::uint64_t>         axes{};   // sizes of the axes, NAXIS1 first
  std::int64_t                       bitsOfPixel{ 0 };
  std::uint64_t                      dataBegin{ 0 }; // offset of the data [bytes]
  std::uint64_t                      dataBytes{ 0 }; // size of the data without padding [bytes]
  std::uint64_t                      next{ 0 };      // offset behind the last block [bytes]

  /** Returns the value of a keyword as text; "" if the header lacks it. */
  std::string
  Text(const std::string & key) const;

  /** Returns the value of a keyword as a number; none if the header lacks it. Throws FileError unless it is a finite
   * number. */
  std::optional<double>
  Number(const std::string & key) const;

  /** Returns the value of a keyword as an integer; none if the header lacks it. Throws FileError unless it is an
   * integer of at most 18 digits. */
  std::optional<std::int64_t>
  Integer(const std::string & key) const;
};

/** Reads the header of the unit at \a offset [bytes]. Throws FileError unless it is a header of the FITS standard,
 * version 4, and the file has all blocks of its data. */
FitsHeader
ReadFitsHeader(const std::string & name, FileBytes & bytes, std::uint64_t offset);

} // namespace sensornoise

#endif
