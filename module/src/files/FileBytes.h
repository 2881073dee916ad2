// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_files_FileBytes_h
#define sensornoise_files_FileBytes_h

#include "sensornoise/FrameFile.h"
#include "SensorNoiseExport.h"

#include <cstddef>
#include <cstdint>
#include <fstream>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace sensornoise
{

/** Returns whether both are the same file in the same state: same size and same times of its changes. */
SensorNoise_EXPORT bool
operator==(const FileIdentity & a, const FileIdentity & b);

inline bool
operator!=(const FileIdentity & a, const FileIdentity & b)
{
  return !(a == b);
}

/** Returns whether both are the same file, in any state and by any names. */
SensorNoise_EXPORT bool
AreSameFile(const FileIdentity & a, const FileIdentity & b);

/** Returns the identity of the regular file \a name, or of the file to which the link \a name leads. The file is not
 * opened, so that pipes and devices cannot block. Throws FileError if there is no file, or no regular file. */
SensorNoise_EXPORT FileIdentity
IdentityOf(const std::string & name);

/** Returns the identity of the data file that the header of \a file names. Throws as IdentityOf(), with messages that
 * begin with \a file. */
SensorNoise_EXPORT FileIdentity
IdentityOfDataFile(const std::string & file, const std::string & dataFile);

/** Reads bytes of a file at any place. */
class FileBytes
{
public:
  /** Opens the file \a path. Messages of errors begin with \a file, which is the same file or names it as its data
   * file. Throws FileError unless \a path is a readable regular file. */
  FileBytes(const std::string & file, const std::string & path);

  explicit FileBytes(const std::string & file)
    : FileBytes(file, file)
  {}

  /** Returns the size of the file when it was opened [bytes]. */
  std::uint64_t
  Size() const
  {
    return m_Size;
  }

  /** Returns whether all these bytes are in the file. */
  bool
  Holds(std::uint64_t offset, std::uint64_t count) const
  {
    return offset <= m_Size && count <= m_Size - offset;
  }

  /** Reads \a count bytes from \a offset on. Throws FileError if the file ends before, or if they cannot be read. */
  void
  Read(std::uint64_t offset, void * buffer, std::size_t count);

  /** Reads up to \a count bytes from \a offset on, fewer at the end of the file. Returns their number. Throws FileError
   * if they cannot be read. */
  std::size_t
  ReadSome(std::uint64_t offset, void * buffer, std::size_t count);

private:
  std::string   m_File;
  std::string   m_Path;
  std::uint64_t m_Size;
  std::uint64_t m_Position{ 0 };
  std::ifstream m_Stream;
};

/** Reads the bytes [offset, end) of a file one after the other, through a buffer of 16 KiB. */
class ByteReader
{
public:
  ByteReader(FileBytes & bytes, std::uint64_t offset, std::uint64_t end)
    : m_Bytes(bytes)
    , m_Offset(offset)
    , m_End(end)
  {}

  /** Returns the next byte; -1 at the end. */
  int
  Next()
  {
    return m_Used < m_Held || Fill() ? m_Buffer[m_Used++] : -1;
  }

  /** Returns the offset of the next byte [bytes]. */
  std::uint64_t
  Offset() const
  {
    return m_Offset - m_Held + m_Used;
  }

private:
  bool
  Fill();

  static constexpr std::size_t BufferBytes = 16384;

  FileBytes &   m_Bytes;
  std::uint64_t m_Offset;
  std::uint64_t m_End;
  std::size_t   m_Held{ 0 };
  std::size_t   m_Used{ 0 };
  unsigned char m_Buffer[BufferBytes]{};
};

/** Ranges of a file that hold pixels or tables, to find bytes that are used twice. Adjacent ranges are joined, and the
 * number of other ranges is limited, so that at most 8 MiB are used. */
class ByteRanges
{
public:
  using Range = std::pair<std::uint64_t, std::uint64_t>; // offsets of its first byte and behind its last byte

  /** Adds bytes that hold pixels. Returns false if there are too many separate ranges. */
  bool
  AddPixels(std::uint64_t offset, std::uint64_t count)
  {
    return Add(m_Pixels, offset, count, false);
  }

  /** Adds bytes that hold a table; several tables may overlap. Returns false if there are too many separate ranges. */
  bool
  AddTable(std::uint64_t offset, std::uint64_t count)
  {
    return Add(m_Tables, offset, count, true);
  }

  /** Returns the offset of a byte that holds pixels twice, or pixels and a table; none: there is no such byte. */
  std::optional<std::uint64_t>
  FirstConflict();

  /** Returns the ranges of a file of \a size bytes that are neither pixels nor tables. Gaps of up to 3 bytes between
   * pixels are left out. */
  std::vector<Range>
  Gaps(std::uint64_t size);

private:
  static constexpr std::size_t MaximumRanges = std::size_t{ 1 } << 18;

  /** Sorts the ranges and joins ranges that follow each other. Ranges that may overlap are also joined if they do. */
  static void
  Join(std::vector<Range> & ranges, bool mayOverlap);

  static bool
  Add(std::vector<Range> & ranges, std::uint64_t offset, std::uint64_t count, bool mayOverlap);

  std::vector<Range> m_Pixels;
  std::vector<Range> m_Tables;
};

} // namespace sensornoise

#endif
