// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef SignalCleanup_h
#define SignalCleanup_h

#include <cstddef>
#include <string>

namespace sensornoise::tools
{

/** \class SignalCleanup
 * Removes a file or an empty folder if a signal ends the program while the object exists. The signals include INT,
 * TERM, HUP, PIPE and XFSZ, and ABRT, which a library raises by abort(). The program then ends with the default
 * action of the signal. A signal that is ignored (nohup) stays ignored. The destructor removes nothing: the owner of
 * the file does.
 */
class SignalCleanup
{
public:
  /** Registers \a path, which must be absolute. The path with the highest slot, usually the last one, is removed
   * first. Throws std::runtime_error if the path is too long, or too many paths are registered. */
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
