// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_files_FileBytes_h
#define sensornoise_files_FileBytes_h

#include <cstddef>
#include <cstdint>
#include <fstream>
#include <string>

namespace sensornoise
{

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

} // namespace sensornoise

#endif
