// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "files/TiffPage.h"

#include "sensornoise/FrameFile.h"
#include "files/Compression.h"

#include <algorithm>

namespace sensornoise
{
namespace
{
[[noreturn]] void
RefuseOverlap(const std::string & page, bool isTiled)
{
  throw FileError(page,
                  std::string("damaged: its ") + (isTiled ? "tiles" : "strips") +
                    " overlap, or lie in more places than can be checked");
}

/** Checks the bytes of one strip or tile of a page. */
class ChunkCheck
{
public:
  ChunkCheck(const std::string & page, const TiffPage & found, FileBytes & bytes, const TiffChunk & chunk)
    : m_Page(page)
    , m_Found(found)
    , m_Bytes(bytes)
    , m_Chunk(chunk)
  {}

  /** Throws FileError unless they stand for exactly the bytes of its rows. */
  void
  RequireRows()
  {
    switch (m_Found.compression)
    {
      case TiffCompression::None:
        return RequireBytes();
      case TiffCompression::Deflate:
        return RequireDeflated();
      case TiffCompression::PackBits:
        return RequirePackedRows();
      case TiffCompression::Lzw:
        return RequireLzw();
    }
  }

private:
  [[noreturn]] void
  Refuse(const std::string & what) const
  {
    throw FileError(m_Page, "damaged: " + m_Found.chunks.NameOf(m_Chunk.index) + " " + what);
  }

  void
  RequireBytes() const
  {
    // some writers fill the last strip up
    if (m_Chunk.count != m_Chunk.bytes && m_Chunk.count != m_Chunk.wholeBytes)
    {
      Refuse("has " + std::to_string(m_Chunk.count) + " bytes, but its rows have " + std::to_string(m_Chunk.bytes) +
             "; expected as many");
    }
  }

  void
  RequireDeflated()
  {
    Inflater inflater(InflateContainer::Zlib, m_Chunk.bytes);
    InflateFrom(m_Bytes, m_Chunk.offset, m_Chunk.count, inflater);
    if (inflater.IsWhole())
    {
      return;
    }
    // some writers fill the last strip up
    Inflater filledUp(InflateContainer::Zlib, m_Chunk.wholeBytes);
    if (m_Chunk.bytes < m_Chunk.wholeBytes)
    {
      InflateFrom(m_Bytes, m_Chunk.offset, m_Chunk.count, filledUp);
    }
    if (!filledUp.IsWhole())
    {
      Refuse("gives " + inflater.ReceivedBytes() + ", expected " + std::to_string(m_Chunk.bytes) +
             " bytes and the end of the stream");
    }
  }

  void
  RequireLzw()
  {
    const LzwResult found = DecodeLzw(m_Bytes, m_Chunk.offset, m_Chunk.count, m_Chunk.bytes, m_Chunk.wholeBytes);
    if (!found.error.empty() || (found.bytes != m_Chunk.bytes && found.bytes != m_Chunk.wholeBytes))
    {
      Refuse("gives " + (found.error.empty() ? std::to_string(found.bytes) + " bytes" : found.error) +
             " of LZW, expected " + std::to_string(m_Chunk.bytes) + " bytes");
    }
  }

  /** libtiff unpacks row by row, and drops what a run gives beyond the end of a row. */
  void
  RequirePackedRows()
  {
    const std::uint64_t rowBytes = m_Found.ChunkRowBytes();
    ByteReader          reader(m_Bytes, m_Chunk.offset, m_Chunk.offset + m_Chunk.count);
    for (std::uint64_t row = 0; row < m_Chunk.rows; ++row)
    {
      std::uint64_t found = 0;
      while (found < rowBytes)
      {
        const int code = reader.Next();
        if (code == 128)
        {
          continue;
        }
        const bool isLiteral = code < 128;
        int        left = isLiteral ? code + 1 : 1; // bytes that follow
        found += static_cast<std::uint64_t>(isLiteral ? code + 1 : 257 - code);
        bool isThere = code >= 0;
        for (; isThere && left > 0; --left)
        {
          isThere = reader.Next() >= 0;
        }
        if (!isThere || found > rowBytes)
        {
          Refuse((isThere ? "has a run beyond the end of row " : "ends within row ") + std::to_string(row) +
                 " of its PackBits; expected " + std::to_string(rowBytes) + " bytes a row");
        }
      }
    }
  }

  const std::string & m_Page;
  const TiffPage &    m_Found;
  FileBytes &         m_Bytes;
  const TiffChunk &   m_Chunk;
};
} // namespace

void
TiffStrips::AddDirectory(const std::string & page, const TiffDirectory & directory)
{
  m_DirectoryBytes += directory.bytes;
  m_HasSubDirectories = m_HasSubDirectories || directory.Find(330) != nullptr;
  bool isFew = m_DirectoryBytes <= m_Tiff.File().Size() && m_Ranges.AddTable(directory.offset, directory.bytes);
  for (const TiffEntry & entry : directory.entries)
  {
    isFew = isFew && (entry.inside || m_Ranges.AddTable(entry.offset, entry.count * SizeOfTiffType(entry.type)));
  }
  if (!isFew)
  {
    throw FileError(page, "damaged: its directories overlap, or their values lie in more places than can be checked");
  }
}

void
TiffStrips::CheckPage(const std::string & page, const TiffPage & found)
{
  TiffChunkList       chunks(m_Tiff, found.chunks, found.height, found.ChunkRowBytes());
  const std::uint64_t size = m_Tiff.File().Size();
  const std::uint64_t before = m_PixelBytes;
  for (std::uint64_t i = 0; i < found.chunks.Count(); ++i)
  {
    const TiffChunk chunk = chunks.Next();
    if (chunk.offset == 0 || chunk.count == 0 || !m_Tiff.File().Holds(chunk.offset, chunk.count))
    {
      throw FileError(page,
                      "truncated: " + found.chunks.NameOf(i) + " has " + std::to_string(chunk.count) +
                        " bytes from byte " + std::to_string(chunk.offset) + " on, but the file has " +
                        std::to_string(size));
    }
    m_PixelBytes += chunk.count;
    if (m_PixelBytes > size || !m_Ranges.AddPixels(chunk.offset, chunk.count))
    {
      RefuseOverlap(page, found.chunks.isTiled);
    }
    ChunkCheck(page, found, m_Tiff.File(), chunk).RequireRows();
  }
  m_Width = found.width;
  m_SmallestPage = std::min(m_SmallestPage, m_PixelBytes - before);
}

void
TiffStrips::AddPixels(const std::string & page, std::uint64_t offset, std::uint64_t count)
{
  if (!m_Ranges.AddPixels(offset, count))
  {
    RefuseOverlap(page, false);
  }
}

void
TiffStrips::RequireAllBytes(const std::string & file)
{
  m_Ranges.AddTable(0, m_Tiff.HeadBytes());
  if (const std::optional<std::uint64_t> conflict = m_Ranges.FirstConflict())
  {
    throw FileError(file,
                    "damaged: the byte " + std::to_string(*conflict) +
                      " belongs to two of its strips or tiles, or to one of them and a directory; expected each byte "
                      "to be read once");
  }
  if (m_HasSubDirectories)
  {
    return; // the pages of subdirectories may be anywhere
  }
  std::uint64_t unused = 0;
  bool          hasDirectory = false;
  for (const ByteRanges::Range & gap : m_Ranges.Gaps(m_Tiff.File().Size()))
  {
    unused += gap.second - gap.first;
    hasDirectory = hasDirectory || m_Tiff.HasEntry(gap.first, gap.second, 256, m_Width);
  }
  // Programs leave descriptions of their own, or a directory that they have written anew, but not both a directory and
  // pixels.
  if (hasDirectory && unused >= m_SmallestPage / 2)
  {
    throw FileError(file,
                    std::to_string(unused) +
                      " bytes belong to none of its pages, and there is a directory among them; expected a TIFF whose "
                      "pages are all in its chain of directories");
  }
}

} // namespace sensornoise
