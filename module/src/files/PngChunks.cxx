// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "files/PngChunks.h"

#include "sensornoise/FrameFile.h"
#include "files/Zlib.h"

#include <algorithm>
#include <array>

namespace sensornoise
{
namespace
{
bool
IsLetter(unsigned char c)
{
  return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z');
}
} // namespace

std::uint32_t
PngNumber(const unsigned char * bytes)
{
  return (std::uint32_t{ bytes[0] } << 24) | (std::uint32_t{ bytes[1] } << 16) | (std::uint32_t{ bytes[2] } << 8) |
         bytes[3];
}

PngChunks::PngChunks(const std::string & file, FileBytes & bytes)
  : m_File(file)
  , m_Bytes(bytes)
  , m_Buffer(65536)
{}

PngChunk
PngChunks::Next()
{
  const std::string            size = std::to_string(m_Bytes.Size()) + " bytes";
  std::array<unsigned char, 8> head{};
  if (!m_Bytes.Holds(m_Offset, head.size()))
  {
    throw FileError(m_File, "truncated: " + size + " without the IEND chunk that ends a PNG file");
  }
  m_Bytes.Read(m_Offset, head.data(), head.size());
  PngChunk chunk{ std::string(head.begin() + 4, head.end()), m_Offset + 8, PngNumber(head.data()) };
  if (!std::all_of(head.begin() + 4, head.end(), IsLetter))
  {
    throw FileError(m_File,
                    "damaged: no chunk of PNG at byte " + std::to_string(m_Offset) +
                      "; expected a name of four letters there");
  }
  if (!m_Bytes.Holds(chunk.data, chunk.length + 4))
  {
    throw FileError(m_File,
                    "truncated: its chunk " + chunk.type + " of " + std::to_string(chunk.length) + " bytes from byte " +
                      std::to_string(chunk.data) + " on does not end in the file of " + size);
  }
  m_Offset = chunk.data + chunk.length + 4;
  return chunk;
}

void
PngChunks::Read(const PngChunk & chunk, const Sink & sink)
{
  uLong sum = crc32(0, reinterpret_cast<const unsigned char *>(chunk.type.data()), 4);
  for (std::uint64_t done = 0; done < chunk.length;)
  {
    const std::size_t count = static_cast<std::size_t>(std::min<std::uint64_t>(chunk.length - done, m_Buffer.size()));
    m_Bytes.Read(chunk.data + done, m_Buffer.data(), count);
    sum = crc32(sum, m_Buffer.data(), static_cast<uInt>(count));
    if (sink)
    {
      sink(m_Buffer.data(), count);
    }
    done += count;
  }
  std::array<unsigned char, 4> stored{};
  m_Bytes.Read(chunk.data + chunk.length, stored.data(), stored.size());
  if (PngNumber(stored.data()) != sum)
  {
    throw FileError(m_File,
                    "damaged: the checksum of its chunk " + chunk.type + " at byte " + std::to_string(chunk.data - 8) +
                      " is wrong");
  }
}

} // namespace sensornoise
