// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "files/FrameReader.h"

#include <cmath>
#include <cstring>
#include <limits>

namespace sensornoise
{
std::size_t
SizeOf(FramePixel pixel)
{
  switch (pixel)
  {
    case FramePixel::UnsignedChar:
      return 1;
    case FramePixel::UnsignedShort:
    case FramePixel::Short:
      return 2;
    case FramePixel::Float:
      return 4;
    default:
      return 8;
  }
}

std::string
NameOf(FramePixel pixel)
{
  switch (pixel)
  {
    case FramePixel::UnsignedChar:
      return "unsigned char";
    case FramePixel::UnsignedShort:
      return "unsigned short";
    case FramePixel::Short:
      return "short";
    case FramePixel::Float:
      return "float";
    default:
      return "double";
  }
}

void
SetFrameSizes(FrameFile & file, const std::vector<std::uint64_t> & sizes)
{
  if (sizes.size() < 2 || sizes.size() > 3)
  {
    throw FileError(file.name, std::to_string(sizes.size()) + " dimensions; expected 2 (a frame) or 3 (a stack)");
  }
  std::optional<std::uint64_t> bytes = SizeOf(file.pixel);
  std::string                  text;
  for (std::size_t i = 0; i < sizes.size(); ++i)
  {
    // ITK, MetaIO and libtiff store some sizes as int
    if (sizes[i] == 0 || sizes[i] > std::uint64_t{ std::numeric_limits<std::int32_t>::max() })
    {
      throw FileError(file.name,
                      "size " + std::to_string(sizes[i]) + " along axis " + std::to_string(i) +
                        "; expected at least 1 and at most " +
                        std::to_string(std::numeric_limits<std::int32_t>::max()));
    }
    bytes = bytes ? CheckedProduct(*bytes, sizes[i]) : bytes;
    text += (i == 0 ? "" : " x ") + std::to_string(sizes[i]);
  }
  if (!bytes || *bytes > std::numeric_limits<std::size_t>::max())
  {
    throw FileError(file.name, text + " pixels, more than can be counted in bytes; expected a smaller image");
  }
  file.width = static_cast<std::size_t>(sizes[0]);
  file.height = static_cast<std::size_t>(sizes[1]);
  file.frames = sizes.size() == 3 ? static_cast<std::size_t>(sizes[2]) : 1;
  file.bytes = *bytes;
}

std::string
UnsupportedPixel(const std::string & name)
{
  return "component type " + name +
         " is not supported; expected unsigned char, unsigned short, short, "
         "unsigned int, int, float or double";
}

std::string
SeveralComponents(std::uint64_t components)
{
  return std::to_string(components) + " components a pixel; expected 1 grey value";
}

namespace
{
/** Converts numbers to double from the last to the first: a double is at least as long, so that it overwrites no number
 * before it. */
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

namespace
{
double
DeterminantOf(const std::array<std::array<double, 3>, 3> & m)
{
  return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) - m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
         m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
}
} // namespace

StackGeometry
UsableGeometry(const StackGeometry & given)
{
  StackGeometry geometry;
  StackGeometry turned = given;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const double spacing = given.spacing[axis];
    if (std::isfinite(spacing) && spacing != 0.0)
    {
      geometry.spacing[axis] = std::abs(spacing);
    }
    if (std::isfinite(given.origin[axis]))
    {
      geometry.origin[axis] = given.origin[axis];
    }
    for (std::size_t row = 0; row < 3; ++row)
    {
      turned.direction[row][axis] = (spacing < 0.0 ? -1.0 : 1.0) * given.direction[row][axis];
    }
  }
  const double determinant = DeterminantOf(turned.direction);
  if (std::isfinite(determinant) && determinant != 0.0)
  {
    geometry.direction = turned.direction;
  }
  return geometry;
}

} // namespace sensornoise
