// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifdef SENSORNOISE_LIBRAW
#  include "files/LibRawStream.h"

#  include "files/FileBytes.h"
#  include "sensornoise/FrameFile.h"

#  include <cstdio>
#  include <cstring>

namespace sensornoise
{

LibRawStream::LibRawStream(const std::string & file)
  : LibRaw_bigfile_datastream(file.c_str())
{
  if (!valid())
  {
    throw FileError(file, "cannot be read");
  }
  char      head[4] = {};
  FileBytes bytes(file);
  bytes.ReadSome(0, head, sizeof(head));
  m_MayThrow = std::memcmp(head, "II", 2) == 0 || std::memcmp(head, "MM", 2) == 0;
  m_ReadsBlocks = std::memcmp(head, "IIU", 3) == 0; // Panasonic's
}

int
LibRawStream::read(void * buffer, size_t size, size_t count)
{
  const int found = LibRaw_bigfile_datastream::read(buffer, size, count);
  if (m_Watches && size != 0 && found < static_cast<int>(count) && (found <= 0 || !m_ReadsBlocks))
  {
    OnEnd();
  }
  return found;
}

int
LibRawStream::get_char()
{
  const int found = LibRaw_bigfile_datastream::get_char();
  if (m_Watches && found == EOF)
  {
    OnEnd();
  }
  return found;
}

void
LibRawStream::OnEnd()
{
  m_HasEnded = true;
  if (m_MayThrow)
  {
    throw LIBRAW_EXCEPTION_IO_EOF;
  }
}

} // namespace sensornoise
#endif
