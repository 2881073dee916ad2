// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "files/FrameSizes.h"

#include "sensornoise/FrameFile.h"

#include <cstddef>
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
    // ITK, MetaIO and libtiff keep sizes as int in places
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

} // namespace sensornoise
