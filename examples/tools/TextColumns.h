// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef TextColumns_h
#define TextColumns_h

#include <optional>
#include <string>
#include <vector>

namespace sensornoise::tools
{

/** Returns the text without blanks and line breaks at its ends. */
std::string
Trim(const std::string & text);

/** Returns the parts between any of the \a separators, trimmed. A part may be empty. */
std::vector<std::string>
SplitColumns(const std::string & text, const char * separators);

/** Returns the whole word as a finite number; empty: it is none. */
std::optional<double>
NumberOf(const std::string & word);

/** Returns the lines of a text file, trimmed, without a byte order mark of UTF-8. Throws std::runtime_error, with \a
 * expected, if the file cannot be read. */
std::vector<std::string>
ReadLines(const std::string & file, const std::string & expected);

} // namespace sensornoise::tools

#endif
