// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "files/ByteOrder.h"

#include <algorithm>
#include <cmath>

namespace sensornoise
{
namespace
{
double
LevelOf(unsigned int pixel, bool isSigned)
{
  constexpr double range = 65536.0;
  return isSigned && pixel >= 32768U ? static_cast<double>(pixel) - range : static_cast<double>(pixel);
}

void
Add(BytesInOrder & order, unsigned int pixel, unsigned int other, bool isSigned)
{
  order.roughness += std::abs(LevelOf(pixel, isSigned) - LevelOf(other, isSigned));
  order.largest = std::max(order.largest, pixel);
  order.usesLowByte = order.usesLowByte || (pixel & 255U) != 0;
}
} // namespace

bool
BytesInOrder::IsSwapped(const BytesInOrder & other) const
{
  constexpr double clearly = 4.0; // chosen empirically: the ratio is 20 and more in images of 8 to 16 bits
  return usesLowByte && other.usesLowByte && roughness > clearly * other.roughness;
}

ByteOrders
CompareByteOrders(const unsigned char * bytes, std::size_t pixels, bool isSigned)
{
  ByteOrders orders;
  for (std::size_t i = 2; i < pixels; ++i)
  {
    const unsigned char * const pixel = bytes + 2 * i;
    const unsigned char * const other = pixel - 4;
    Add(orders.little, pixel[0] + 256U * pixel[1], other[0] + 256U * other[1], isSigned);
    Add(orders.big, pixel[1] + 256U * pixel[0], other[1] + 256U * other[0], isSigned);
  }
  return orders;
}

} // namespace sensornoise
