// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_files_RawCameraFile_h
#define sensornoise_files_RawCameraFile_h

#include "SensorNoiseExport.h"
#include "sensornoise/Settings.h"
#include "files/FileBytes.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>

/** \file Raw files of cameras: the check of raw files that are TIFFs, and the frame that LibRaw decodes. */

class LibRaw; // declared in libraw/libraw.h, which defines macros with short names

namespace sensornoise
{

/** Kind of a TIFF as a raw file of a camera. */
enum class RawTiffKind
{
  None,
  Dng,   ///< Adobe's DNG
  Mosaic ///< another one with the colours of a mosaic: NEF, ARW, PEF and others
};

/** Returns the kind by the first directory of a TIFF and the directories below it. Throws FileError if they are
 * damaged. */
RawTiffKind
RawTiffKindOf(const std::string & file, FileBytes & bytes);

/** Throws FileError unless all pixels of a raw file that is a TIFF are in the file. Other files are not checked. The
 * strips and tiles that the directories of a TIFF list must be complete. A DNG must also have a directory that declares
 * an image of \a width x \a height digital numbers [pixels], as LibRaw would read it. These are integers, uncompressed
 * or as lossless JPEG, and not rounded by a table. Its strips or tiles hold exactly as many of them, each JPEG to its
 * end. */
SensorNoise_EXPORT void
RequireWholeRawTiff(const std::string & file, FileBytes & bytes, std::uint64_t width, std::uint64_t height);

/** Frame of a raw file, opened by LibRaw. Without LibRaw it is not built. */
class LibRawFrame
{
public:
  /** Reads the header. Throws FileError for a file that LibRaw cannot read, several frames, several colours per pixel,
   * and compression that is known to be lossy. */
  explicit LibRawFrame(const std::string & file);
  ~LibRawFrame();
  LibRawFrame(const LibRawFrame &) = delete;
  LibRawFrame &
  operator=(const LibRawFrame &) = delete;

  /** Width and height of the visible area [pixel]. */
  std::size_t
  Width() const;
  std::size_t
  Height() const;

  /** Width and height with the masked borders [pixel]. */
  std::size_t
  RawWidth() const;
  std::size_t
  RawHeight() const;

  /** Decodes the digital numbers. Throws FileError for an error of LibRaw, a read behind the end of the file, and
   * pixels that are no mosaic. Throws std::runtime_error if there is not enough memory. */
  void
  Decode();

  /** Copies the Width() x Height() digital numbers of the visible area, row by row, after Decode(). */
  void
  CopyTo(unsigned short * greyValues) const;

  /** Returns the settings of the camera that the file records, after Decode(). */
  CameraSettings
  Camera() const;

private:
  struct Implementation;

  std::string                     m_File;
  std::unique_ptr<Implementation> m_Raw;
};

/** Returns the settings of the camera of a file whose pixels are decoded. The Bayer pattern is "" for colours that are
 * no 2 x 2 mosaic (X-Trans, four colours). The black level is NaN unless it is uniform. If the file gives no bit depth
 * below 16, the bit depth is computed from the white level. It is then 0, not known, if a digital number exceeds it.
 * Without LibRaw it is not built. */
CameraSettings
CameraSettingsOf(LibRaw & raw);

/** Returns the known lossy compression of the file in words; "" if there is none, or if LibRaw does not report it.
 * Without LibRaw it is not built. */
std::string
LossOf(LibRaw & raw);

} // namespace sensornoise

#endif
