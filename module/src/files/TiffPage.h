// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_files_TiffPage_h
#define sensornoise_files_TiffPage_h

#include "sensornoise/FrameFile.h"
#include "files/FileBytes.h"
#include "files/FrameReader.h"
#include "files/TiffDirectory.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

/** \file
 * A page of a TIFF: its description, its strips or tiles and their check, and the reader of its pixels. */

namespace sensornoise
{

/** The strips or the tiles that the image of a TIFF is divided into, in the order of the file: from left to right, then
 * downwards. Source: TIFF 6.0, sections 3 and 15. */
struct TiffChunks
{
  bool          isTiled{ false };
  std::uint64_t width{ 0 };   // width of a strip or tile [pixels]
  std::uint64_t rows{ 0 };    // rows of a whole strip or tile
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
  std::uint64_t offset{ 0 };     // first byte in the file
  std::uint64_t count{ 0 };      // number of bytes in the file
  std::uint64_t rows{ 0 };       // rows of pixels in the strip or tile
  std::uint64_t bytes{ 0 };      // bytes of these rows, without compression
  std::uint64_t wholeBytes{ 0 }; // bytes of a whole strip, to which some writers fill up the last one
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

/** Compression of the strips or tiles of a TIFF. */
enum class TiffCompression
{
  None,
  Lzw,
  Deflate,
  PackBits
};

/** Properties of the pixels by the directory of a page. */
struct TiffPage
{
  std::uint64_t         width{ 0 };
  std::uint64_t         height{ 0 };
  FramePixel            pixel{ FramePixel::UnsignedChar };
  StoredNumber          stored{ StoredNumber::SameAsPixel };
  TiffCompression       compression{ TiffCompression::None };
  std::uint64_t         predictor{ 1 };
  std::uint64_t         orientation{ 1 };        // 1 to 8: orientation in which a viewer shows the stored pixels
  bool                  isReduced{ false };      // a thumbnail or a mask, by NewSubfileType
  std::array<double, 2> spacing{ { 1.0, 1.0 } }; // pixel spacing along x and y [mm]; 1: not recorded
  TiffChunks            chunks{};                // its strips or tiles

  /** Returns the bytes of a row of a strip or tile, without compression. */
  std::uint64_t
  ChunkRowBytes() const;
};

/** Reads the values of a directory, with the defaults of TIFF 6.0 for tags that it lacks. \a page begins the errors.
 * Throws FileError unless the page consists of strips or tiles of one grey value a pixel, of a type that a pixel holds
 * exactly, and whose compression can be checked. */
TiffPage
ReadTiffPage(const std::string & page, TiffBytes & tiff, const TiffDirectory & directory);

/** Returns whether a directory describes a thumbnail of a frame of \a width x \a height pixels: by its subfile type and
 * by its size, both smaller. Throws FileError, which \a page begins, where one of these tags is damaged. */
bool
IsThumbnail(const std::string &   page,
            TiffBytes &           tiff,
            const TiffDirectory & directory,
            std::uint64_t         width,
            std::uint64_t         height);

/** Describes the samples: "16-bit unsigned". */
std::string
SamplesOf(const TiffPage & page);

/** Checks the strips or tiles of all pages of a TIFF. */
class TiffStrips
{
public:
  explicit TiffStrips(TiffBytes & tiff)
    : m_Tiff(tiff)
  {}

  /** The directory of a page, and values that are not in it, hold no pixels. \a page begins the errors. */
  void
  AddDirectory(const std::string & page, const TiffDirectory & directory);

  /** Throws FileError unless all strips or tiles of the page lie within the file and give exactly the bytes of their
   * rows; deflated strips and tiles must also have the right checksum. */
  void
  CheckPage(const std::string & page, const TiffPage & found);

  /** Adds pixels that follow the pixels of the pages. */
  void
  AddPixels(const std::string & page, std::uint64_t offset, std::uint64_t count);

  /** Throws FileError if bytes of a strip or tile belong to another one, or to a directory, and if there is the
   * directory of a page that a damaged chain of pages has left out. */
  void
  RequireAllBytes(const std::string & file);

private:
  TiffBytes &   m_Tiff;
  ByteRanges    m_Ranges{};
  std::uint64_t m_PixelBytes{ 0 };            // bytes of all strips and tiles so far
  std::uint64_t m_SmallestPage{ UINT64_MAX }; // bytes of the strips or tiles of a page
  std::uint64_t m_Width{ 0 };
  bool          m_HasSubDirectories{ false };
  std::uint64_t m_DirectoryBytes{ 0 }; // bytes of all directories so far
};

/** The text of the tag ImageDescription, at most its first MiB; empty where there is none. */
std::string
DescriptionOf(TiffBytes & tiff, const TiffDirectory & directory);

/** The number behind "images=" in ImageJ's description; nothing where it is no such description, or says none. */
std::optional<std::uint64_t>
ImagesOfImageJ(const std::string & description);

/** The axes of the pages in the order of the file, the fastest first, as ImageJ's description or OME-XML gives them.
 * Empty where neither is there, and where the pages differ along one axis alone, which is then time; channels are no
 * time. Throws FileError, which \a file begins, where OME-XML describes several images. */
std::vector<FrameAxis>
AxesOfDescription(const std::string & file, const std::string & description);

/** Reads the pages of a TIFF, each from its directory, which is known by its place: no chain is walked. */
class TiffFrames : public FrameReader
{
public:
  /** \a directories: the place of each page's directory in the file. */
  explicit TiffFrames(std::vector<std::uint64_t> directories)
    : m_Directories(std::move(directories))
  {}

  void
  Read(const FrameFile & file, std::size_t first, std::size_t count, void * buffer) const override;

private:
  std::vector<std::uint64_t> m_Directories;
};

} // namespace sensornoise

#endif
