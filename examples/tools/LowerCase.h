// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef LowerCase_h
#define LowerCase_h

#include "base/Text.h"

#include <filesystem>
#include <string>

namespace sensornoise::tools
{

/** Returns the file name extension in lower case: ".tif" for "Frame.TIF". */
inline std::string
LowerCaseEnding(const std::filesystem::path & file)
{
  return LowerCase(file.extension().string());
}

} // namespace sensornoise::tools

#endif
