/*=========================================================================
 *
 *  Copyright the ITKSensorNoise contributors
 *
 *  Licensed under the Apache License, Version 2.0 (the "License");
 *  you may not use this file except in compliance with the License.
 *  You may obtain a copy of the License at
 *
 *         https://www.apache.org/licenses/LICENSE-2.0.txt
 *
 *  Unless required by applicable law or agreed to in writing, software
 *  distributed under the License is distributed on an "AS IS" BASIS,
 *  WITHOUT WARRANTIES OR CONDITIONS OF ANY KIND, either express or implied.
 *  See the License for the specific language governing permissions and
 *  limitations under the License.
 *
 *=========================================================================*/
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

  /** The next \a count frames are added: returns the first. Throws std::logic_error if there are not so many left, or
   * one has been added before. */
  std::size_t
  Add(std::size_t count);

  /** The next \a count frames are added elsewhere. */
  void
  Skip(std::size_t count);

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
