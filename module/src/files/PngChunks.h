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

/** A chunk of a PNG file. */
struct PngChunk
{
  std::string   type{};
  std::uint64_t data{ 0 };   // where its data begins
  std::uint64_t length{ 0 }; // of its data
};

/** Reads the chunks of a PNG file, one after the other. */
class PngChunks
{
public:
  using Sink = std::function<void(const unsigned char * bytes, std::size_t count)>;

  PngChunks(const std::string & file, FileBytes & bytes);

  /** The head of the next chunk. Throws FileError where the file ends before the chunk does. */
  PngChunk
  Next();

  /** Reads the data of a chunk, which goes to \a sink, where there is one. Throws FileError if its checksum is wrong.
   */
  void
  Read(const PngChunk & chunk, const Sink & sink = {});

private:
  std::string                m_File;
  FileBytes &                m_Bytes;
  std::uint64_t              m_Offset{ 8 }; // of the next chunk
  std::vector<unsigned char> m_Buffer;
};

/** A number of four bytes, the highest first, as PNG has them. */
std::uint32_t
PngNumber(const unsigned char * bytes);

/** The rows of a grey PNG, as they come out of its inflated stream: a byte that names the filter, then the filtered
 * bytes. */
class PngRows
{
public:
  /** Undoes filters and interlacing into \a pixels, which has room for all pixels, with the highest byte first; null:
   * the rows are checked alone. */
  PngRows(std::size_t     width,
          std::size_t     height,
          std::size_t     bytesPerPixel,
          bool            interlaced,
          unsigned char * pixels = nullptr);

  /** The bytes of all rows together. */
  std::uint64_t
  Bytes() const
  {
    return m_Bytes;
  }

  /** The next bytes, which come in pieces of any size. Not more than Bytes() in all. */
  void
  Add(const unsigned char * bytes, std::size_t count);

  /** Empty while all is well, else what is wrong with a row. */
  const std::string &
  Error() const
  {
    return m_Error;
  }

private:
  /** The pixels of a pass of Adam7, or all of them. */
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
  std::size_t                m_Filled{ 0 }; // bytes of the row that have come, with the filter
  unsigned char              m_Filter{ 0 };
  std::vector<unsigned char> m_Current; // only where there are m_Pixels
  std::vector<unsigned char> m_Previous;
  std::string                m_Error;
};

} // namespace sensornoise

#endif
