// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "files/TiffFrames.h"

#include "files/FileBytes.h"
#include "sensornoise/FrameFile.h"
#include "files/Inflate.h"
#include "files/FrameReader.h"
#include "files/FrameSizes.h"
#include "files/TiffDirectory.h"
#include "files/CompressedStrips.h"
#include "files/TiffPage.h"

#include <algorithm>
#include <cstring>
#include <string>

namespace sensornoise
{
namespace
{
/** Where a strip is, and the bytes that it gives. */
struct TiffStrip
{
  std::uint64_t offset{ 0 };
  std::uint64_t count{ 0 };
  std::size_t   bytes{ 0 };
  std::size_t   wholeBytes{ 0 }; // where a writer has filled it up
};

/** Inflates as many bytes as the strip has rows for; returns their number. */
std::size_t
InflateStrip(FileBytes & file, const TiffStrip & strip, unsigned char * out)
{
  std::size_t done = 0;
  Inflater    inflater(InflateContainer::Zlib, strip.wholeBytes, [&](const unsigned char * bytes, std::size_t count) {
    const std::size_t taken = std::min(count, strip.bytes - done);
    std::memcpy(out + done, bytes, taken);
    done += taken;
  });
  InflateFrom(file, strip.offset, strip.count, inflater);
  return done;
}

/** Unpacks PackBits, in which no run goes beyond the end of a row. */
std::size_t
UnpackBits(FileBytes & file, const TiffStrip & strip, unsigned char * out)
{
  ByteReader  reader(file, strip.offset, strip.offset + strip.count);
  std::size_t done = 0;
  while (done < strip.bytes)
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
    const std::size_t taken = std::min(length, strip.bytes - done);
    int               byte = code < 128 ? 0 : reader.Next();
    for (std::size_t i = 0; i < taken; ++i)
    {
      byte = code < 128 ? reader.Next() : byte;
      out[done++] = static_cast<unsigned char>(byte);
    }
  }
  return done;
}

/** The bytes of a strip without compression; returns their number. */
std::size_t
UnpackStrip(FileBytes & file, TiffCompression compression, const TiffStrip & strip, unsigned char * out)
{
  switch (compression)
  {
    case TiffCompression::Deflate:
      return InflateStrip(file, strip, out);
    case TiffCompression::PackBits:
      return UnpackBits(file, strip, out);
    case TiffCompression::Lzw:
      return static_cast<std::size_t>(std::min<std::uint64_t>(
        LengthOfLzw(file, strip.offset, strip.count, strip.bytes, strip.wholeBytes, out).bytes, strip.bytes));
    default:
      file.Read(strip.offset, out, strip.bytes);
      return strip.bytes;
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

/** Makes pixels of the bytes of rows. */
void
MakePixels(const TiffPage & page, bool isBigEndian, std::size_t rows, unsigned char * pixels)
{
  const auto        width = static_cast<std::size_t>(page.width);
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

void
TurnUpsideDown(std::size_t rowBytes, std::size_t rows, unsigned char * pixels)
{
  for (std::size_t row = 0; row < rows / 2; ++row)
  {
    std::swap_ranges(pixels + row * rowBytes, pixels + (row + 1) * rowBytes, pixels + (rows - 1 - row) * rowBytes);
  }
}

/** Throws FileError unless it is what was inspected. */
void
ReadPage(const FrameFile & file, TiffBytes & tiff, std::uint64_t directory, unsigned char * pixels)
{
  const TiffPage page = ReadTiffPage(file.name, tiff, tiff.ReadDirectory(file.name, directory));
  if (page.width != file.width || page.height != file.height || page.pixel != file.pixel || page.stored != file.stored)
  {
    throw FileError(file.name, "the size or type of a page has changed since it was opened; expected the same");
  }
  const std::size_t  rowBytes = file.width * SizeOf(file.pixel, file.stored); // in the file
  const std::size_t  rowPixelBytes = file.width * SizeOf(file.pixel);
  TiffBytes::Numbers offsets(tiff, page.offsets);
  TiffBytes::Numbers counts(tiff, page.byteCounts);
  for (std::uint64_t first = 0; first < page.height; first += page.rowsPerStrip)
  {
    const auto rows = static_cast<std::size_t>(std::min(page.rowsPerStrip, page.height - first));
    TiffStrip  strip;
    strip.offset = offsets.Next();
    strip.count = counts.Next();
    strip.bytes = rows * rowBytes;
    strip.wholeBytes = static_cast<std::size_t>(page.rowsPerStrip) * rowBytes;
    unsigned char * const to = pixels + first * rowPixelBytes;
    if (UnpackStrip(tiff.File(), page.compression, strip, to) != strip.bytes)
    {
      throw FileError(file.name, "a strip of a page has changed since it was opened; expected the same");
    }
    MakePixels(page, tiff.IsBigEndian(), rows, to);
  }
  if (page.orientation == 4)
  {
    TurnUpsideDown(rowPixelBytes, file.height, pixels);
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
