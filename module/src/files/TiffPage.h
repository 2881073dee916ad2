// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_files_TiffPage_h
#define sensornoise_files_TiffPage_h

#include "sensornoise/FrameFile.h"
#include "files/TiffChunks.h"
#include "files/TiffDirectory.h"

#include <array>
#include <cstdint>
#include <string>

namespace sensornoise
{

/** How the strips or tiles of a TIFF are compressed. */
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
  std::uint64_t         orientation{ 1 };        // 1 to 8; says how a viewer turns the stored pixels
  bool                  isReduced{ false };      // a thumbnail or a mask, by NewSubfileType
  std::array<double, 2> spacing{ { 1.0, 1.0 } }; // along x and y [mm], 1 where it is not said
  TiffChunks            chunks{};                // its strips or tiles

  /** Returns the bytes of a row of a strip or tile, without compression. */
  std::uint64_t
  ChunkRowBytes() const;
};

/** Reads what a directory says, with the defaults of TIFF 6.0 for tags that it lacks. \a page begins the errors. Throws
 * FileError unless the page consists of strips or tiles of one grey value a pixel, of a type that a pixel holds
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

} // namespace sensornoise

#endif
