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
#include "tools/PendingFile.h"

#include <fstream>
#include <random>
#include <stdexcept>
#include <system_error>
#include <utility>

namespace sensornoise::tools
{
namespace fs = std::filesystem;

PendingFile::PendingFile(fs::path target)
  : m_Target(std::move(target))
{
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

PendingFile::~PendingFile()
{
  std::error_code ignored;
  fs::remove(m_Temporary, ignored);
}

void
PendingFile::Write(const std::string & text) const
{
  std::ofstream file(m_Temporary, std::ios::binary);
  if (!(file << text << std::flush))
  {
    throw std::runtime_error("cannot write " + m_Target.string() + ": " + std::to_string(text.size()) +
                             " bytes were not taken");
  }
}

void
PendingFile::RequireBytes(std::uintmax_t bytes) const
{
  if (fs::file_size(m_Temporary) < bytes)
  {
    throw std::runtime_error("cannot write " + m_Target.string() + ": the disk may be full");
  }
}

void
PendingFile::Commit()
{
  fs::rename(m_Temporary, m_Target);
}

} // namespace sensornoise::tools
