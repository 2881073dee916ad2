// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_base_LowerCase_h
#define sensornoise_base_LowerCase_h

#include <algorithm>
#include <string>

namespace sensornoise
{

/** Returns \a text with its ASCII letters in lower case, in every locale. */
inline std::string
LowerCase(std::string text)
{
  std::transform(text.begin(), text.end(), text.begin(), [](char letter) {
    return letter >= 'A' && letter <= 'Z' ? static_cast<char>(letter - 'A' + 'a') : letter;
  });
  return text;
}

} // namespace sensornoise

#endif
