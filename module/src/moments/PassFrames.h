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
 * \brief Which frames of the current pass over a stack have been added, here or elsewhere. */
class SensorNoise_EXPORT PassFrames
{
public:
  explicit PassFrames(std::size_t frames);

  /** The current pass, from 0. */
  unsigned int
  GetPass() const
  {
    return m_Pass;
  }

  /** The frame that is to be added next. */
  std::size_t
  GetNext() const
  {
    return m_Next;
  }

  /** The next \a count frames are added: returns the first. Throws std::logic_error if there are not so many left, or
   * one has been added before. */
  std::size_t
  Add(std::size_t count);

  /** The next \a count frames are added elsewhere. */
  void
  Skip(std::size_t count);

  /** Frame \a t is the next one. Throws std::logic_error if there is none. */
  void
  GoTo(std::size_t t);

  /** No frame of the pass has been added. */
  void
  Forget();

  /** For every frame, 1 if it has been added. */
  const std::vector<std::uint8_t> &
  GetHas() const
  {
    return m_Has;
  }

  /** Throws std::runtime_error if \a other has frames that are here, too. */
  void
  RequireApart(const PassFrames & other) const;

  /** Takes over the frames of \a other. */
  void
  Merge(const PassFrames & other);

  /** Ends the pass. Throws std::logic_error if a frame is missing. */
  void
  EndPass();

  /** Writes the pass and its frames, see BinaryStream. */
  void
  Save(std::ostream & out) const;
  /** The frames of a stream, of the same pass. Throws std::runtime_error if it is another one. */
  PassFrames
  ReadOther(std::istream & in) const;

private:
  std::vector<std::uint8_t> m_Has;
  std::size_t               m_Next{ 0 };
  unsigned int              m_Pass{ 0 };
};

} // namespace sensornoise

#endif
