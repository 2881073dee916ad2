// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_moments_PassFrames_h
#define sensornoise_moments_PassFrames_h

#include "SensorNoiseExport.h"

#include <cstddef>
#include <cstdint>
#include <istream>
#include <ostream>
#include <vector>

namespace sensornoise
{

/** \class PassFrames
 * \brief The frames of the current pass over a stack that have been added, in this or another process. */
class SensorNoise_EXPORT PassFrames
{
public:
  explicit PassFrames(std::size_t frames);

  /** Number of the current pass, from 0. */
  unsigned int
  GetPass() const
  {
    return m_Pass;
  }

  /** Number of the frame that is to be added next. */
  std::size_t
  GetNext() const
  {
    return m_Next;
  }

  /** Marks the next \a count frames as added and returns the first. Throws std::logic_error if fewer are left, or if
   * one has been added before. */
  std::size_t
  Add(std::size_t count);

  /** Passes over the next \a count frames, which another process adds. Throws std::logic_error if fewer are left. */
  void
  Skip(std::size_t count);

  /** Makes frame \a t the next one. Throws std::logic_error if there is no such frame. */
  void
  GoTo(std::size_t t);

  /** Marks all frames of the pass as not added, and goes to frame 0. */
  void
  Forget();

  /** Returns 1 for every frame that has been added, else 0. */
  const std::vector<std::uint8_t> &
  GetHas() const
  {
    return m_Has;
  }

  /** Throws std::runtime_error if a frame has been added both here and to \a other. */
  void
  RequireApart(const PassFrames & other) const;

  /** Marks the frames of \a other as added. Throws std::runtime_error if one has been added here, too. */
  void
  Merge(const PassFrames & other);

  /** Ends the pass. Throws std::logic_error if a frame is missing. */
  void
  EndPass();

  /** Writes the pass and its frames, see BinaryStream. */
  void
  Save(std::ostream & out) const;
  /** Reads the frames of a stream, of the same pass. Throws std::runtime_error if it is of another pass. */
  PassFrames
  ReadOther(std::istream & in) const;

private:
  std::vector<std::uint8_t> m_Has;
  std::size_t               m_Next{ 0 };
  unsigned int              m_Pass{ 0 };
};

} // namespace sensornoise

#endif
