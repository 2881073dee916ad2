// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_base_LowerCase_h
#define sensornoise_base_LowerCase_h

#include <algorithm>
#include <cctype>
#include <string>

namespace sensornoise
{

/** Returns \a text with its ASCII letters in lower case. */
inline std::string
LowerCase(std::string text)
{
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char letter) {
    return static_cast<char>(std::tolower(letter));
  });
  return text;
}

} // namespace sensornoise

#endif
