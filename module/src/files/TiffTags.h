// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_files_TiffTags_h
#define sensornoise_files_TiffTags_h

#include "files/TiffDirectory.h"

#include <cstdint>
#include <string>

namespace sensornoise
{

/** The tags of one directory of a TIFF. */
class TiffTags
{
public:
  /** \a page begins the errors. All three must live as long as this. */
  TiffTags(const std::string & page, TiffBytes & tiff, const TiffDirectory & directory)
    : m_Page(page)
    , m_Tiff(tiff)
    , m_Directory(directory)
  {}

  bool
  Has(unsigned tag) const
  {
    return m_Directory.Find(tag) != nullptr;
  }

  /** The only value of a tag, or \a otherwise where there is no such tag. Throws FileError unless it is one whole
   * number. */
  std::uint64_t
  Number(unsigned tag, const char * name, std::uint64_t otherwise) const;

  /** The only value of a tag that must be there. Throws FileError. */
  std::uint64_t
  Required(unsigned tag, const char * name) const;

  /** The entry of a tag that has one number for each strip. Throws FileError. */
  TiffEntry
  OfStrips(unsigned tag, const char * name, std::uint64_t strips) const;

  /** Throws FileError where a tag comes twice: programs take one or the other. */
  void
  RequireEachOnce() const;

  /** Throws FileError. */
  [[noreturn]] void
  Refuse(const std::string & what) const;

private:
  const std::string &   m_Page;
  TiffBytes &           m_Tiff;
  const TiffDirectory & m_Directory;
};

} // namespace sensornoise

#endif
