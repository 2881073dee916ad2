// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_tools_OptionHints_h
#define sensornoise_tools_OptionHints_h

#include <string>

namespace CLI
{
class App;
}

namespace sensornoise::tools
{

/** Says that there is no option \a word, and which one may be meant. */
std::string
UnknownOption(const CLI::App & app, const std::string & word);

/** Throws CLI::ValidationError where an option has no value, or another option as its value, as in
 * "--json --quiet". */
void
RequireValues(const CLI::App & app);

} // namespace sensornoise::tools

#endif
