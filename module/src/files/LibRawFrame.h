// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_files_LibRawFrame_h
#define sensornoise_files_LibRawFrame_h

#include "sensornoise/CameraSettings.h"

#include <cstddef>
#include <memory>
#include <string>

namespace sensornoise
{

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
  CopyTo(unsigned short * codes) const;

  /** Returns the settings of the camera that the file records, after Decode(). */
  CameraSettings
  Camera() const;

private:
  struct Implementation;

  std::string                     m_File;
  std::unique_ptr<Implementation> m_Raw;
};

} // namespace sensornoise

#endif
