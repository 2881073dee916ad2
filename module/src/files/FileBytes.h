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

SensorNoise_EXPORT bool
operator==(const FileIdentity & a, const FileIdentity & b);

inline bool
operator!=(const FileIdentity & a, const FileIdentity & b)
{
  return !(a == b);
}

/** Whether both are the same file, in whichever state, by whichever names. */
SensorNoise_EXPORT bool
AreSameFile(const FileIdentity & a, const FileIdentity & b);

/** The identity of the regular file that \a name, or the link of that name, stands for. It is not opened: pipes and
 * devices cannot make this wait. Throws FileError where there is no file, or no regular one. */
SensorNoise_EXPORT FileIdentity
IdentityOf(const std::string & name);

/** The same of a file whose name stands in another one, \a file, with which the errors then begin. */
SensorNoise_EXPORT FileIdentity
IdentityOfDataFile(const std::string & file, const std::string & dataFile);

/** Reads bytes of a file, at any place. */
class FileBytes
{
public:
  /** Of the file \a path, of which errors say that it is or belongs to \a file. Throws FileError unless it is a regular
   * file that may be read. */
  FileBytes(const std::string & file, const std::string & path);

  explicit FileBytes(const std::string & file)
    : FileBytes(file, file)
  {}

  /** [bytes] */
  std::uint64_t
  Size() const
  {
    return m_Size;
  }

  /** Whether all of these bytes lie in the file. */
  bool
  Holds(std::uint64_t offset, std::uint64_t count) const
  {
    return offset <= m_Size && count <= m_Size - offset;
  }

  /** Reads \a count bytes from \a offset on. Throws FileError where the file ends before. */
  void
  Read(std::uint64_t offset, void * buffer, std::size_t count);

  /** Reads up to \a count bytes from \a offset on, fewer at the end of the file. Returns their number. */
  std::size_t
  ReadSome(std::uint64_t offset, void * buffer, std::size_t count);

private:
  std::string   m_File;
  std::string   m_Path;
  std::uint64_t m_Size;
  std::uint64_t m_Position{ 0 };
  std::ifstream m_Stream;
};

/** Reads bytes one after the other, through a small buffer. */
class ByteReader
{
public:
  ByteReader(FileBytes & bytes, std::uint64_t offset, std::uint64_t end)
    : m_Bytes(bytes)
    , m_Offset(offset)
    , m_End(end)
  {}

  /** The next byte, or -1 at the end. */
  int
  Next()
  {
    return m_Used < m_Held || Fill() ? m_Buffer[m_Used++] : -1;
  }

  /** Of the byte that comes next. */
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

/** Which bytes of a file hold pixels and which hold tables, to find bytes that would be read twice over. Neighbours
 * that come one after the other are kept as one, and there is a limit to the number of others: at most 8 MiB are
 * needed. */
class ByteRanges
{
public:
  using Range = std::pair<std::uint64_t, std::uint64_t>; // its first byte and that behind its last

  /** Bytes that hold pixels. Returns false if there are too many ranges apart from each other. */
  bool
  AddPixels(std::uint64_t offset, std::uint64_t count)
  {
    return Add(m_Pixels, offset, count, false);
  }

  /** Bytes that hold something else; these may be used several times. Returns false as AddPixels(). */
  bool
  AddTable(std::uint64_t offset, std::uint64_t count)
  {
    return Add(m_Tables, offset, count, true);
  }

  /** A byte that holds pixels twice, or pixels and something else. */
  std::optional<std::uint64_t>
  FirstConflict();

  /** The places, of a file of that size, that belong to neither. */
  std::vector<Range>
  Gaps(std::uint64_t size);

private:
  static constexpr std::size_t MaximumRanges = std::size_t{ 1 } << 18;

  /** Sorts them, and makes one of those that touch each other, or, if they may share bytes, overlap. */
  static void
  Join(std::vector<Range> & ranges, bool mayShare);

  static bool
  Add(std::vector<Range> & ranges, std::uint64_t offset, std::uint64_t count, bool mayShare);

  std::vector<Range> m_Pixels;
  std::vector<Range> m_Tables;
};

} // namespace sensornoise

#endif
