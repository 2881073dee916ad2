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

/** a b, or nothing where that is above what 64 bits hold with their sign. */
inline std::optional<std::uint64_t>
CheckedProduct(std::uint64_t a, std::uint64_t b)
{
  constexpr std::uint64_t largest = INT64_MAX;
  return b != 0 && a > largest / b ? std::nullopt : std::optional<std::uint64_t>(a * b);
}

/** Sets the size and the bytes of \a file by the sizes along its axes. Throws FileError unless there are two or three,
 * each of at least 1, and the whole can be counted. */
void
SetFrameSizes(FrameFile & file, const std::vector<std::uint64_t> & sizes);

/** The words that refuse a component type by its name. */
std::string
UnsupportedPixel(const std::string & name);

/** The words that refuse pixels of more than a value. */
std::string
SeveralComponents(std::uint64_t components);

/** The size in bytes of a pixel in the file. */
SensorNoise_EXPORT std::size_t
SizeOf(FramePixel pixel, StoredNumber stored);

/** The type of a pixel in the file, as C++ calls it. */
SensorNoise_EXPORT std::string
NameOf(FramePixel pixel, StoredNumber stored);

/** The bytes of all pixels in the file, uncompressed. */
SensorNoise_EXPORT std::uint64_t
StoredBytesOf(const FrameFile & file);

/** Converts \a count numbers, which lie at the beginning of \a numbers in this machine's byte order, to pixels in
 * place. The buffer has room for as many pixels. */
SensorNoise_EXPORT void
ConvertStored(StoredNumber stored, std::size_t count, void * numbers);

/** Returns a geometry as a header gives it with the default in place of what an image cannot have. A spacing below 0 is
 * a direction turned around. */
StackGeometry
UsableGeometry(const StackGeometry & given);

} // namespace sensornoise

#endif
