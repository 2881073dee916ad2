// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef TextColumns_h
#define TextColumns_h

#include <optional>
#include <string>
#include <vector>

namespace sensornoise::tools
{

/** Returns the text without blanks and line ends at its beginning and end. */
std::string
Trim(const std::string & text);

/** Returns the trimmed parts of a line between any of the characters \a separators. There is one or more. */
std::vector<std::string>
Split(const std::string & text, const char * separators);

/** Returns the number that a word is. It is empty if the word is no number. */
std::optional<double>
NumberOf(const std::string & word);

} // namespace sensornoise::tools

#endif
