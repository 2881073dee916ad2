// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "correlation/PixelsBySignal.h"

#include <array>
#include <cstddef>
#include <cstring>

namespace sensornoise
{

namespace
{
struct PixelKey
{
  std::uint32_t key; // has the order of the signal
  std::uint32_t pixel;
};

/** Returns an integer in the order of \a light. The bits of positive numbers have the order of the numbers, the bits of
 * negative numbers the opposite order. */
std::uint32_t
KeyOf(float light)
{
  constexpr std::uint32_t sign = std::uint32_t{ 1 } << 31;
  const float             number = light + 0.0F; // +0 and -0 become equal
  std::uint32_t           bits = 0;
  static_assert(sizeof bits == sizeof number);
  std::memcpy(&bits, &number, sizeof bits);
  return (bits & sign) != 0 ? ~bits : bits | sign;
}

/** Sorts by 11 bits of the keys, and keeps the order of pixels that are equal in them. */
void
SortByDigit(unsigned int shift, std::vector<PixelKey> & pixels, std::vector<PixelKey> & sorted)
{
  constexpr std::size_t           digits = 2048;
  std::array<std::size_t, digits> places{};
  const auto                      digitOf = [shift](const PixelKey & pixel) { return (pixel.key >> shift) % digits; };
  for (const PixelKey & pixel : pixels)
  {
    ++places[digitOf(pixel)];
  }
  std::size_t next = 0;
  for (std::size_t & place : places)
  {
    const std::size_t count = place;
    place = next;
    next += count;
  }
  for (const PixelKey & pixel : pixels)
  {
    sorted[places[digitOf(pixel)]++] = pixel;
  }
  pixels.swap(sorted);
}
} // namespace

std::vector<std::uint32_t>
SortPixelsBySignal(const std::vector<float> & light, const std::vector<std::uint8_t> & take)
{
  std::vector<PixelKey> pixels;
  pixels.reserve(light.size());
  for (std::size_t p = 0; p < light.size(); ++p)
  {
    if (take[p] != 0)
    {
      pixels.push_back({ KeyOf(light[p]), static_cast<std::uint32_t>(p) });
    }
  }
  std::vector<PixelKey> sorted(pixels.size());
  for (const unsigned int shift : { 0U, 11U, 22U })
  {
    SortByDigit(shift, pixels, sorted);
  }
  std::vector<std::uint32_t> order;
  order.reserve(pixels.size());
  for (const PixelKey & pixel : pixels)
  {
    order.push_back(pixel.pixel);
  }
  return order;
}

} // namespace sensornoise
