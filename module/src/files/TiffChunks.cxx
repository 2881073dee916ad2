// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "files/TiffChunks.h"

#include <algorithm>

namespace sensornoise
{
namespace
{
/** Returns how many pieces of \a size, at least 1, cover \a length. */
std::uint64_t
CountPieces(std::uint64_t length, std::uint64_t size)
{
  return length / size + (length % size == 0 ? 0 : 1);
}
} // namespace

std::uint64_t
TiffChunks::RowsOf(std::uint64_t index, std::uint64_t imageHeight) const
{
  return isTiled ? rows : std::min(rows, imageHeight - index * rows);
}

std::string
TiffChunks::NameOf(std::uint64_t index) const
{
  return (isTiled ? "its tile " : "its strip ") + std::to_string(index);
}

TiffChunks
ReadTiffChunks(const TiffTags & tags, std::uint64_t width, std::uint64_t height)
{
  TiffChunks chunks;
  chunks.isTiled = tags.Has(322) || tags.Has(323) || tags.Has(324) || tags.Has(325);
  if (chunks.isTiled && (tags.Has(273) || tags.Has(279)))
  {
    tags.Refuse("damaged: has tags of strips and of tiles; expected one of both");
  }
  chunks.width = chunks.isTiled ? tags.Required(322, "TileWidth") : width;
  chunks.rows =
    chunks.isTiled ? tags.Required(323, "TileLength") : std::min(tags.Number(278, "RowsPerStrip", height), height);
  if (chunks.width == 0 || chunks.rows == 0)
  {
    tags.Refuse(chunks.isTiled ? "damaged: its tiles have a size of " + std::to_string(chunks.width) + " x " +
                                   std::to_string(chunks.rows) + " pixels; expected at least 1 x 1"
                               : "damaged: RowsPerStrip is 0; expected at least 1");
  }
  chunks.across = CountPieces(width, chunks.width);
  chunks.down = CountPieces(height, chunks.rows);
  return chunks;
}

void
FindTiffChunks(const TiffTags & tags, TiffChunks & chunks)
{
  const char * const piece = chunks.isTiled ? "tile" : "strip";
  chunks.offsets = chunks.isTiled ? tags.EntryOfEach(324, "TileOffsets", chunks.Count(), piece)
                                  : tags.EntryOfEach(273, "StripOffsets", chunks.Count(), piece);
  chunks.byteCounts = chunks.isTiled ? tags.EntryOfEach(325, "TileByteCounts", chunks.Count(), piece)
                                     : tags.EntryOfEach(279, "StripByteCounts", chunks.Count(), piece);
}

TiffChunk
TiffChunkList::Next()
{
  TiffChunk chunk;
  chunk.index = m_Next++;
  chunk.offset = m_Offsets.Next();
  chunk.count = m_Counts.Next();
  chunk.rows = m_Chunks.RowsOf(chunk.index, m_Height);
  chunk.bytes = chunk.rows * m_RowBytes;
  chunk.wholeBytes = m_Chunks.rows * m_RowBytes;
  return chunk;
}

} // namespace sensornoise
