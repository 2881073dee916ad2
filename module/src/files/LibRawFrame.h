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

/** The frame of a raw file, opened by LibRaw. Without LibRaw none of this is built. */
class LibRawFrame
{
public:
  /** Reads the header. Throws FileError for what LibRaw does not read, several frames or colours a pixel, and what is
   * known to be compressed with loss. */
  explicit LibRawFrame(const std::string & file);
  ~LibRawFrame();
  LibRawFrame(const LibRawFrame &) = delete;
  LibRawFrame &
  operator=(const LibRawFrame &) = delete;

  /** Of the visible area. [pixels] */
  std::size_t
  Width() const;
  std::size_t
  Height() const;

  /** Of all that the file has, with the masked borders. [pixels] */
  std::size_t
  RawWidth() const;
  std::size_t
  RawHeight() const;

  /** Decodes the codes. Throws FileError where LibRaw meets an error or the end of the file, and std::runtime_error
   * where there is not enough memory. */
  void
  Decode();

  /** Copies the codes of the visible area, after Decode(). */
  void
  CopyTo(unsigned short * codes) const;

  /** What the file says of the camera, after Decode(). */
  CameraSettings
  Camera() const;

private:
  struct Implementation;

  std::string                     m_File;
  std::unique_ptr<Implementation> m_Raw;
};

} // namespace sensornoise

#endif
