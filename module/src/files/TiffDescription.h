// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_files_TiffDescription_h
#define sensornoise_files_TiffDescription_h

#include "sensornoise/FrameFile.h"
#include "files/TiffDirectory.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace sensornoise
{

/** The text of the tag ImageDescription, at most its first MiB; empty where there is none. */
std::string
DescriptionOf(TiffBytes & tiff, const TiffDirectory & directory);

/** The number behind "images=" in ImageJ's description; nothing where it is no such description, or says none. */
std::optional<std::uint64_t>
ImagesOfImageJ(const std::string & description);

/** The axes of the pages in the order of the file, the fastest first, as ImageJ's description or OME-XML gives them.
 * Empty where neither is there, and where the pages differ along one axis alone, which is then time; channels are no
 * time. Throws FileError, which \a file begins, where OME-XML describes several images. */
std::vector<FrameAxis>
AxesOfDescription(const std::string & file, const std::string & description);

} // namespace sensornoise

#endif
