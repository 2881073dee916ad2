// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef TerminalText_h
#define TerminalText_h

#include <string>

namespace sensornoise::tools
{

/** The text as standard output can show it: ASCII on a terminal whose character set, by LC_ALL, LC_CTYPE or LANG, is
 * not UTF-8; unchanged into files and pipes. */
std::string
ForStandardOutput(const std::string & text);

} // namespace sensornoise::tools

#endif
