// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "files/FileBytes.h"

#include "sensornoise/FrameFile.h"
#include "files/FileIdentity.h"

#include <algorithm>
#include <ios>

namespace sensornoise
{
namespace
{
/** In front of what is wrong with a data file. */
std::string
PlaceOf(const std::string & file, const std::string & path)
{
  return file == path ? "" : "its data file " + path + " ";
}
} // namespace

FileBytes::FileBytes(const std::string & file, const std::string & path)
  : m_File(file)
  , m_Path(path)
  , m_Size((file == path ? IdentityOf(path) : IdentityOfDataFile(file, path)).size)
  , m_Stream(path, std::ios::binary)
{
  if (!m_Stream)
  {
    throw FileError(file, PlaceOf(file, path) + "cannot be opened; expected a file that may be read");
  }
}

std::size_t
FileBytes::ReadSome(std::uint64_t offset, void * buffer, std::size_t count)
{
  if (offset >= m_Size)
  {
    return 0;
  }
  if (offset != m_Position)
  {
    m_Stream.seekg(static_cast<std::streamoff>(offset));
  }
  const auto wanted = static_cast<std::size_t>(std::min<std::uint64_t>(count, m_Size - offset));
  m_Stream.read(static_cast<char *>(buffer), static_cast<std::streamsize>(wanted));
  if (static_cast<std::size_t>(m_Stream.gcount()) != wanted)
  {
    throw FileError(m_File,
                    PlaceOf(m_File, m_Path) + "cannot be read from byte " + std::to_string(offset) + " on; expected " +
                      std::to_string(wanted) + " bytes there");
  }
  m_Position = offset + wanted;
  return wanted;
}

void
FileBytes::Read(std::uint64_t offset, void * buffer, std::size_t count)
{
  if (!Holds(offset, count))
  {
    throw FileError(m_File,
                    "truncated: " + PlaceOf(m_File, m_Path) + "ends after " + std::to_string(m_Size) +
                      " bytes, expected " + std::to_string(count) + " bytes from byte " + std::to_string(offset) +
                      " on");
  }
  ReadSome(offset, buffer, count);
}

bool
ByteReader::Fill()
{
  const std::uint64_t left = m_End - std::min(m_End, m_Offset);
  m_Held = m_Bytes.ReadSome(m_Offset, m_Buffer, static_cast<std::size_t>(std::min<std::uint64_t>(left, BufferBytes)));
  m_Used = 0;
  m_Offset += m_Held;
  return m_Held > 0;
}

} // namespace sensornoise
