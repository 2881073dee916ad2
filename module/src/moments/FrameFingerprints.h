// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_moments_FrameFingerprints_h
#define sensornoise_moments_FrameFingerprints_h

#include "SensorNoiseExport.h"
#include "base/BytesFingerprint.h"
#include "moments/DistinctFrames.h"

#include <cstddef>
#include <cstdint>
#include <istream>
#include <map>
#include <ostream>
#include <vector>

namespace sensornoise
{

/** \class FrameFingerprints
 * \brief The fingerprints of the frames of a stack, which tell those that are equal, bit by bit: NaN are bits, too, and
 * 0 and -0 differ.
 *
 * A recorder that runs faster than its camera writes equal frames. Their noise is the same: counted as often as they
 * are there, they would make errors too small, and no two exposures of any camera are equal in all pixels by chance.
 *
 * Memory: about 90 bytes a frame. */
class SensorNoise_EXPORT FrameFingerprints
{
public:
  explicit FrameFingerprints(std::size_t frames);

  /** Frames where \a areCountedElsewhere, of a value for each, is not 0 are taken up and not counted: they equal one
   * that another process counts. Throws std::invalid_argument if there are not as many values as frames. */
  void
  SetCountedElsewhere(const std::vector<std::uint8_t> & areCountedElsewhere);

  /** Takes up the fingerprints of frame \a first and those that follow. Returns 1 for the frames that are to be
   * counted, as they equal none that was counted before, 0 for the others. */
  std::vector<std::uint8_t>
  Add(std::size_t first, const std::vector<BytesFingerprint> & fingerprints);

  /** Throws std::runtime_error if a frame equals one of \a other: both have counted it. */
  void
  RequireApart(const FrameFingerprints & other) const;

  /** Takes up the frames of \a other, of the same stack. */
  void
  Merge(const FrameFingerprints & other);

  /** Writes the frames that were taken up and their fingerprints, see BinaryStream. */
  void
  Save(std::ostream & out) const;
  /** Those of a stream, of the same stack. Throws std::runtime_error if it ends early or does not hold them. */
  FrameFingerprints
  ReadOther(std::istream & in) const;

  /** Those that were taken up, by their frames. */
  const std::map<std::size_t, BytesFingerprint> &
  GetAll() const
  {
    return m_OfFrame;
  }

  /** Which frames are equal, when all have been taken up. It does not depend on who took up which. Throws
   * std::logic_error if one was left to another process, and none counted it. */
  DistinctFrames
  FindDistinct() const;

private:
  /** Frames that are equal. */
  struct Equal
  {
    std::size_t first;
    bool        isCounted;
  };

  void
  TakeUp(std::size_t t, const BytesFingerprint & fingerprint, bool isCounted);

  std::size_t                             m_Frames;
  std::map<std::size_t, BytesFingerprint> m_OfFrame;
  std::map<BytesFingerprint, Equal>       m_Equal;
  std::vector<std::uint8_t>               m_CountedElsewhere; // of each frame; empty: none
};

} // namespace sensornoise

#endif
