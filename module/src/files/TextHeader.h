// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_files_TextHeader_h
#define sensornoise_files_TextHeader_h

#include "files/Compression.h"
#include "files/FileBytes.h"
#include "files/FrameReader.h"
#include "sensornoise/FrameFile.h"

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

/** Place of the pixels of a MetaImage or NRRD file, or of one of its frames. */
struct DataPlace
{
  std::string path{}; // path of the file itself, or of its data file
  /** Offset of the first pixel in the file; with `fromEnd` its least value [bytes]. */
  std::uint64_t offset{ 0 };
  bool          fromEnd{ false }; // the pixels are the last bytes of the file
  bool          attached{ true }; // the pixels are in the file itself, behind its header
};

/** Adds the identity of \a path to \a identities. Throws FileError if it is no regular file, or if \a identities
 * already has it: it is then the file itself, or the data file of another frame. */
void
AddDataFile(const std::string & file, const std::string & path, std::vector<FileIdentity> & identities);

/** Returns the offset of the pixels [bytes]. Throws FileError unless the file has exactly \a expected bytes from this
 * offset to its end. With DataPlace::fromEnd the offset follows from the end. Then fewer than \a frameBytes bytes may
 * be left over before the pixels, because more could be frames that the header lacks. */
std::uint64_t
RequireExactly(const std::string & file, const DataPlace & place, std::uint64_t expected, std::uint64_t frameBytes);

/** Throws FileError if bytes are left behind the pixels. \a left: their number. */
void
RequireNothingLeft(const std::string & file, const DataPlace & place, std::uint64_t left);

/** Returns " in its data file NAME"; "" for a place in \a file itself. */
std::string
InDataFile(const std::string & file, const DataPlace & place);

/** Returns the path of a data file that the header of \a file names: relative to the folder of \a file. */
std::string
PathOfDataFile(const std::string & file, const std::string & name);

/** Coding of the pixels at their places. */
struct DataCoding
{
  SampleFormat                    sample{};
  std::optional<InflateContainer> compression{};
  std::uint64_t                   compressedBytes{ 0 }; // size at one place [bytes]; 0: up to the end of the file
};

/** Checks the places of the pixels of \a file, whose size and pixel type are set. There is one place for all frames, or
 * one for each frame. Each must have exactly its pixels. Adds the identities of data files, and sets the reader of the
 * frames. Calls \a beforeInflating before it inflates compressed pixels. Throws FileError. */
void
SetDataFrames(FrameFile &                    file,
              const std::vector<DataPlace> & places,
              const DataCoding &             coding,
              const BeforeInflating &        beforeInflating);

/** Fields of the header of a MetaImage. */
struct MetaImageHeader
{
  std::map<std::string, std::string> fields{};
  std::vector<std::string>           list{};   // names of the data files behind "ElementDataFile = LIST"
  std::uint64_t                      end{ 0 }; // size of the header [bytes]

  /** Returns the value of a field; "" if the header lacks it. */
  std::string
  Field(const std::string & key) const;
};

/** Reads the header. Each line must be a name, a separator and a value. Required fields must be present, known fields
 * must have allowed values, and no field may occur twice. Throws FileError otherwise. A list of data files may end in
 * an incomplete line, which is left out. */
MetaImageHeader
ReadMetaImageHeader(const std::string & file, FileBytes & bytes);

/** Fields of the header of a NRRD file, by their names in lower case and with spaces. */
struct NrrdHeader
{
  std::map<std::string, std::string> fields{};
  std::vector<std::string>           list{};   // names of the data files behind "data file: LIST"
  std::uint64_t                      end{ 0 }; // size of the header [bytes]

  /** Returns the value of a field; "" if the header lacks it. */
  std::string
  Field(const std::string & key) const;
};

/** Reads the header. Throws FileError for another version than 1 to 5, an incomplete line, a field that occurs twice,
 * and a line that is no field, comment or key. The empty line at the end may be missing only if the header names a data
 * file. */
NrrdHeader
ReadNrrdHeader(const std::string & file, FileBytes & bytes);

} // namespace sensornoise

#endif
