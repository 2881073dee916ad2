// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_files_RawLayout_h
#define sensornoise_files_RawLayout_h

#include "SensorNoiseExport.h"
#include "sensornoise/CameraSettings.h"
#include "sensornoise/FrameFile.h"
#include "files/FrameReader.h"

#include <cstdint>
#include <string>

namespace sensornoise
{

/** How frames lie in a file that does not say so itself: in a dump of a camera's memory, for instance. */
struct RawLayout
{
  std::uint64_t  width{ 0 };  // [pixels]
  std::uint64_t  height{ 0 }; // [pixels]
  SampleFormat   sample{};
  std::uint64_t  skipBytes{ 0 }; // at the beginning of the file
  std::uint64_t  rowBytes{ 0 };  // from a row to the next; 0: there is nothing between
  std::uint64_t  gapBytes{ 0 };  // behind each frame
  std::uint64_t  endBytes{ 0 };  // at the end of the file
  CameraSettings camera{};       // what the type's name says of it
};

/** Reads "WIDTHxHEIGHT:TYPE[:SKIP[:ROW[:GAP[:END]]]]". TYPE, in whichever case, is
 * - uint8, uint16le, uint16be, int16le, int16be, uint32le, uint32be, int32le, int32be, float32le, float32be, float64le
 * or float64be, as numpy counts bits, the end saying which byte comes first; integers of 32 bits are read as double;
 * - as GenICam calls it: Mono8, Mono10, Mono12, Mono14, Mono16, Mono10p, Mono12p, Mono14p, Mono10Packed, Mono12Packed,
 *   and BayerRG8 and so on, whose pattern is then known;
 * - RAW10, RAW12 or RAW14, packed as by MIPI CSI-2, and SRGGB10P and so on, as Linux and libcamera call these with the
 *   pattern; SRGGB10 and so on, not packed;
 * - uint10msb, uint12msb or uint14msb, a stream of bits, the highest first.
 * SKIP: bytes before the first frame, default 0. ROW: bytes from a row to the next, default, and 0: as many as a row
 * has. GAP: bytes behind each frame, the last one or not, default 0. END: bytes at the end of the file, default 0.
 *
 * Throws std::invalid_argument that says what was found and what was expected. */
SensorNoise_EXPORT RawLayout
ReadRawLayout(const std::string & text);

/** What a file of that layout holds, as InspectFrameFile() tells of others. Throws FileError unless it is a whole
 * number of frames, at least one. */
SensorNoise_EXPORT FrameFile
InspectRawFile(const std::string & name, const RawLayout & layout);

} // namespace sensornoise

#endif
