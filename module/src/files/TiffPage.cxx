// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "files/TiffPage.h"

#include "files/FrameReader.h"

#include <algorithm>
#include <optional>

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

namespace
{
// A tile of 4096 x 4096 pixels of 8 bytes: chosen empirically, above the tiles that programs write. A reader holds one.
constexpr std::uint64_t MaximumTileBytes = std::uint64_t{ 1 } << 27;
// Tiles are filled up at the right and at the bottom. Where a frame is not smaller than a tile, the tiles have fewer
// than twice its columns and twice its rows.
constexpr std::uint64_t MaximumFilling = 4;
// A frame may be smaller than its one tile. Writers choose 256 x 256 (libtiff, GDAL) or 512 x 512 pixels
// (cloud-optimized GeoTIFF) by default; this is a tile of 1024 x 1024.
constexpr std::uint64_t MaximumExtraPixels = std::uint64_t{ 1 } << 20;

void
RequireGrey(const TiffTags & tags)
{
  const std::uint64_t samples = tags.Number(277, "SamplesPerPixel", 1);
  const std::uint64_t photometric = tags.Number(262, "PhotometricInterpretation", 65536);
  if (photometric == 3)
  {
    tags.Refuse("1 component a pixel with a palette of colours; expected 1 grey value");
  }
  if (samples != 1)
  {
    tags.Refuse(SeveralComponents(samples));
  }
  if (photometric > 1)
  {
    tags.Refuse(photometric == 65536
                  ? "has no tag 262 (PhotometricInterpretation); expected grey values, 0 or 1"
                  : "the photometric interpretation " + std::to_string(photometric) + "; expected grey values, 0 or 1");
  }
}

/** Throws for samples whose order programs do not agree about. */
void
RequirePlainOrder(const TiffTags & tags)
{
  if (const std::uint64_t order = tags.Number(266, "FillOrder", 1); order != 1)
  {
    tags.Refuse("FillOrder is " + std::to_string(order) + "; expected 1");
  }
  if (const std::uint64_t depth = tags.Number(32997, "ImageDepth", 1); depth != 1)
  {
    tags.Refuse("ImageDepth is " + std::to_string(depth) + "; expected 1, and a page for each frame");
  }
}

void
ReadPixelType(const TiffTags & tags, TiffPage & page)
{
  const std::uint64_t bits = tags.Number(258, "BitsPerSample", 1);
  const std::uint64_t format = tags.Number(339, "SampleFormat", 1);
  struct KnownType
  {
    std::uint64_t bits;
    std::uint64_t format;
    FramePixel    pixel;
    StoredNumber  stored;
  };
  constexpr StoredNumber                    same = StoredNumber::SameAsPixel;
  static constexpr std::array<KnownType, 7> types{ { { 8, 1, FramePixel::UnsignedChar, same },
                                                     { 16, 1, FramePixel::UnsignedShort, same },
                                                     { 16, 2, FramePixel::Short, same },
                                                     { 32, 1, FramePixel::Double, StoredNumber::UnsignedInt },
                                                     { 32, 2, FramePixel::Double, StoredNumber::Int },
                                                     { 32, 3, FramePixel::Float, same },
                                                     { 64, 3, FramePixel::Double, same } } };
  for (const KnownType & known : types)
  {
    if (bits == known.bits && format == known.format)
    {
      page.pixel = known.pixel;
      page.stored = known.stored;
      return;
    }
  }
  const std::string kind = format == 1   ? "unsigned"
                           : format == 2 ? "signed"
                           : format == 3 ? "floating-point"
                                         : "format " + std::to_string(format);
  tags.Refuse(
    std::to_string(bits) + "-bit " + kind +
    " samples, which are not supported; expected 8-bit unsigned, 16-bit or 32-bit integers, or 32-bit or 64-bit "
    "floating-point samples, the same on all pages");
}

TiffCompression
CompressionOf(const TiffTags & tags)
{
  const std::uint64_t compression = tags.Number(259, "Compression", 1);
  std::string         name;
  switch (compression)
  {
    case 1:
      return TiffCompression::None;
    case 5:
      return TiffCompression::Lzw;
    case 8:
    case 32946:
      return TiffCompression::Deflate;
    case 32773:
      return TiffCompression::PackBits;
    case 6:
    case 7:
      name = "JPEG, which changes the noise";
      break;
    case 50001:
      name = "WebP, which cannot be checked";
      break;
    case 34712:
      name = "JPEG 2000, which cannot be checked";
      break;
    case 34925:
      name = "LZMA, which cannot be checked";
      break;
    case 50000:
      name = "Zstandard, which cannot be checked";
      break;
    default:
      name = "method " + std::to_string(compression) + ", which cannot be checked";
  }
  tags.Refuse("compressed by " + name + "; expected no compression, deflate, LZW or PackBits");
}

void
ReadPredictor(const TiffTags & tags, TiffPage & page)
{
  const std::uint64_t predictor = tags.Number(317, "Predictor", 1);
  const bool          isUsed = page.compression == TiffCompression::Lzw || page.compression == TiffCompression::Deflate;
  const bool          isFloat =
    page.stored == StoredNumber::SameAsPixel && (page.pixel == FramePixel::Float || page.pixel == FramePixel::Double);
  if (isUsed && predictor != 1 && predictor != (isFloat ? 3U : 2U) && !(isFloat && predictor == 2))
  {
    tags.Refuse("Predictor is " + std::to_string(predictor) + "; expected 1 or " + (isFloat ? "3" : "2"));
  }
  page.predictor = isUsed ? predictor : 1;
}

void
ReadSubfileType(const TiffTags & tags, TiffPage & page)
{
  const std::uint64_t type = tags.Number(254, "NewSubfileType", 0);
  const std::uint64_t oldType = tags.Number(255, "SubfileType", 1);
  page.isReduced = (type & 5) != 0 || oldType == 2;
}

/** Throws FileError for tiles that need memory and time out of proportion to the frame, whose pixels fit into 64 bits.
 */
void
RequireSizeOfTiles(const TiffTags & tags, const TiffPage & page)
{
  if (!page.chunks.isTiled)
  {
    return;
  }
  const std::string tiles = "its tiles have a size of " + std::to_string(page.chunks.width) + " x " +
                            std::to_string(page.chunks.rows) + " pixels";
  const std::optional<std::uint64_t> pixels = CheckedProduct(page.chunks.width, page.chunks.rows);
  if (!pixels || *pixels > MaximumTileBytes / SizeOf(page.pixel))
  {
    tags.Refuse(tiles + "; expected at most " + std::to_string(MaximumTileBytes / SizeOf(page.pixel)) + " pixels");
  }
  const std::optional<std::uint64_t> all = CheckedProduct(*pixels, page.chunks.Count());
  const std::uint64_t                frame = page.width * page.height;
  if (!all || (*all > MaximumExtraPixels && (*all - MaximumExtraPixels - 1) / MaximumFilling >= frame))
  {
    tags.Refuse(tiles + ", far above a frame of " + std::to_string(page.width) + " x " + std::to_string(page.height) +
                "; expected at most " + std::to_string(MaximumFilling) + " times the pixels of the frame, and " +
                std::to_string(MaximumExtraPixels) + " more, in all tiles together");
  }
}

/** Returns the spacing of the pixels as ITK's reader does: from the resolution, in pixels per inch or per centimetre,
 * if the file declares its unit [mm]. */
std::array<double, 2>
SpacingOf(const TiffTags & tags, TiffBytes & tiff, const TiffDirectory & directory)
{
  const std::uint64_t unit = tags.Number(296, "ResolutionUnit", 1);
  const double        millimetres = unit == 2 ? 25.4 : unit == 3 ? 10.0 : 0.0;
  // libtiff returns them as float
  const std::array<float, 2> resolution{ { static_cast<float>(tiff.Quotient(directory, 282)),
                                           static_cast<float>(tiff.Quotient(directory, 283)) } };
  if (millimetres == 0.0 || !(resolution[0] > 0.0F) || !(resolution[1] > 0.0F))
  {
    return { { 1.0, 1.0 } };
  }
  return { { millimetres / static_cast<double>(resolution[0]), millimetres / static_cast<double>(resolution[1]) } };
}
} // namespace

std::uint64_t
TiffPage::ChunkRowBytes() const
{
  return chunks.width * SizeOf(pixel, stored);
}

bool
IsThumbnail(const std::string &   page,
            TiffBytes &           tiff,
            const TiffDirectory & directory,
            std::uint64_t         width,
            std::uint64_t         height)
{
  const TiffTags tags(page, tiff, directory);
  const bool isReduced = (tags.Number(254, "NewSubfileType", 0) & 1) != 0 || tags.Number(255, "SubfileType", 1) == 2;
  return isReduced && tags.Required(256, "ImageWidth") < width && tags.Required(257, "ImageLength") < height;
}

std::string
SamplesOf(const TiffPage & page)
{
  const bool isSame = page.stored == StoredNumber::SameAsPixel;
  const bool isFloat = isSame && (page.pixel == FramePixel::Float || page.pixel == FramePixel::Double);
  const bool isSigned = page.pixel == FramePixel::Short || page.stored == StoredNumber::Int;
  return std::to_string(8 * SizeOf(page.pixel, page.stored)) + "-bit " +
         (isFloat    ? "floating-point"
          : isSigned ? "signed"
                     : "unsigned");
}

TiffPage
ReadTiffPage(const std::string & page, TiffBytes & tiff, const TiffDirectory & directory)
{
  const TiffTags tags(page, tiff, directory);
  tags.RequireEachOnce();
  RequireGrey(tags);
  RequirePlainOrder(tags);
  TiffPage found;
  found.width = tags.Required(256, "ImageWidth");
  found.height = tags.Required(257, "ImageLength");
  ReadPixelType(tags, found);
  found.compression = CompressionOf(tags);
  ReadPredictor(tags, found);
  ReadSubfileType(tags, found);
  found.spacing = SpacingOf(tags, tiff, directory);
  found.orientation = tags.Number(274, "Orientation", 1);
  if (found.orientation < 1 || found.orientation > 8)
  {
    tags.Refuse("damaged: Orientation is " + std::to_string(found.orientation) + "; expected 1 to 8");
  }
  FrameFile sizes;
  sizes.name = page;
  sizes.pixel = found.pixel;
  SetFrameSizes(sizes, { found.width, found.height });
  found.chunks = ReadTiffChunks(tags, found.width, found.height);
  RequireSizeOfTiles(tags, found);
  FindTiffChunks(tags, found.chunks);
  return found;
}

} // namespace sensornoise
