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
  IsSwapped(const BytesInOrder & other) const;
};

/** Properties of 16-bit pixels, read in both byte orders. */
struct ByteOrders
{
  BytesInOrder little{}; ///< lowest byte first
  BytesInOrder big{};    ///< highest byte first
};

/** Reads \a pixels pixels of 16 bits in both byte orders. \a isSigned: they are signed integers. */
ByteOrders
CompareByteOrders(const unsigned char * bytes, std::size_t pixels, bool isSigned);

} // namespace sensornoise

#endif
