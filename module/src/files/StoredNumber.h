// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_files_StoredNumber_h
#define sensornoise_files_StoredNumber_h

#include "SensorNoiseExport.h"
#include "sensornoise/FrameFile.h"

#include <cstddef>
#include <cstdint>
#include <string>

namespace sensornoise
{

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

} // namespace sensornoise

#endif
