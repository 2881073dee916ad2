// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "files/TiffStrips.h"

#include "sensornoise/FrameFile.h"
#include "files/Inflate.h"
#include "files/FrameSizes.h"
#include "files/CompressedStrips.h"

#include <algorithm>

namespace sensornoise
{
namespace
{
[[noreturn]] void
RefuseStrip(const std::string & page, std::uint64_t strip, const std::string & what)
{
  throw FileError(page, "damaged: its strip " + std::to_string(strip) + " " + what);
}

void
CheckDeflatedStrip(const std::string & page,
                   std::uint64_t       strip,
                   FileBytes &         bytes,
                   std::uint64_t       offset,
                   std::uint64_t       count,
                   std::uint64_t       expected,
                   std::uint64_t       wholeStrip)
{
  Inflater inflater(InflateContainer::Zlib, expected);
  InflateFrom(bytes, offset, count, inflater);
  if (inflater.IsWhole())
  {
    return;
  }
  // some writers fill the last strip up
  Inflater filledUp(InflateContainer::Zlib, wholeStrip);
  if (expected < wholeStrip)
  {
    InflateFrom(bytes, offset, count, filledUp);
  }
  if (!filledUp.IsWhole())
  {
    RefuseStrip(page,
                strip,
                "gives " + inflater.ReceivedBytes() + ", expected " + std::to_string(expected) +
                  " bytes and the end of the stream");
  }
}

void
CheckLzwStrip(const std::string & page,
              std::uint64_t       strip,
              FileBytes &         bytes,
              std::uint64_t       offset,
              std::uint64_t       count,
              std::uint64_t       expected,
              std::uint64_t       wholeStrip)
{
  const LzwLength found = LengthOfLzw(bytes, offset, count, expected, wholeStrip);
  if (!found.error.empty() || (found.bytes != expected && found.bytes != wholeStrip))
  {
    RefuseStrip(page,
                strip,
                "gives " + (found.error.empty() ? std::to_string(found.bytes) + " bytes" : found.error) +
                  " of LZW, expected " + std::to_string(expected) + " bytes");
  }
}

/** libtiff unpacks row by row, and drops what a run gives beyond the end of a row. */
void
CheckPackedStrip(const std::string & page,
                 std::uint64_t       strip,
                 FileBytes &         bytes,
                 std::uint64_t       offset,
                 std::uint64_t       count,
                 std::uint64_t       rows,
                 std::uint64_t       rowBytes)
{
  ByteReader reader(bytes, offset, offset + count);
  for (std::uint64_t row = 0; row < rows; ++row)
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
        RefuseStrip(page,
                    strip,
                    (isThere ? "has a run beyond the end of row " : "ends within row ") + std::to_string(row) +
                      " of its PackBits; expected " + std::to_string(rowBytes) + " bytes a row");
      }
    }
  }
}
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
  TiffBytes::Numbers  offsets(m_Tiff, found.offsets);
  TiffBytes::Numbers  counts(m_Tiff, found.byteCounts);
  const std::uint64_t size = m_Tiff.File().Size();
  const std::uint64_t before = m_PixelBytes;
  for (std::uint64_t strip = 0; strip < found.offsets.count; ++strip)
  {
    const std::uint64_t offset = offsets.Next();
    const std::uint64_t count = counts.Next();
    const std::string   name = "its strip " + std::to_string(strip) + " ";
    if (offset == 0 || count == 0 || !m_Tiff.File().Holds(offset, count))
    {
      throw FileError(page,
                      "truncated: " + name + "has " + std::to_string(count) + " bytes from byte " +
                        std::to_string(offset) + " on, but the file has " + std::to_string(size));
    }
    m_PixelBytes += count;
    if (m_PixelBytes > size || !m_Ranges.AddPixels(offset, count))
    {
      throw FileError(page, "damaged: its strips overlap, or lie in more places than can be checked");
    }
    const std::uint64_t rows = std::min(found.rowsPerStrip, found.height - strip * found.rowsPerStrip);
    CheckStrip(page, found, strip, rows, offset, count);
  }
  m_Width = found.width;
  m_SmallestPage = std::min(m_SmallestPage, m_PixelBytes - before);
}

void
TiffStrips::AddPixels(const std::string & page, std::uint64_t offset, std::uint64_t count)
{
  if (!m_Ranges.AddPixels(offset, count))
  {
    throw FileError(page, "damaged: its strips overlap, or lie in more places than can be checked");
  }
}

void
TiffStrips::CheckStrip(const std::string & page,
                       const TiffPage &    found,
                       std::uint64_t       strip,
                       std::uint64_t       rows,
                       std::uint64_t       offset,
                       std::uint64_t       count)
{
  const std::uint64_t rowBytes = found.width * SizeOf(found.pixel, found.stored);
  switch (found.compression)
  {
    case TiffCompression::None:
      // some writers fill the last strip up
      if (count != rows * rowBytes && count != found.rowsPerStrip * rowBytes)
      {
        RefuseStrip(page,
                    strip,
                    "has " + std::to_string(count) + " bytes, but its rows have " + std::to_string(rows * rowBytes) +
                      "; expected as many");
      }
      return;
    case TiffCompression::Deflate:
      CheckDeflatedStrip(page, strip, m_Tiff.File(), offset, count, rows * rowBytes, found.rowsPerStrip * rowBytes);
      return;
    case TiffCompression::PackBits:
      CheckPackedStrip(page, strip, m_Tiff.File(), offset, count, rows, rowBytes);
      return;
    case TiffCompression::Lzw:
      CheckLzwStrip(page, strip, m_Tiff.File(), offset, count, rows * rowBytes, found.rowsPerStrip * rowBytes);
      return;
  }
}

void
TiffStrips::RequireAllBytes(const std::string & file)
{
  m_Ranges.AddTable(0, m_Tiff.HeadBytes());
  if (const std::optional<std::uint64_t> conflict = m_Ranges.FirstConflict())
  {
    throw FileError(
      file,
      "damaged: the byte " + std::to_string(*conflict) +
        " belongs to two of its strips, or to a strip and a directory; expected each byte to be read once");
  }
  if (m_HasSubDirectories)
  {
    return; // whose pages may be anywhere
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
