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

#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <utility>

namespace sensornoise::tools
{

/** A file under a temporary name beside its target: it takes the target's name when it is complete, and goes if not. */
class PendingFile
{
public:
  /** Throws std::runtime_error at once if \a target cannot be written. */
  explicit PendingFile(std::filesystem::path target)
    : m_Target(std::move(target))
  {
    namespace fs = std::filesystem;
    const fs::path folder = m_Target.has_parent_path() ? m_Target.parent_path() : fs::path(".");
    if (!fs::is_directory(folder))
    {
      throw std::runtime_error("cannot write " + m_Target.string() + ": there is no folder " + folder.string());
    }
    if (fs::is_directory(m_Target))
    {
      throw std::runtime_error("cannot write " + m_Target.string() + ": it is a folder");
    }
    const std::string unique = std::to_string(std::random_device{}());
    m_Temporary = folder / ("." + m_Target.stem().string() + "." + unique + m_Target.extension().string());
    if (!std::ofstream(m_Temporary))
    {
      throw std::runtime_error("cannot write " + m_Target.string() + ": no file can be made in folder " +
                               folder.string());
    }
  }
  PendingFile(const PendingFile &) = delete;
  PendingFile &
  operator=(const PendingFile &) = delete;
  ~PendingFile()
  {
    std::error_code ignored;
    std::filesystem::remove(m_Temporary, ignored);
  }

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
  Write(const std::string & text) const
  {
    std::ofstream file(m_Temporary, std::ios::binary);
    if (!(file << text << std::flush))
    {
      throw std::runtime_error("cannot write " + m_Target.string() + ": " + std::to_string(text.size()) +
                               " bytes were not taken");
    }
  }

  /** Gives the file its name. */
  void
  Commit()
  {
    std::filesystem::rename(m_Temporary, m_Target);
  }

private:
  std::filesystem::path m_Target;
  std::filesystem::path m_Temporary;
};

} // namespace sensornoise::tools

#endif
