// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_files_TiffStrips_h
#define sensornoise_files_TiffStrips_h

#include "files/FileBytes.h"
#include "files/TiffDirectory.h"
#include "files/TiffPage.h"

#include <cstdint>
#include <string>

namespace sensornoise
{

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
   * rows; deflated ones with the right checksum, which the others do not have. */
  void
  CheckPage(const std::string & page, const TiffPage & found);

  /** Pixels behind those of the pages. */
  void
  AddPixels(const std::string & page, std::uint64_t offset, std::uint64_t count);

  /** Throws FileError if bytes of a strip or tile belong to another one, or to a directory, and if there is the
   * directory of a page that a damaged chain of pages has left out. */
  void
  RequireAllBytes(const std::string & file);

private:
  TiffBytes &   m_Tiff;
  ByteRanges    m_Ranges{};
  std::uint64_t m_PixelBytes{ 0 };            // of all strips and tiles so far
  std::uint64_t m_SmallestPage{ UINT64_MAX }; // bytes of the strips or tiles of a page
  std::uint64_t m_Width{ 0 };
  bool          m_HasSubDirectories{ false };
  std::uint64_t m_DirectoryBytes{ 0 }; // of all directories so far
};

} // namespace sensornoise

#endif
