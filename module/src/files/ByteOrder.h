// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_files_ByteOrder_h
#define sensornoise_files_ByteOrder_h

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <string>
#include <type_traits>

namespace sensornoise
{

/** The number in \a count bytes, at most 8, the highest or the lowest of them first. */
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

/** Returns the lowest \a count bytes of a number, at most 8, the highest or the lowest of them first. */
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

/** Returns the bytes of a float or a double as IEEE 754 has them. */
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

/** Pixels of 16 bits, read in one order of their bytes. */
struct BytesInOrder
{
  double       roughness{ 0.0 }; ///< sum of the differences of pixels two places apart, of one colour of a mosaic [DN]
  unsigned int largest{ 0 };     ///< largest pixel, read as unsigned [DN]
  bool         usesLowByte{ false };

  /** Whether the pixels are more than 4 times as rough as in the \a other order: then the other order is the right one,
   * as images are smooth. Not where one byte is always 0, where both orders make sense. */
  bool
  IsSwapped(const BytesInOrder & other) const;
};

/** Pixels of 16 bits, read in both orders of their bytes. */
struct ByteOrders
{
  BytesInOrder little{}; ///< the lowest byte first
  BytesInOrder big{};    ///< the highest byte first
};

/** Reads \a pixels pixels of 16 bits in both orders; \a isSigned: they are signed integers. */
ByteOrders
CompareByteOrders(const unsigned char * bytes, std::size_t pixels, bool isSigned);

} // namespace sensornoise

#endif
