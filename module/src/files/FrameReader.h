// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_files_FrameReader_h
#define sensornoise_files_FrameReader_h

#include "SensorNoiseExport.h"
#include "sensornoise/FrameFile.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace sensornoise
{

struct FrameFile;

/** Reads frames of an inspected file, a few at a time. */
class FrameReader
{
public:
  FrameReader() = default;
  virtual ~FrameReader() = default;
  FrameReader(const FrameReader &) = delete;
  FrameReader &
  operator=(const FrameReader &) = delete;

  /** Reads \a count frames from the frame \a first on into \a buffer, which has space for so many frames of type
   * file.pixel. Uncompressed frames need at most about 2 MiB of memory beside the buffer, or a tile of a TIFF. Throws
   * FileError if the file has changed so that the frames cannot be read; RequireUnchanged() detects other changes. May
   * be called from several threads at once. */
  virtual void
  Read(const FrameFile & file, std::size_t first, std::size_t count, void * buffer) const = 0;

  /** Returns whether frames can be read fast only in their order, as from one compressed stream. Several threads would
   * then wait for each other. */
  virtual bool
  IsSequential() const
  {
    return false;
  }
};

/** Packing of the bits of successive pixels into bytes. */
enum class SamplePacking
{
  Whole,        ///< each pixel has its own bytes
  LowestFirst,  ///< bit stream, lowest bit first: GenICam's Mono10p, Mono12p, Mono14p
  HighestFirst, ///< bit stream, highest bit first: Photron's .mraw
  GigE,         ///< two pixels in three bytes, their low bits in the middle byte: GigE Vision's Mono12Packed
  Mipi          ///< the 8 high bits of 2 or 4 pixels, then the low bits of all: MIPI CSI-2's RAW10, RAW12, RAW14
};

/** Format of the pixels in a file. */
struct SampleFormat
{
  FramePixel    pixel{ FramePixel::UnsignedShort }; ///< type of the pixels that are read
  SamplePacking packing{ SamplePacking::Whole };
  bool          isBigEndian{ false }; ///< whether the highest byte is first; for Whole
  unsigned      bits{ 16 }; ///< bits of a pixel in a bit stream; for Whole the bit depth, if a format gives it
  StoredNumber  stored{ StoredNumber::SameAsPixel }; ///< type of the numbers in the file; for Whole
};

/** Returns the format of whole pixels of the type of \a file. */
SampleFormat
WholeSample(const FrameFile & file, bool isBigEndian);

/** Returns the smallest number of pixels that fill whole bytes. */
SensorNoise_EXPORT std::size_t
SamplesInGroup(const SampleFormat & format);

/** Returns the size of a group of SamplesInGroup() pixels [bytes]. */
SensorNoise_EXPORT std::size_t
BytesInGroup(const SampleFormat & format);

/** Unpacks \a groups groups of pixels into \a pixels of type format.pixel, in the byte order of this machine. */
SensorNoise_EXPORT void
UnpackSamples(const SampleFormat & format, const unsigned char * bytes, std::size_t groups, void * pixels);

/** Reverses the bytes of each pixel unless \a isBigEndian is the byte order of this machine. */
void
ToOwnByteOrder(bool isBigEndian, std::size_t bytesOfPixel, std::size_t count, void * pixels);

/** Places of the frames of a file: one after the other, at equal distances. Distances and offsets are in bytes. */
struct FramePlaces
{
  std::string   path{};          // path of the file that has the frames
  std::uint64_t offset{ 0 };     // offset of the first frame
  std::uint64_t frameBytes{ 0 }; // distance of two frames; set by SetFramePlaces()
  std::uint64_t rowBytes{ 0 };   // distance of two rows; 0: the bits of the next row follow without a gap
  std::uint64_t gapBytes{ 0 };   // gap behind each frame; behind the last frame it may be missing
  std::uint64_t endBytes{ 0 };   // bytes behind all frames
  SampleFormat  sample{};
};

/** Returns the size of \a samples pixels without gaps [bytes]; none if they do not fill whole groups, or if it exceeds
 * INT64_MAX. */
std::optional<std::uint64_t>
PackedBytes(const SampleFormat & format, std::uint64_t samples);

/** Sets the places of the frames of \a file, whose width and height are set, its size and its reader. \a fileBytes:
 * size of the file [bytes]. \a frames: required number of frames; none: as many as the file has. \a trailerBytes: bytes
 * for each frame that may follow the last frame. Throws FileError unless the bytes from places.offset on are exactly so
 * many whole frames, with the bytes that \a places has between and behind them. */
void
SetFramePlaces(FrameFile &                  file,
               FramePlaces                  places,
               std::uint64_t                fileBytes,
               std::optional<std::uint64_t> frames,
               std::uint64_t                trailerBytes = 0);

/** Reads uncompressed frames from FramePlaces. */
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
