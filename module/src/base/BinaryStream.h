// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_base_BinaryStream_h
#define sensornoise_base_BinaryStream_h

#include "base/MixBits.h"
#include "SensorNoiseExport.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <istream>
#include <limits>
#include <ostream>
#include <stdexcept>
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
inline constexpr std::uint32_t SumsVersion = 5;

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

/** \class Fingerprint
 * \brief Number from which it is decided whether two processes continue from the same data, bit by bit; all NaN are
 * equal. */
class Fingerprint
{
public:
  template <typename TNumber>
  void
  Add(const TNumber * numbers, std::size_t count)
  {
    for (std::size_t i = 0; i < count; ++i)
    {
      TNumber number = numbers[i];
      if constexpr (std::is_floating_point_v<TNumber>)
      {
        number = std::isnan(number) ? std::numeric_limits<TNumber>::quiet_NaN() : number;
      }
      std::uint64_t bits = 0;
      std::memcpy(&bits, &number, sizeof(number));
      m_Value = MixBits((m_Value ^ bits) + 0x9e3779b97f4a7c15ULL); // the golden ratio, so that zeros change the value
    }
  }
  std::uint64_t
  GetValue() const
  {
    return m_Value;
  }

private:
  std::uint64_t m_Value{ 0 };
};

} // namespace sensornoise

#endif
