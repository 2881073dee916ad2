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
#ifndef PendingFile_h
#define PendingFile_h

#include <cstdint>
#include <filesystem>
#include <string>

namespace sensornoise::tools
{

/** A file under a temporary name beside its target: it takes the target's name when it is complete, and goes if not. */
class PendingFile
{
public:
  /** Throws std::runtime_error at once if \a target cannot be written. */
  explicit PendingFile(std::filesystem::path target);
  PendingFile(const PendingFile &) = delete;
  PendingFile &
  operator=(const PendingFile &) = delete;
  ~PendingFile();

  const std::filesystem::path &
  Target() const
  {
    return m_Target;
  }
  const std::filesystem::path &
  Temporary() const
  {
    return m_Temporary;
  }

  /** Writes \a text as the whole file; throws std::runtime_error if the disk does not take it. */
  void
  Write(const std::string & text) const;

  /** Throws std::runtime_error unless \a bytes, at least, have been written: some of ITK's writers do not look whether
   * the disk was full. */
  void
  RequireBytes(std::uintmax_t bytes) const;

  /** Gives the file its name. */
  void
  Commit();

private:
  std::filesystem::path m_Target;
  std::filesystem::path m_Temporary;
};

} // namespace sensornoise::tools

#endif
