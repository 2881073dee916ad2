// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_files_TiffChunks_h
#define sensornoise_files_TiffChunks_h

#include "files/TiffDirectory.h"

#include <cstdint>
#include <string>

namespace sensornoise
{

/** The strips or the tiles that the image of a TIFF is divided into, in the order of the file: from left to right, then
 * downwards. Source: TIFF 6.0, sections 3 and 15. */
struct TiffChunks
{
  bool          isTiled{ false };
  std::uint64_t width{ 0 };   // of a strip or tile [pixels]
  std::uint64_t rows{ 0 };    // of a whole strip or tile
  std::uint64_t across{ 0 };  // number of tiles from left to right; 1 for strips
  std::uint64_t down{ 0 };    // number of strips or tiles from top to bottom
  TiffEntry     offsets{};    // place of each one in the file; set by FindTiffChunks()
  TiffEntry     byteCounts{}; // number of its bytes in the file; set by FindTiffChunks()

  /** Returns the number of strips or tiles. */
  std::uint64_t
  Count() const
  {
    return across * down;
  }

  /** Returns the number of rows that a strip or tile stores. A tile is whole at the edges of the image, too. The last
   * strip ends with the image, whose height is \a imageHeight. */
  std::uint64_t
  RowsOf(std::uint64_t index, std::uint64_t imageHeight) const;

  /** Returns the name of a strip or tile for messages: "its tile 3". */
  std::string
  NameOf(std::uint64_t index) const;
};

/** Reads how an image of \a width x \a height pixels, both at least 1, is divided. Throws FileError if the tags
 * describe strips and tiles at the same time, or a strip or tile without pixels. */
TiffChunks
ReadTiffChunks(const TiffTags & tags, std::uint64_t width, std::uint64_t height);

/** Sets where the strips or tiles are. Throws FileError unless the tags list exactly one place and one number of bytes
 * for each of them. */
void
FindTiffChunks(const TiffTags & tags, TiffChunks & chunks);

/** A strip or tile: its bytes in the file, and the bytes that they stand for. */
struct TiffChunk
{
  std::uint64_t index{ 0 };
  std::uint64_t offset{ 0 };     // in the file
  std::uint64_t count{ 0 };      // of bytes in the file
  std::uint64_t rows{ 0 };       // that it stores
  std::uint64_t bytes{ 0 };      // of these rows, without compression
  std::uint64_t wholeBytes{ 0 }; // the same where a writer has filled up the last strip
};

/** Lists the strips or tiles of an image in the order of the file. */
class TiffChunkList
{
public:
  /** \a rowBytes: bytes of a row of a strip or tile, without compression. \a chunks must live as long as this. */
  TiffChunkList(TiffBytes & tiff, const TiffChunks & chunks, std::uint64_t imageHeight, std::uint64_t rowBytes)
    : m_Chunks(chunks)
    , m_Height(imageHeight)
    , m_RowBytes(rowBytes)
    , m_Offsets(tiff, chunks.offsets)
    , m_Counts(tiff, chunks.byteCounts)
  {}

  /** Returns the next one. May be called as often as there are strips or tiles. */
  TiffChunk
  Next();

private:
  const TiffChunks & m_Chunks;
  std::uint64_t      m_Height;
  std::uint64_t      m_RowBytes;
  std::uint64_t      m_Next{ 0 };
  TiffBytes::Numbers m_Offsets;
  TiffBytes::Numbers m_Counts;
};

} // namespace sensornoise

#endif
