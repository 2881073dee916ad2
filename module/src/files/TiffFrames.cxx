// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "files/TiffPage.h"

#include "files/Compression.h"
#include "files/FileBytes.h"
#include "sensornoise/FrameFile.h"
#include "files/FrameReader.h"
#include "files/TiffDirectory.h"

#include <algorithm>
#include <cstring>

namespace sensornoise
{
namespace
{
/** Inflates as many bytes as the strip or tile has rows for; returns their number. */
std::size_t
InflateChunk(FileBytes & file, const TiffChunk & chunk, unsigned char * out)
{
  std::size_t done = 0;
  const auto  most = static_cast<std::size_t>(chunk.bytes);
  Inflater    inflater(InflateContainer::Zlib, chunk.wholeBytes, [&](const unsigned char * bytes, std::size_t count) {
    const std::size_t taken = std::min(count, most - done);
    std::memcpy(out + done, bytes, taken);
    done += taken;
  });
  InflateFrom(file, chunk.offset, chunk.count, inflater);
  return done;
}

/** Unpacks PackBits, in which no run goes beyond the end of a row. */
std::size_t
UnpackBits(FileBytes & file, const TiffChunk & chunk, unsigned char * out)
{
  ByteReader  reader(file, chunk.offset, chunk.offset + chunk.count);
  const auto  most = static_cast<std::size_t>(chunk.bytes);
  std::size_t done = 0;
  while (done < most)
  {
    const int code = reader.Next();
    if (code < 0)
    {
      return done;
    }
    if (code == 128)
    {
      continue;
    }
    const auto        length = static_cast<std::size_t>(code < 128 ? code + 1 : 257 - code);
    const std::size_t taken = std::min(length, most - done);
    int               byte = code < 128 ? 0 : reader.Next();
    for (std::size_t i = 0; i < taken; ++i)
    {
      byte = code < 128 ? reader.Next() : byte;
      out[done++] = static_cast<unsigned char>(byte);
    }
  }
  return done;
}

/** Writes the bytes of a strip or tile without compression to \a out; returns their number. */
std::size_t
UnpackChunk(FileBytes & file, TiffCompression compression, const TiffChunk & chunk, unsigned char * out)
{
  switch (compression)
  {
    case TiffCompression::Deflate:
      return InflateChunk(file, chunk, out);
    case TiffCompression::PackBits:
      return UnpackBits(file, chunk, out);
    case TiffCompression::Lzw:
      return static_cast<std::size_t>(
        std::min(DecodeLzw(file, chunk.offset, chunk.count, chunk.bytes, chunk.wholeBytes, out).bytes, chunk.bytes));
    default:
      file.Read(chunk.offset, out, static_cast<std::size_t>(chunk.bytes));
      return static_cast<std::size_t>(chunk.bytes);
  }
}

template <typename T>
void
AddUp(void * row, std::size_t width)
{
  for (std::size_t x = 1; x < width; ++x)
  {
    T before;
    T value;
    std::memcpy(&before, static_cast<char *>(row) + (x - 1) * sizeof(T), sizeof(T));
    std::memcpy(&value, static_cast<char *>(row) + x * sizeof(T), sizeof(T));
    value = static_cast<T>(value + before);
    std::memcpy(static_cast<char *>(row) + x * sizeof(T), &value, sizeof(T));
  }
}

/** Predictor 2: each sample is the difference to that before it. */
void
UndoDifferences(void * row, std::size_t width, std::size_t bytesOfPixel)
{
  switch (bytesOfPixel)
  {
    case 1:
      AddUp<std::uint8_t>(row, width);
      return;
    case 2:
      AddUp<std::uint16_t>(row, width);
      return;
    case 4:
      AddUp<std::uint32_t>(row, width);
      return;
    default:
      AddUp<std::uint64_t>(row, width);
  }
}

/** Predictor 3: the highest bytes of all samples, then the next, and of these the differences. Adobe Photoshop TIFF
 * Technical Note 3. */
void
UndoFloatDifferences(unsigned char * row, std::size_t width, std::size_t bytesOfPixel, std::vector<unsigned char> & by)
{
  AddUp<std::uint8_t>(row, width * bytesOfPixel);
  by.assign(row, row + width * bytesOfPixel);
  for (std::size_t x = 0; x < width; ++x)
  {
    for (std::size_t byte = 0; byte < bytesOfPixel; ++byte)
    {
      row[x * bytesOfPixel + byte] = by[byte * width + x];
    }
  }
  ToOwnByteOrder(true, bytesOfPixel, width, row);
}

/** Makes pixels of the bytes of rows of a strip or tile, in place. */
void
MakePixels(const TiffPage & page, bool isBigEndian, std::size_t rows, unsigned char * pixels)
{
  const auto        width = static_cast<std::size_t>(page.chunks.width);
  const std::size_t size = SizeOf(page.pixel, page.stored);
  if (page.predictor != 3)
  {
    ToOwnByteOrder(isBigEndian, size, rows * width, pixels);
  }
  std::vector<unsigned char> bytes;
  for (std::size_t row = 0; row < rows && page.predictor != 1; ++row)
  {
    unsigned char * const first = pixels + row * width * size;
    if (page.predictor == 2)
    {
      UndoDifferences(first, width, size);
    }
    else
    {
      UndoFloatDifferences(first, width, size, bytes);
    }
  }
  ConvertStored(page.stored, rows * width, pixels);
}

/** Copies the pixels of a tile into its place in the frame, without what fills it up at the edges. */
void
CopyTile(const TiffPage & page, std::uint64_t index, const unsigned char * tile, unsigned char * frame)
{
  const std::size_t   size = SizeOf(page.pixel);
  const std::uint64_t left = index % page.chunks.across * page.chunks.width;
  const std::uint64_t top = index / page.chunks.across * page.chunks.rows;
  const auto          columns = static_cast<std::size_t>(std::min(page.chunks.width, page.width - left));
  const auto          rows = static_cast<std::size_t>(std::min(page.chunks.rows, page.height - top));
  const auto          tileRowBytes = static_cast<std::size_t>(page.chunks.width) * size;
  const auto          frameRowBytes = static_cast<std::size_t>(page.width) * size;
  unsigned char * to = frame + static_cast<std::size_t>(top) * frameRowBytes + static_cast<std::size_t>(left) * size;
  for (std::size_t row = 0; row < rows; ++row)
  {
    std::memcpy(to, tile + row * tileRowBytes, columns * size);
    to += frameRowBytes;
  }
}

/** Reads the pixels of a page. Throws FileError if the page differs from the page that was inspected. */
void
ReadPage(const FrameFile & file, TiffBytes & tiff, std::uint64_t directory, unsigned char * pixels)
{
  const TiffPage page = ReadTiffPage(file.name, tiff, tiff.ReadDirectory(file.name, directory));
  if (page.width != file.width || page.height != file.height || page.pixel != file.pixel || page.stored != file.stored)
  {
    throw FileError(file.name, "the size or type of a page has changed since it was opened; expected the same");
  }
  const std::size_t          rowPixelBytes = file.width * SizeOf(file.pixel);
  const TiffChunks &         chunks = page.chunks;
  TiffChunkList              list(tiff, chunks, page.height, page.ChunkRowBytes());
  std::vector<unsigned char> tile(
    chunks.isTiled ? static_cast<std::size_t>(chunks.width * chunks.rows) * SizeOf(file.pixel) : 0);
  for (std::uint64_t i = 0; i < chunks.Count(); ++i)
  {
    const TiffChunk       chunk = list.Next();
    unsigned char * const to =
      chunks.isTiled ? tile.data() : pixels + static_cast<std::size_t>(i * chunks.rows) * rowPixelBytes;
    if (UnpackChunk(tiff.File(), page.compression, chunk, to) != chunk.bytes)
    {
      throw FileError(file.name, "a strip or tile of a page has changed since it was opened; expected the same");
    }
    MakePixels(page, tiff.IsBigEndian(), static_cast<std::size_t>(chunk.rows), to);
    if (chunks.isTiled)
    {
      CopyTile(page, i, to, pixels);
    }
  }
}
} // namespace

void
TiffFrames::Read(const FrameFile & file, std::size_t first, std::size_t count, void * buffer) const
{
  FileBytes         bytes(file.name);
  TiffBytes         tiff(file.name, bytes);
  const std::size_t frameBytes = file.width * file.height * SizeOf(file.pixel);
  for (std::size_t i = 0; i < count; ++i)
  {
    ReadPage(file, tiff, m_Directories.at(first + i), static_cast<unsigned char *>(buffer) + i * frameBytes);
  }
}

} // namespace sensornoise
