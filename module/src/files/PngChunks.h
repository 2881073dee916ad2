// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_files_PngChunks_h
#define sensornoise_files_PngChunks_h

#include "files/FileBytes.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace sensornoise
{

/** Chunk of a PNG file. */
struct PngChunk
{
  std::string   type{};
  std::uint64_t data{ 0 };   // offset of the data [bytes]
  std::uint64_t length{ 0 }; // size of the data [bytes]
};

/** Reads the chunks of a PNG file one after the other. */
class PngChunks
{
public:
  using Sink = std::function<void(const unsigned char * bytes, std::size_t count)>;

  PngChunks(const std::string & file, FileBytes & bytes);

  /** Returns the next chunk, without its data. Throws FileError if its name is damaged, or if the file ends before the
   * chunk. */
  PngChunk
  Next();

  /** Reads the data of a chunk and gives it to \a sink, if there is one. Throws FileError if the checksum is wrong. */
  void
  Read(const PngChunk & chunk, const Sink & sink = {});

private:
  std::string                m_File;
  FileBytes &                m_Bytes;
  std::uint64_t              m_Offset{ 8 }; // offset of the next chunk [bytes]
  std::vector<unsigned char> m_Buffer;
};

/** Returns an unsigned number of four bytes, highest byte first. */
std::uint32_t
PngNumber(const unsigned char * bytes);

/** Rows of a grey PNG from its inflated stream: each is a byte with the filter, followed by the filtered bytes. */
class PngRows
{
public:
  /** Removes filters and interlacing from the rows into \a pixels, which has space for all pixels, with the highest
   * byte first. With null, the rows are only checked. */
  PngRows(std::size_t     width,
          std::size_t     height,
          std::size_t     bytesPerPixel,
          bool            interlaced,
          unsigned char * pixels = nullptr);

  /** Returns the size of all filtered rows [bytes]. */
  std::uint64_t
  Bytes() const
  {
    return m_Bytes;
  }

  /** Adds the next bytes, in pieces of any size. Bytes after the first Bytes() are ignored. */
  void
  Add(const unsigned char * bytes, std::size_t count);

  /** Returns the error of the first damaged row; "" if there is none. */
  const std::string &
  Error() const
  {
    return m_Error;
  }

private:
  /** Pixels of a pass of Adam7, or all pixels. */
  struct Pass
  {
    std::size_t x, y, stepX, stepY;
    std::size_t columns;
    std::size_t rows;
  };

  void
  EndRow();
  void
  PlaceRow(const Pass & pass);

  std::vector<Pass>          m_Passes;
  std::size_t                m_Width;
  std::size_t                m_BytesPerPixel;
  unsigned char *            m_Pixels;
  std::uint64_t              m_Bytes{ 0 };
  std::size_t                m_Pass{ 0 };
  std::size_t                m_Row{ 0 };
  std::size_t                m_Filled{ 0 }; // bytes of the row so far, with the filter
  unsigned char              m_Filter{ 0 };
  std::vector<unsigned char> m_Current; // only with m_Pixels
  std::vector<unsigned char> m_Previous;
  std::string                m_Error;
};

} // namespace sensornoise

#endif
