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
#include "itkSensorNoiseProfileFile.h"

#include "itkSensorNoiseFrameFiles.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <stdexcept>
#include <system_error>

namespace sensornoise
{
namespace
{
/** Largest profile: a TIFF file has offsets of 32 bits [bytes]. */
constexpr std::uintmax_t mostProfileBytes = std::uintmax_t{ 1 } << 32U;
} // namespace

std::string
ReadProfileBytes(const std::string & file)
{
  std::error_code ignored;
  std::ifstream   stream(file, std::ios::binary);
  if (!std::filesystem::is_regular_file(file, ignored) || !stream)
  {
    throw std::runtime_error("the profile " + file +
                             " cannot be read (--check-profile); expected a DNG file, a JSON file or another profile");
  }
  const auto size = std::filesystem::file_size(file, ignored);
  if (size > mostProfileBytes)
  {
    throw std::runtime_error("the profile " + file + " has " + std::to_string(size) +
                             " bytes (--check-profile); expected a DNG file or another profile of at most 4 GiB");
  }
  std::string bytes{ std::istreambuf_iterator<char>(stream), {} };
  if (bytes.rfind("\xef\xbb\xbf", 0) == 0) // the byte order mark of UTF-8
  {
    bytes.erase(0, 3);
  }
  return bytes;
}

bool
IsJsonProfile(const std::string & bytes)
{
  const std::size_t first = bytes.find_first_not_of(" \t\r\n");
  return first != std::string::npos && (bytes[first] == '{' || bytes[first] == '[');
}

void
FillProfileLevels(const NoiseProfile & profile, CameraNoise & noise)
{
  if (profile.format != "dng" || (noise.blackLevelDn && noise.whiteLevelDn))
  {
    return;
  }
  try
  {
    const CameraSettings camera = OpenFrames({ profile.file }).camera;
    const auto           fill = [](std::optional<double> & level, double recorded) {
      level = level || !std::isfinite(recorded) ? level : std::optional<double>(recorded);
    };
    fill(noise.blackLevelDn, camera.blackLevelDn);
    fill(noise.whiteLevelDn, camera.whiteLevelDn);
  }
  catch (const std::exception &) // the numbers as text, or a copy without pixels: the levels are asked for
  {
    return;
  }
}

} // namespace sensornoise
