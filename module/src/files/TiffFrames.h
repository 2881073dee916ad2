// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_files_TiffFrames_h
#define sensornoise_files_TiffFrames_h

#include "files/FrameReader.h"

#include <cstdint>
#include <utility>
#include <vector>

namespace sensornoise
{

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
