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

/** Returns the message that there is no option \a word, with the most similar option. */
std::string
UnknownOption(const CLI::App & app, const std::string & word);

/** Throws CLI::ValidationError if the value of an option is empty, or is another option, as in "--json --quiet". */
void
RequireValues(const CLI::App & app);

} // namespace sensornoise::tools

#endif
