// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_files_SamplePacking_h
#define sensornoise_files_SamplePacking_h

#include "sensornoise/FrameFile.h"

#include <cstddef>
#include <cstdint>

namespace sensornoise
{

/** How the bits of pixels that follow each other lie in bytes. */
enum class SamplePacking
{
  Whole,        ///< each pixel has bytes of its own
  LowestFirst,  ///< a stream of bits, lowest first: GenICam's Mono10p, Mono12p, Mono14p
  HighestFirst, ///< a stream of bits, highest first: Photron's .mraw
  GigE,         ///< two pixels in three bytes, what is lowest of both in the middle: GigE Vision's Mono12Packed
  Mipi          ///< the eight highest bits of some pixels, then what is lowest of all: MIPI CSI-2's RAW10, RAW12, RAW14
};

/** How pixels are written in a file. */
struct SampleFormat
{
  FramePixel    pixel{ FramePixel::UnsignedShort }; ///< what they are read as
  SamplePacking packing{ SamplePacking::Whole };
  bool          isBigEndian{ false };                ///< of Whole
  unsigned      bits{ 16 };                          ///< that a pixel takes in a stream; of Whole those of its type
  StoredNumber  stored{ StoredNumber::SameAsPixel }; ///< of Whole
};

/** Pixels of the type of \a file, each in bytes of its own. */
SampleFormat
WholeSample(const FrameFile & file, bool isBigEndian);

/** The smallest number of pixels whose bytes are all their own. */
std::size_t
SamplesInGroup(const SampleFormat & format);

/** The bytes of such a group. */
std::size_t
BytesInGroup(const SampleFormat & format);

/** Unpacks \a groups groups of pixels into \a pixels, which are of format.pixel, in this machine's byte order. */
void
UnpackSamples(const SampleFormat & format, const unsigned char * bytes, std::size_t groups, void * pixels);

/** Turns the bytes of each pixel around where \a isBigEndian is not this machine's order. */
void
ToOwnByteOrder(bool isBigEndian, std::size_t bytesOfPixel, std::size_t count, void * pixels);

} // namespace sensornoise

#endif
