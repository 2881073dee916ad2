// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef TerminalText_h
#define TerminalText_h

#include <string>

namespace sensornoise::tools
{

/** Returns the text as standard output can show it. It becomes ASCII on a terminal whose character set, by LC_ALL,
 * LC_CTYPE or LANG, is not UTF-8. It is unchanged for files and pipes. */
std::string
ForStandardOutput(const std::string & text);

/** Returns the text as standard error can show it, by the rule of ForStandardOutput(). */
std::string
ForStandardError(const std::string & text);

} // namespace sensornoise::tools

#endif
