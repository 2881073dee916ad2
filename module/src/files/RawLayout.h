// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_files_RawLayout_h
#define sensornoise_files_RawLayout_h

#include "SensorNoiseExport.h"
#include "sensornoise/Settings.h"
#include "sensornoise/FrameFile.h"
#include "files/FrameReader.h"

#include <cstdint>
#include <string>

namespace sensornoise
{

/** Layout of the frames in a file without a header, for example in a dump of a camera's memory. */
struct RawLayout
{
  std::uint64_t  width{ 0 };  // [pixel]
  std::uint64_t  height{ 0 }; // [pixel]
  SampleFormat   sample{};
  std::uint64_t  skipBytes{ 0 }; // bytes before the first frame
  std::uint64_t  rowBytes{ 0 };  // bytes from a row to the next; 0: no gap between rows
  std::uint64_t  gapBytes{ 0 };  // bytes behind each frame
  std::uint64_t  endBytes{ 0 };  // bytes at the end of the file
  CameraSettings camera{};       // Bayer pattern and bit depth, if the name of the type gives them
};

/** Returns the layout "WIDTHxHEIGHT:TYPE[:SKIP[:ROW[:GAP[:END]]]]". WIDTH and HEIGHT are 1 to 2^31 - 1 pixels. TYPE, in
 * any case, is
 * - uint8, uint16le, uint16be, int16le, int16be, uint32le, uint32be, int32le, int32be, float32le, float32be, float64le
 *   or float64be, with the number of bits and the byte order; integers of 32 bits are read as double;
 * - a name of GenICam: Mono8, Mono10, Mono12, Mono14, Mono16, Mono10p, Mono12p, Mono14p, Mono10Packed, Mono12Packed, or
 *   with a Bayer pattern BayerRG8 and so on;
 * - RAW10, RAW12 or RAW14, packed as in MIPI CSI-2, or with a Bayer pattern SRGGB10P and so on, as in Linux and
 *   libcamera; SRGGB10 and so on are not packed;
 * - uint10msb, uint12msb or uint14msb, a bit stream with the highest bit first.
 *
 * SKIP: bytes before the first frame, default 0. ROW: bytes from a row to the next, default 0: no gap between rows.
 * GAP: bytes behind each frame, default 0; they may be missing behind the last frame. END: bytes at the end of the
 * file, default 0.
 *
 * Throws std::invalid_argument, whose message says what was found and what was expected. */
SensorNoise_EXPORT RawLayout
ReadRawLayout(const std::string & text);

/** Returns the description of a file with this layout, as InspectFrameFile() does for other files. FrameFile::warning
 * is set if its bytes seem swapped. Throws FileError unless the file has a whole number of frames, at least one. */
SensorNoise_EXPORT FrameFile
InspectRawFile(const std::string & name, const RawLayout & layout);

} // namespace sensornoise

#endif
