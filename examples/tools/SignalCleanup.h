// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
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
