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
 * \brief Fingerprints of the frames of a stack, which identify frames that are equal bit by bit: NaN are compared as
 * bits, and 0 and -0 differ.
 *
 * A recorder that runs faster than its camera writes equal frames. They have the same noise; if each was counted, the
 * estimated errors would be too small. Two exposures of a camera are never equal in all pixels by chance.
 *
 * Memory: about 90 bytes per frame. */
class SensorNoise_EXPORT FrameFingerprints
{
public:
  explicit FrameFingerprints(std::size_t frames);

  /** Marks frames that another process counts. Frames with a nonzero value in \a areCountedElsewhere are registered and
   * not counted: they equal a frame that another process counts. Throws std::invalid_argument if there are not as many
   * values as frames. */
  void
  SetCountedElsewhere(const std::vector<std::uint8_t> & areCountedElsewhere);

  /** Registers the fingerprints of frame \a first and those that follow. Returns 1 for the frames that are to be
   * counted, as they equal none that was counted before, and 0 for the others. */
  std::vector<std::uint8_t>
  Add(std::size_t first, const std::vector<BytesFingerprint> & fingerprints);

  /** Throws std::runtime_error if both this object and \a other have counted the same frame, or equal ones. */
  void
  RequireApart(const FrameFingerprints & other) const;

  /** Registers the frames of \a other, of the same stack. */
  void
  Merge(const FrameFingerprints & other);

  /** Writes the registered frames and their fingerprints, see BinaryStream. */
  void
  Save(std::ostream & out) const;
  /** Returns the fingerprints that a stream holds, of the same stack. Throws std::runtime_error if it ends early or
   * does not hold them. */
  FrameFingerprints
  ReadOther(std::istream & in) const;

  /** Returns the registered fingerprints by frame number. */
  const std::map<std::size_t, BytesFingerprint> &
  GetAll() const
  {
    return m_OfFrame;
  }

  /** Returns which frames are equal, after all have been registered. The result does not depend on which process
   * registered which frame. Throws std::logic_error if a frame was left to another process, and no process counted it.
   */
  DistinctFrames
  FindDistinct() const;

private:
  /** Frames that are equal: the number of the first one, and whether one of them is counted. */
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
  std::vector<std::uint8_t>               m_CountedElsewhere; // one value for each frame; empty: none
};

} // namespace sensornoise

#endif
