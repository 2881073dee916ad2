// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_files_PngRows_h
#define sensornoise_files_PngRows_h

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace sensornoise
{

/** The rows of a grey PNG, as they come out of its inflated stream: a byte that names the filter, then the filtered
 * bytes. */
class PngRows
{
public:
  /** If \a significantBits is above 0, rows are unfiltered, too, and codes are looked at below these bits. */
  PngRows(std::size_t width, std::size_t height, std::size_t bytesPerPixel, bool interlaced, unsigned significantBits);

  /** The bytes of all rows together. */
  std::uint64_t
  Bytes() const
  {
    return m_Bytes;
  }

  /** The next bytes, which come in pieces of any size. Not more than Bytes() in all. */
  void
  Add(const unsigned char * bytes, std::size_t count);

  /** Empty while all is well, else what is wrong with a row. */
  const std::string &
  Error() const
  {
    return m_Error;
  }

  /** Whether a code has bits below the significant ones. */
  bool
  HasLowerBits() const
  {
    return m_HasLowerBits;
  }

private:
  struct Pass
  {
    std::size_t rowBytes; // without the filter
    std::size_t rows;
  };

  void
  EndRow();

  std::vector<Pass>          m_Passes;
  std::size_t                m_BytesPerPixel;
  unsigned                   m_SignificantBits;
  std::uint64_t              m_Bytes{ 0 };
  std::size_t                m_Pass{ 0 };
  std::size_t                m_Row{ 0 };
  std::size_t                m_Filled{ 0 }; // bytes of the row that have come, with the filter
  unsigned char              m_Filter{ 0 };
  std::vector<unsigned char> m_Current; // only where rows are unfiltered
  std::vector<unsigned char> m_Previous;
  std::string                m_Error;
  bool                       m_HasLowerBits{ false };
};

} // namespace sensornoise

#endif
