// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_files_ByteOrders_h
#define sensornoise_files_ByteOrders_h

#include <cstddef>

namespace sensornoise
{

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
