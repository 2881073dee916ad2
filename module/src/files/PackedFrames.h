// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_files_PackedFrames_h
#define sensornoise_files_PackedFrames_h

#include "files/FrameReader.h"
#include "files/SamplePacking.h"

#include <cstdint>
#include <optional>
#include <string>
#include <utility>

namespace sensornoise
{

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
