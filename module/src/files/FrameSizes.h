// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_files_FrameSizes_h
#define sensornoise_files_FrameSizes_h

#include "sensornoise/FrameFile.h"
#include "SensorNoiseExport.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace sensornoise
{

/** Returns a * b; none if it exceeds INT64_MAX. */
inline std::optional<std::uint64_t>
CheckedProduct(std::uint64_t a, std::uint64_t b)
{
  constexpr std::uint64_t largest = INT64_MAX;
  return b != 0 && a > largest / b ? std::nullopt : std::optional<std::uint64_t>(a * b);
}

/** Sets width, height, frames and bytes of \a file, whose pixel type is set, from the sizes along its axes. Throws
 * FileError unless there are two or three axes of 1 to 2^31 - 1, and the bytes can be counted. */
void
SetFrameSizes(FrameFile & file, const std::vector<std::uint64_t> & sizes);

/** Returns the message for a component type that is not supported. */
std::string
UnsupportedPixel(const std::string & name);

/** Returns the message for pixels of several components. */
std::string
SeveralComponents(std::uint64_t components);

/** Returns the size of a pixel in the file [bytes]. */
SensorNoise_EXPORT std::size_t
SizeOf(FramePixel pixel, StoredNumber stored);

/** Returns the name in C++ of the type of a pixel in the file. */
SensorNoise_EXPORT std::string
NameOf(FramePixel pixel, StoredNumber stored);

/** Returns the size of all pixels in the file without compression [bytes]. */
SensorNoise_EXPORT std::uint64_t
StoredBytesOf(const FrameFile & file);

/** Converts \a count numbers at the beginning of \a numbers to pixels in place, in the byte order of this machine. The
 * buffer must have space for \a count pixels. */
SensorNoise_EXPORT void
ConvertStored(StoredNumber stored, std::size_t count, void * numbers);

/** Returns the geometry of a header, with the default for values that an image cannot have. A spacing below 0 becomes
 * its magnitude, with the opposite direction. */
StackGeometry
UsableGeometry(const StackGeometry & given);

/** Returns function(0) with a 0 of the type of C++ of \a pixel. */
template <typename TFunction>
auto
CallWithPixelType(FramePixel pixel, TFunction function)
{
  switch (pixel)
  {
    case FramePixel::UnsignedChar:
      return function(static_cast<unsigned char>(0));
    case FramePixel::UnsignedShort:
      return function(static_cast<unsigned short>(0));
    case FramePixel::Short:
      return function(static_cast<short>(0));
    case FramePixel::Float:
      return function(0.0F);
    default:
      return function(0.0);
  }
}

} // namespace sensornoise

#endif
