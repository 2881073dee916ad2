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
#ifndef SignalCleanup_h
#define SignalCleanup_h

#include <cstddef>
#include <string>

namespace sensornoise::tools
{

/** \class SignalCleanup
 * While it lives, a file, or a folder that is empty by then, is removed if a signal ends the program: INT, TERM, HUP,
 * PIPE, XFSZ and their like, and abort() in a library. The program then ends as the signal would have ended it. A
 * signal that is ignored (nohup) stays ignored. Otherwise nothing is removed: that is left to its owner.
 */
class SignalCleanup
{
public:
  /** \a path is absolute. What was named last is removed first. Throws std::runtime_error if there are too many. */
  explicit SignalCleanup(const std::string & path);
  SignalCleanup(const SignalCleanup &) = delete;
  SignalCleanup &
  operator=(const SignalCleanup &) = delete;
  ~SignalCleanup();

private:
  std::size_t m_Slot;
};

} // namespace sensornoise::tools

#endif
