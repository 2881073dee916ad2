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
 * File under a temporary name. It gets the name of its target when it is complete, and is removed otherwise, also if
 * a signal ends the program. A file that is replaced passes on its permissions. If the target is a symbolic link,
 * the file that it leads to is replaced. Pipes, devices and open descriptors are not replaced: the complete file is
 * copied into them.
 */
class PendingFile
{
public:
  /** Makes the temporary file. Throws std::runtime_error if \a target cannot be written. */
  explicit PendingFile(const std::string & target);
  PendingFile(const PendingFile &) = delete;
  PendingFile &
  operator=(const PendingFile &) = delete;
  ~PendingFile();

  /** Returns the temporary name. The file is in the folder of the target, or in the folder of temporary files if the
   * target is not replaced. It has the extension of the target, from which ITK's writers determine the format. */
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

  /** Writes \a text as the whole file. Throws std::runtime_error if the disk does not take it. */
  void
  Write(const std::string & text) const;

  /** Throws std::runtime_error if the disk has no room for \a bytes. The type is double because a product of sizes
   * may exceed every integer type. */
  void
  RequireRoom(double bytes) const;

  /** Throws std::runtime_error unless at least \a bytes were written. Some of ITK's writers do not check whether the
   * disk is full. */
  void
  RequireBytes(std::uintmax_t bytes) const;

  /** Gives the file its name, or copies it into a target that is not replaced. Throws std::runtime_error if this
   * fails. */
  void
  Commit();

private:
  /** Opens the temporary file. Returns a negative number, and sets errno, if this fails. */
  int
  OpenTemporary(int flags) const;
  /** Copies the file into a pipe, a device or an open descriptor. */
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
