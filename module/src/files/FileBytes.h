// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_files_FileBytes_h
#define sensornoise_files_FileBytes_h

#include "sensornoise/FrameFile.h"
#include "SensorNoiseExport.h"

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <limits>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

/** \file
 * Bytes of a file, and the numbers in them. */

namespace sensornoise
{

/** Returns whether both are the same file in the same state: same size and same times of its changes. */
SensorNoise_EXPORT bool
operator==(const FileIdentity & a, const FileIdentity & b);

inline bool
operator!=(const FileIdentity & a, const FileIdentity & b)
{
  return !(a == b);
}

/** Returns whether both are the same file, in any state and by any names. */
SensorNoise_EXPORT bool
AreSameFile(const FileIdentity & a, const FileIdentity & b);

/** Returns the identity of the regular file \a name, or of the file to which the link \a name leads. The file is not
 * opened, so that pipes and devices cannot block. Throws FileError if there is no file, or no regular file. */
SensorNoise_EXPORT FileIdentity
IdentityOf(const std::string & name);

/** Returns the identity of the data file that the header of \a file names. Throws as IdentityOf(), with messages that
 * begin with \a file. */
SensorNoise_EXPORT FileIdentity
IdentityOfDataFile(const std::string & file, const std::string & dataFile);

/** Reads bytes of a file at any place. */
class SensorNoise_EXPORT FileBytes
{
public:
  /** Opens the file \a path. Messages of errors begin with \a file, which is the same file or names it as its data
   * file. Throws FileError unless \a path is a readable regular file. */
  FileBytes(const std::string & file, const std::string & path);

  explicit FileBytes(const std::string & file)
    : FileBytes(file, file)
  {}

  /** Returns the size of the file when it was opened [bytes]. */
  std::uint64_t
  Size() const
  {
    return m_Size;
  }

  /** Returns whether all these bytes are in the file. */
  bool
  Holds(std::uint64_t offset, std::uint64_t count) const
  {
    return offset <= m_Size && count <= m_Size - offset;
  }

  /** Reads \a count bytes from \a offset on. Throws FileError if the file ends before, or if they cannot be read. */
  void
  Read(std::uint64_t offset, void * buffer, std::size_t count);

  /** Reads up to \a count bytes from \a offset on, fewer at the end of the file. Returns their number. Throws FileError
   * if they cannot be read. */
  std::size_t
  ReadSome(std::uint64_t offset, void * buffer, std::size_t count);

private:
  std::string   m_File;
  std::string   m_Path;
  std::uint64_t m_Size;
  std::uint64_t m_Position{ 0 };
  std::ifstream m_Stream;
};

/** Reads the bytes [offset, end) of a file one after the other, through a buffer of 16 KiB. */
class ByteReader
{
public:
  ByteReader(FileBytes & bytes, std::uint64_t offset, std::uint64_t end)
    : m_Bytes(bytes)
    , m_Offset(offset)
    , m_End(end)
  {}

  /** Returns the next byte; -1 at the end. */
  int
  Next()
  {
    return m_Used < m_Held || Fill() ? m_Buffer[m_Used++] : -1;
  }

  /** Returns the offset of the next byte [bytes]. */
  std::uint64_t
  Offset() const
  {
    return m_Offset - m_Held + m_Used;
  }

private:
  bool
  Fill();

  static constexpr std::size_t BufferBytes = 16384;

  FileBytes &   m_Bytes;
  std::uint64_t m_Offset;
  std::uint64_t m_End;
  std::size_t   m_Held{ 0 };
  std::size_t   m_Used{ 0 };
  unsigned char m_Buffer[BufferBytes]{};
};

/** Ranges of a file that hold pixels or tables, to find bytes that are used twice. Adjacent ranges are joined, and the
 * number of other ranges is limited, so that at most 8 MiB are used. */
class SensorNoise_EXPORT ByteRanges
{
public:
  using Range = std::pair<std::uint64_t, std::uint64_t>; // offsets of its first byte and behind its last byte

  /** Adds bytes that hold pixels. Returns false if there are too many separate ranges. */
  bool
  AddPixels(std::uint64_t offset, std::uint64_t count)
  {
    return Add(m_Pixels, offset, count, false);
  }

  /** Adds bytes that hold a table; several tables may overlap. Returns false if there are too many separate ranges. */
  bool
  AddTable(std::uint64_t offset, std::uint64_t count)
  {
    return Add(m_Tables, offset, count, true);
  }

  /** Returns the offset of a byte that holds pixels twice, or pixels and a table; none if there is no conflict. */
  std::optional<std::uint64_t>
  FirstConflict();

  /** Returns the ranges of a file of \a size bytes that are neither pixels nor tables. Gaps of up to 3 bytes between
   * pixels are left out. */
  std::vector<Range>
  Gaps(std::uint64_t size);

private:
  static constexpr std::size_t MaximumRanges = std::size_t{ 1 } << 18;

  /** Sorts the ranges and joins ranges that follow each other. Ranges that may overlap are also joined if they do. */
  static void
  Join(std::vector<Range> & ranges, bool mayOverlap);

  static bool
  Add(std::vector<Range> & ranges, std::uint64_t offset, std::uint64_t count, bool mayOverlap);

  std::vector<Range> m_Pixels;
  std::vector<Range> m_Tables;
};

/** Returns the unsigned number in \a count bytes, at most 8. \a isBigEndian: the highest byte is first, else the
 * lowest. */
inline std::uint64_t
NumberInBytes(const unsigned char * bytes, std::size_t count, bool isBigEndian)
{
  std::uint64_t number = 0;
  for (std::size_t i = 0; i < count; ++i)
  {
    number = (number << 8) | bytes[isBigEndian ? i : count - 1 - i];
  }
  return number;
}

/** Returns the lowest \a count bytes of a number, at most 8. \a isBigEndian: the highest byte is first, else the
 * lowest. */
inline std::string
BytesOfNumber(std::uint64_t number, std::size_t count, bool isBigEndian)
{
  std::string bytes(count, '\0');
  for (std::size_t i = 0; i < count; ++i)
  {
    bytes[isBigEndian ? count - 1 - i : i] = static_cast<char>(number >> (8 * i) & 0xFFU);
  }
  return bytes;
}

/** Returns the bytes of a float or a double in the format of IEEE 754. */
template <typename TReal>
std::string
BytesOfReal(TReal number, bool isBigEndian)
{
  static_assert(std::numeric_limits<TReal>::is_iec559, "files hold numbers of IEEE 754");
  std::conditional_t<sizeof(TReal) == 4, std::uint32_t, std::uint64_t> bits = 0;
  static_assert(sizeof bits == sizeof number, "float or double");
  std::memcpy(&bits, &number, sizeof bits);
  return BytesOfNumber(bits, sizeof bits, isBigEndian);
}

/** Returns the double of IEEE 754 with these bits. */
inline double
RealOfBits(std::uint64_t bits)
{
  double number = 0.0;
  static_assert(sizeof bits == sizeof number, "double of 64 bits");
  std::memcpy(&number, &bits, sizeof number);
  return number;
}

/** Properties of 16-bit pixels, read in one byte order. */
struct BytesInOrder
{
  double       roughness{ 0.0 }; ///< sum of |pixel - pixel two places before|: equal colours of a mosaic [DN]
  unsigned int largest{ 0 };     ///< largest pixel from the third on, read as unsigned [DN]
  /** True if the low byte of any of these pixels is not 0. */
  bool usesLowByte{ false };

  /** Returns whether the pixels are more than 4 times as rough as in the \a other order. The other order is then the
   * right one, because images are smooth. Returns false if one byte of all pixels is 0, because both orders are then
   * plausible. */
  bool
  IsSwapped(const BytesInOrder & other) const
  {
    constexpr double clearly = 4.0; // chosen empirically: the ratio is 20 and more in images of 8 to 16 bits
    return usesLowByte && other.usesLowByte && roughness > clearly * other.roughness;
  }
};

/** Properties of 16-bit pixels, read in both byte orders. */
struct ByteOrders
{
  BytesInOrder little{}; ///< lowest byte first
  BytesInOrder big{};    ///< highest byte first
};

/** Reads \a pixels pixels of 16 bits in both byte orders. \a isSigned: they are signed integers. */
SensorNoise_EXPORT ByteOrders
CompareByteOrders(const unsigned char * bytes, std::size_t pixels, bool isSigned);

} // namespace sensornoise

#endif
