// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_files_FrameReader_h
#define sensornoise_files_FrameReader_h

#include "sensornoise/FrameFile.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>

namespace sensornoise
{

struct FrameFile;

/** Reads frames of a file that was inspected, with this library's own code, a few at a time. */
class FrameReader
{
public:
  FrameReader() = default;
  virtual ~FrameReader() = default;
  FrameReader(const FrameReader &) = delete;
  FrameReader &
  operator=(const FrameReader &) = delete;

  /** Reads \a count frames from the frame \a first on, one after the other, into \a buffer, which has room for so many
   * pixels of the file's type. Holds a MiB or two beside them. Throws FileError where the file has changed in a way
   * that does not let them be read; RequireUnchanged() tells of others. May be called from several threads at once. */
  virtual void
  Read(const FrameFile & file, std::size_t first, std::size_t count, void * buffer) const = 0;

  /** Returns whether frames have to be read in their order to be read fast: those of one compressed stream. Then
   * several threads would wait for each other. */
  virtual bool
  IsSequential() const
  {
    return false;
  }
};

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

/** Where the frames of a file are: one after the other, each the same number of bytes. */
struct FramePlaces
{
  std::string   path{};          // of the file that holds them
  std::uint64_t offset{ 0 };     // of the first
  std::uint64_t frameBytes{ 0 }; // from a frame to the next; set by SetFramePlaces()
  std::uint64_t rowBytes{ 0 };   // from a row to the next; 0: bits run on from row to row
  std::uint64_t gapBytes{ 0 };   // behind each frame; behind the last they may be missing
  std::uint64_t endBytes{ 0 };   // behind all frames
  SampleFormat  sample{};
};

/** The bytes that \a samples pixels take, without a gap; nothing where they do not fill their last byte or group, or
 * cannot be counted. */
std::optional<std::uint64_t>
PackedBytes(const SampleFormat & format, std::uint64_t samples);

/** Sets where the frames of \a file are, whose size is known, and the reader of them. \a frames: how many there must
 * be; nothing: as many as the bytes hold. \a trailerBytes: bytes for each frame that may follow behind the last. Throws
 * FileError unless the bytes from places.offset on are exactly so many whole frames, with the bytes that \a places has
 * between and behind them. */
void
SetFramePlaces(FrameFile &                  file,
               FramePlaces                  places,
               std::uint64_t                fileBytes,
               std::optional<std::uint64_t> frames,
               std::uint64_t                trailerBytes = 0);

/** Reads frames from such places. */
class PackedFrames : public FrameReader
{
public:
  explicit PackedFrames(FramePlaces places)
    : m_Places(std::move(places))
  {}

  void
  Read(const FrameFile & file, std::size_t first, std::size_t count, void * buffer) const override;

private:
  FramePlaces m_Places;
};

} // namespace sensornoise

#endif
