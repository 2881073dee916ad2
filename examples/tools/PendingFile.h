// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef PendingFile_h
#define PendingFile_h

#include "tools/OutputTarget.h"
#include "tools/SignalCleanup.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

namespace sensornoise::tools
{

/** \class PendingFile
 * A file under a temporary name: it takes its target's name when it is complete, and goes if not, also if a signal ends
 * the program. A file that is replaced hands on its permissions; of a symbolic link the file that it leads to is
 * replaced. Pipes, devices and open descriptors are not replaced: what is complete is copied into them.
 */
class PendingFile
{
public:
  /** Throws std::runtime_error at once if \a target cannot be written. */
  explicit PendingFile(const std::string & target);
  PendingFile(const PendingFile &) = delete;
  PendingFile &
  operator=(const PendingFile &) = delete;
  ~PendingFile();

  /** Beside the target, and with its ending, by which ITK's writers tell the format. */
  const std::filesystem::path &
  Temporary() const
  {
    return m_Temporary;
  }
  const OutputTarget &
  Target() const
  {
    return m_Target;
  }

  /** Writes \a text as the whole file; throws std::runtime_error if the disk does not take it. */
  void
  Write(const std::string & text) const;

  /** Throws std::runtime_error if the disk has no room for \a bytes. A double: a product of sizes may be beyond every
   * integer. */
  void
  RequireRoom(double bytes) const;

  /** Throws std::runtime_error unless \a bytes, at least, have been written: some of ITK's writers do not look whether
   * the disk was full. */
  void
  RequireBytes(std::uintmax_t bytes) const;

  /** Gives the file its name. Throws std::runtime_error if that cannot be done. */
  void
  Commit();

private:
  /** Opens the temporary file; a negative number, and errno, if that fails. */
  int
  OpenTemporary(int flags) const;
  /** For what is not replaced. */
  void
  CopyToTarget() const;
  [[noreturn]] void
  Fail(const std::string & why) const;

  OutputTarget                 m_Target;
  std::filesystem::path        m_Temporary;
  std::optional<SignalCleanup> m_AtSignal;
};

} // namespace sensornoise::tools

#endif
