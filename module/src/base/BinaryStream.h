// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_base_BinaryStream_h
#define sensornoise_base_BinaryStream_h

#include "SensorNoiseExport.h"
#include "base/BytesFingerprint.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <istream>
#include <ostream>
#include <stdexcept>
#include <streambuf>
#include <string>
#include <type_traits>
#include <vector>

/** \file
 * Transfer of sums to another process or a file: a header that names the class, then the numbers as they lie in
 * memory. They are little-endian and IEEE 754 on every platform of ITK. The format is meant for the same version of
 * the module on the same kind of machine, not for an archive. */

namespace sensornoise
{

/** Version of the data after the header; a big-endian machine reads another number. */
inline constexpr std::uint32_t SumsVersion = 6;

/** Writes \a count numbers. Throws std::runtime_error if the stream does not accept them. */
template <typename TNumber>
void
WriteNumbers(std::ostream & out, const TNumber * numbers, std::size_t count)
{
  static_assert(std::is_arithmetic_v<TNumber>, "numbers are written as they lie in memory");
  const std::size_t bytes = count * sizeof(TNumber);
  if (!out.write(reinterpret_cast<const char *>(numbers), static_cast<std::streamsize>(bytes)))
  {
    throw std::runtime_error("a stream does not take " + std::to_string(bytes) + " bytes of sums");
  }
}

template <typename TNumber>
void
WriteNumbers(std::ostream & out, const std::vector<TNumber> & numbers)
{
  WriteNumbers(out, numbers.data(), numbers.size());
}

/** Writes one count. */
SensorNoise_EXPORT void
WriteCount(std::ostream & out, std::uint64_t count);

/** Reads \a count numbers. Throws std::runtime_error if the stream ends early. */
template <typename TNumber>
void
ReadNumbers(std::istream & in, TNumber * numbers, std::size_t count)
{
  static_assert(std::is_arithmetic_v<TNumber>, "numbers are read as they lie in memory");
  const auto bytes = static_cast<std::streamsize>(count * sizeof(TNumber));
  in.read(reinterpret_cast<char *>(numbers), bytes);
  if (in.gcount() != bytes)
  {
    throw std::runtime_error("a stream of sums ends early: found " + std::to_string(in.gcount()) + " bytes, expected " +
                             std::to_string(bytes));
  }
}

/** Reads as many numbers as the vector has elements. */
template <typename TNumber>
void
ReadNumbers(std::istream & in, std::vector<TNumber> & numbers)
{
  ReadNumbers(in, numbers.data(), numbers.size());
}

/** Reads one count. */
SensorNoise_EXPORT std::uint64_t
ReadCount(std::istream & in);

/** Throws std::runtime_error unless the \a found number of \a what equals the \a expected number. */
SensorNoise_EXPORT void
RequireCount(const char * what, std::uint64_t found, std::uint64_t expected);

/** Throws std::runtime_error unless the fingerprints of two processes agree, because they continue from different data.
 */
SensorNoise_EXPORT void
RequireSameStart(std::uint64_t found, std::uint64_t expected);

/** Writes the header of the sums of a class. \a frames is the number of frames that were summed, 0 where the class does
 * not count them. */
SensorNoise_EXPORT void
WriteSumsHeader(std::ostream & out, const std::string & name, std::uint64_t pixels, std::uint64_t frames);

/** Reads a header and returns the number of frames. Throws std::runtime_error if the class, the version or the number
 * of pixels differs. */
SensorNoise_EXPORT std::uint64_t
ReadSumsHeader(std::istream & in, const std::string & name, std::uint64_t pixels);

/** Size of the result of SealSums() [bytes]. */
inline constexpr std::size_t SumsSealBytes = 80;

/** Returns the seal that must precede \a bytes of sums for UnsealSums() to accept them: a mark, \a version of the
 * module, SumsVersion, the length and a fingerprint of the bytes. */
SensorNoise_EXPORT std::vector<unsigned char>
SealSums(const unsigned char * bytes, std::size_t size, const std::string & version);

/** The sums behind a seal: a part of the bytes that were passed to UnsealSums(). */
struct UnsealedSums
{
  const unsigned char * bytes{ nullptr };
  std::size_t           size{ 0 };
};

/** Checks a seal and all bytes behind it, and returns these. Throws std::runtime_error if the bytes are no sums, are
 * incomplete, too many or damaged, or have another version, which the message names. */
SensorNoise_EXPORT UnsealedSums
UnsealSums(const unsigned char * bytes, std::size_t size, const std::string & version);

/** Returns the name of a pixel type, "uint16", "float" ...: part of the name of sums that depend on it. */
template <typename TPixel>
std::string
PixelName()
{
  if (std::is_floating_point_v<TPixel>)
  {
    return sizeof(TPixel) == sizeof(float) ? "float" : "double";
  }
  return (std::is_unsigned_v<TPixel> ? "uint" : "int") + std::to_string(8 * sizeof(TPixel));
}

/** \file
 * Compression of bytes with long runs of zeros. Sums that are kept frame by frame are 0 where a frame was not added: a
 * process that has read few of many frames sends only a small part of them. */

/** \class ZeroRunWriter
 * \brief Packs bytes: blocks of 64 bytes that are all 0 are counted, the others kept.
 *
 * The packed data are a list of runs. Each run has two counts of 8 bytes, of the zero blocks and of the kept blocks
 * that follow, and then the kept blocks. The rate is about 5 GB/s. */
class SensorNoise_EXPORT ZeroRunWriter : public std::streambuf
{
public:
  static constexpr std::size_t BlockBytes = 64;

  /** Returns the packed bytes that were written; the last block is filled up with zeros. The writer is then empty. */
  std::vector<unsigned char>
  Take();

protected:
  std::streamsize
  xsputn(const char * bytes, std::streamsize count) override;
  int_type
  overflow(int_type character) override;

private:
  void
  TakeBlock(const unsigned char * block);
  /** Writes the counts of the current run to their place. */
  void
  EndRun();

  std::vector<unsigned char>            m_Packed;
  std::array<unsigned char, BlockBytes> m_Block{}; // block that is not full
  std::size_t                           m_InBlock{ 0 };
  std::size_t                           m_Place{ 0 }; // place of the counts of the current run
  std::uint64_t                         m_Zeros{ 0 };
  std::uint64_t                         m_Kept{ 0 };
};

/** \class ZeroRunReader
 * \brief Unpacks the bytes of a ZeroRunWriter. Invalid packed bytes end early, without a memory error. */
class SensorNoise_EXPORT ZeroRunReader : public std::streambuf
{
public:
  /** \a packed must outlive the reader. */
  ZeroRunReader(const unsigned char * packed, std::size_t bytes);

protected:
  std::streamsize
  xsgetn(char * bytes, std::streamsize count) override;
  int_type
  underflow() override;
  int_type
  uflow() override;

private:
  /** Moves to the next run that is not empty. Returns false at the end. */
  bool
  FindRun();

  const unsigned char * m_Packed;
  const unsigned char * m_End;
  std::uint64_t         m_Zeros{ 0 }; // bytes that are left of the run
  std::uint64_t         m_Kept{ 0 };
};

} // namespace sensornoise

#endif
