// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "files/RawCameraFile.h"

#include "files/FileBytes.h"
#include "sensornoise/FrameFile.h"
#include "files/Compression.h"
#include "files/TiffPage.h"
#include "files/TiffDirectory.h"

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

namespace sensornoise
{
namespace
{
constexpr std::size_t   MaximumDirectories = 64;
constexpr std::uint64_t Mosaic = 32803;    // value of PhotometricInterpretation
constexpr std::uint64_t LinearRaw = 34892; // another value of PhotometricInterpretation
constexpr std::uint64_t LossyJpeg = 34892; // value of Compression
constexpr std::uint64_t MaximumChunks = 1U << 20;

/** The directories below one: SubIFDs. */
std::vector<std::uint64_t>
DirectoriesBelow(TiffBytes & tiff, const TiffDirectory & directory)
{
  std::vector<std::uint64_t> offsets;
  const TiffEntry * const    entry = directory.Find(330);
  if (entry != nullptr && (entry->type == 4 || entry->type == 13 || entry->type == 16 || entry->type == 18))
  {
    TiffBytes::Numbers numbers(tiff, *entry);
    for (std::uint64_t i = 0; i < std::min<std::uint64_t>(entry->count, MaximumDirectories); ++i)
    {
      offsets.push_back(numbers.Next());
    }
  }
  return offsets;
}

/** Returns all directories, of the chain and below it; at least one. Throws for the first directory only: directories
 * of previews of some makers are not valid. */
std::vector<TiffDirectory>
AllDirectories(const std::string & file, TiffBytes & tiff)
{
  std::vector<TiffDirectory> found;
  std::vector<std::uint64_t> waiting{ tiff.FirstDirectory() };
  for (std::size_t i = 0; i < waiting.size() && found.size() < MaximumDirectories; ++i)
  {
    if (waiting[i] == 0 || std::find(waiting.begin(), waiting.begin() + static_cast<std::ptrdiff_t>(i), waiting[i]) !=
                             waiting.begin() + static_cast<std::ptrdiff_t>(i))
    {
      continue;
    }
    try
    {
      found.push_back(tiff.ReadDirectory(file, waiting[i]));
    }
    catch (const FileError &)
    {
      if (found.empty())
      {
        throw;
      }
      continue;
    }
    for (const std::uint64_t offset : DirectoriesBelow(tiff, found.back()))
    {
      waiting.push_back(offset);
    }
    waiting.push_back(found.back().next);
  }
  if (found.empty())
  {
    throw FileError(file, "damaged: its first directory is at byte 0, as if it had none; expected it behind the head");
  }
  return found;
}

/** A strip or a tile: bytes of a file. */
struct RawChunk
{
  std::uint64_t offset{ 0 };
  std::uint64_t bytes{ 0 };
};

/** The strips or tiles that a directory lists; none where it lists none. */
std::vector<RawChunk>
ChunksOf(const std::string & file, TiffBytes & tiff, const TiffDirectory & directory)
{
  const bool              isTiled = directory.Find(324) != nullptr;
  const TiffEntry * const offsets = directory.Find(isTiled ? 324 : 273);
  const TiffEntry * const counts = directory.Find(isTiled ? 325 : 279);
  std::vector<RawChunk>   chunks;
  if (offsets == nullptr || counts == nullptr)
  {
    return chunks;
  }
  if (offsets->count != counts->count || offsets->count > MaximumChunks)
  {
    throw FileError(file,
                    "damaged: lists " + std::to_string(offsets->count) + " places of pixels, but " +
                      std::to_string(counts->count) + " numbers of bytes; expected one for each");
  }
  TiffBytes::Numbers offset(tiff, *offsets);
  TiffBytes::Numbers count(tiff, *counts);
  for (std::uint64_t i = 0; i < offsets->count; ++i)
  {
    const std::uint64_t at = offset.Next();
    const std::uint64_t bytes = count.Next();
    if (!tiff.File().Holds(at, bytes))
    {
      throw FileError(file,
                      "truncated: has " + std::to_string(tiff.File().Size()) + " bytes; expected " +
                        std::to_string(bytes) + " bytes of its pixels from byte " + std::to_string(at) + " on");
    }
    chunks.push_back({ at, bytes });
  }
  return chunks;
}

/** Checks the digital numbers that a DNG declares: whether all of them are in the file. */
class DngImage
{
public:
  DngImage(const std::string & file, TiffBytes & tiff, const TiffDirectory & directory)
    : m_File(file)
    , m_Tiff(tiff)
    , m_Directory(directory)
    , m_Tags(m_File, tiff, directory)
    , m_Width(m_Tags.Required(256, "ImageWidth"))
    , m_Height(m_Tags.Required(257, "ImageLength"))
    , m_Compression(m_Tags.Number(259, "Compression", 1))
    , m_Bits(m_Tags.Number(258, "BitsPerSample", 1))
  {}

  void
  RequireWhole()
  {
    RequireStructureOnce();
    RequireIntegers();
    const TiffChunks layout = ReadTiffChunks(m_Tags, m_Width, m_Height);
    if (layout.width > 65535 || layout.rows > 65535)
    {
      m_Tags.Refuse("damaged: its strips or tiles have a size of " + std::to_string(layout.width) + " x " +
                    std::to_string(layout.rows) + " pixels; expected 1 to 65535");
    }
    const std::vector<RawChunk> chunks = ChunksOf(m_File, m_Tiff, m_Directory);
    if (chunks.size() != layout.Count())
    {
      m_Tags.Refuse("damaged: its pixels are in " + std::to_string(chunks.size()) + " strips or tiles; expected " +
                    std::to_string(layout.Count()));
    }
    for (std::uint64_t i = 0; i < chunks.size(); ++i)
    {
      const std::uint64_t rows = layout.RowsOf(i, m_Height);
      m_Compression == 7 ? RequireJpeg(chunks[i], i, layout.width * rows)
                         : RequireRows(chunks[i], i, layout.width, rows);
      // LibRaw reads uncompressed strips as one
      if (m_Compression == 1 && !layout.isTiled && i > 0 &&
          chunks[i].offset != chunks[i - 1].offset + chunks[i - 1].bytes)
      {
        m_Tags.Refuse("its strip " + std::to_string(i) +
                      " does not follow the strip before; expected uncompressed digital numbers in one piece");
      }
    }
  }

private:
  /** PiDNG writes its version twice. Only the tags with the place and the coding of the pixels have to be there once.
   */
  void
  RequireStructureOnce() const
  {
    for (const unsigned tag : { 256U, 257U, 258U, 259U, 262U, 273U, 277U, 278U, 279U, 322U, 323U, 324U, 325U })
    {
      const auto & entries = m_Directory.entries;
      if (std::count_if(entries.begin(), entries.end(), [tag](const TiffEntry & e) { return e.tag == tag; }) > 1)
      {
        m_Tags.Refuse("damaged: its tag " + std::to_string(tag) + " comes twice; expected each once");
      }
    }
  }

  /** Throws FileError unless the pixels are whole numbers, one for each pixel, stored without loss. */
  void
  RequireIntegers() const
  {
    const std::uint64_t samples = m_Tags.Number(277, "SamplesPerPixel", 1);
    if (m_Compression == LossyJpeg)
    {
      m_Tags.Refuse("compressed with loss, as JPEG; expected digital numbers as the sensor gave them");
    }
    if (m_Compression != 1 && m_Compression != 7)
    {
      m_Tags.Refuse("compressed in a way (" + std::to_string(m_Compression) +
                    ") that cannot be checked; expected uncompressed digital numbers or JPEG without loss");
    }
    if (samples != 1)
    {
      m_Tags.Refuse(std::to_string(samples) + " colours a pixel; expected one, as a sensor gives it");
    }
    if (m_Tags.Number(339, "SampleFormat", 1) != 1 || m_Bits < 8 || m_Bits > 16)
    {
      m_Tags.Refuse("digital numbers of " + std::to_string(m_Bits) + " bits, or not whole ones; expected 8 to 16 bits");
    }
    if (m_Tags.Has(50712))
    {
      m_Tags.Refuse("its digital numbers were rounded through a table (LinearizationTable), which is a loss; expected "
                    "the numbers as "
                    "the sensor gave them");
    }
  }

  void
  RequireJpeg(const RawChunk & chunk, std::uint64_t index, std::uint64_t expected) const
  {
    const std::string   piece = m_File + ", strip or tile " + std::to_string(index);
    const std::uint64_t found = SamplesOfLosslessJpeg(piece, m_Tiff.File(), chunk.offset, chunk.bytes);
    if (found != expected)
    {
      throw FileError(piece,
                      "damaged: its JPEG has " + std::to_string(found) + " digital numbers; expected " +
                        std::to_string(expected));
    }
  }

  void
  RequireRows(const RawChunk & chunk, std::uint64_t index, std::uint64_t across, std::uint64_t rows) const
  {
    const std::uint64_t rowBytes = (across * m_Bits + 7) / 8;
    const std::uint64_t expected = rowBytes * rows;
    if (chunk.bytes < expected || chunk.bytes - expected >= rowBytes)
    {
      m_Tags.Refuse("damaged: its strip or tile " + std::to_string(index) + " has " + std::to_string(chunk.bytes) +
                    " bytes; expected " + std::to_string(expected) + " for its digital numbers of " +
                    std::to_string(m_Bits) + " bits");
    }
  }

  const std::string &   m_File;
  TiffBytes &           m_Tiff;
  const TiffDirectory & m_Directory;
  TiffTags              m_Tags;
  std::uint64_t         m_Width;
  std::uint64_t         m_Height;
  std::uint64_t         m_Compression;
  std::uint64_t         m_Bits;
};

/** Throws FileError if bytes would be read as pixels twice, or belong to a directory. */
void
RequireApart(const std::string & file, const std::vector<RawChunk> & chunks, const std::vector<TiffDirectory> & all)
{
  ByteRanges ranges;
  bool       areFew = ranges.AddTable(0, 8);
  for (const TiffDirectory & directory : all)
  {
    areFew = ranges.AddTable(directory.offset, directory.bytes) && areFew;
  }
  for (const RawChunk & chunk : chunks)
  {
    areFew = ranges.AddPixels(chunk.offset, chunk.bytes) && areFew;
  }
  const std::optional<std::uint64_t> twice = ranges.FirstConflict();
  if (!areFew || twice)
  {
    throw FileError(file,
                    areFew ? "damaged: its byte " + std::to_string(*twice) +
                               " holds pixels twice, or pixels and something else; expected it once"
                           : "its pixels are in too many pieces to be checked");
  }
}

bool
IsRawImage(const std::string & file, TiffBytes & tiff, const TiffDirectory & directory)
{
  const std::uint64_t kind = tiff.Number(file, directory, 262, "PhotometricInterpretation").value_or(65536);
  return kind == Mosaic || kind == LinearRaw;
}
} // namespace

RawTiffKind
RawTiffKindOf(const std::string & file, FileBytes & bytes)
{
  TiffBytes           tiff(file, bytes);
  const TiffDirectory first = tiff.ReadDirectory(file, tiff.FirstDirectory());
  if (first.Find(50706) != nullptr)
  {
    return RawTiffKind::Dng;
  }
  if (IsRawImage(file, tiff, first))
  {
    return RawTiffKind::Mosaic;
  }
  for (const std::uint64_t offset : DirectoriesBelow(tiff, first))
  {
    if (IsRawImage(file, tiff, tiff.ReadDirectory(file, offset)))
    {
      return RawTiffKind::Mosaic;
    }
  }
  return RawTiffKind::None;
}

void
RequireWholeRawTiff(const std::string & file, FileBytes & bytes, std::uint64_t width, std::uint64_t height)
{
  unsigned char head[4] = {};
  if (!TiffBytes::IsTiff(head, bytes.ReadSome(0, head, sizeof(head))))
  {
    return;
  }
  TiffBytes                        tiff(file, bytes);
  const std::vector<TiffDirectory> directories = AllDirectories(file, tiff);
  const bool                       isDng = directories.front().Find(50706) != nullptr;
  bool                             isFound = false;
  for (const TiffDirectory & directory : directories)
  {
    if (isDng && IsRawImage(file, tiff, directory) && tiff.Number(file, directory, 256, "ImageWidth") == width &&
        tiff.Number(file, directory, 257, "ImageLength") == height)
    {
      RequireApart(file, ChunksOf(file, tiff, directory), directories); // each byte is then decoded once
      DngImage(file, tiff, directory).RequireWhole();
      isFound = true;
    }
    else if (!isDng)
    {
      ChunksOf(file, tiff, directory);
    }
  }
  if (isDng && !isFound)
  {
    throw FileError(file,
                    "LibRaw would read " + std::to_string(width) + " x " + std::to_string(height) +
                      " pixels; expected an image of this size in one of its directories");
  }
}

} // namespace sensornoise
