// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_files_FrameChoice_h
#define sensornoise_files_FrameChoice_h

#include "SensorNoiseExport.h"
#include "sensornoise/FrameFile.h"

#include <cstddef>
#include <optional>

namespace sensornoise
{

/** Which frames of a file are those of a burst, where it holds several channels or planes (FrameFile::axes). */
struct FrameChoice
{
  std::optional<std::size_t> channel{};    ///< from 0
  std::optional<std::size_t> plane{};      ///< from 0
  bool                       all{ false }; ///< frames of any channel and plane, one after the other
};

/** Reduces the frames of the file to those of one channel and one plane, in time order. Throws FileError that names the
 * axes where there are several channels or planes and none is chosen, and where the choice is not in the file. */
SensorNoise_EXPORT void
ChooseFrames(FrameFile & file, const FrameChoice & choice);

} // namespace sensornoise

#endif
