// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "files/StoredNumber.h"

#include <cstring>

namespace sensornoise
{
namespace
{
/** From the last number to the first: a pixel is longer than a number, and covers no number before its own. */
template <typename TStored>
void
WidenInPlace(std::size_t count, void * numbers)
{
  static_assert(sizeof(TStored) <= sizeof(double), "a pixel has room for its number");
  auto * const bytes = static_cast<char *>(numbers);
  for (std::size_t i = count; i-- > 0;)
  {
    TStored number;
    std::memcpy(&number, bytes + i * sizeof(TStored), sizeof(TStored));
    const auto pixel = static_cast<double>(number);
    std::memcpy(bytes + i * sizeof(double), &pixel, sizeof(double));
  }
}
} // namespace

std::size_t
SizeOf(FramePixel pixel, StoredNumber stored)
{
  return stored == StoredNumber::SameAsPixel ? SizeOf(pixel) : sizeof(std::uint32_t);
}

std::string
NameOf(FramePixel pixel, StoredNumber stored)
{
  return stored == StoredNumber::SameAsPixel ? NameOf(pixel) : stored == StoredNumber::Int ? "int" : "unsigned int";
}

std::uint64_t
StoredBytesOf(const FrameFile & file)
{
  return file.bytes / SizeOf(file.pixel) * SizeOf(file.pixel, file.stored);
}

void
ConvertStored(StoredNumber stored, std::size_t count, void * numbers)
{
  switch (stored)
  {
    case StoredNumber::SameAsPixel:
      return;
    case StoredNumber::UnsignedInt:
      WidenInPlace<std::uint32_t>(count, numbers);
      return;
    case StoredNumber::Int:
      WidenInPlace<std::int32_t>(count, numbers);
      return;
  }
}

} // namespace sensornoise
