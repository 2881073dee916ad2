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

/** Returns whether a text has digits alone: a whole number of 0 or more. */
bool
IsWholeNumber(const std::string & text);

/** Returns "" for a whole number of 0 or more, else the reason why the text is none. It is a check of CLI11, which
 * reads -1 as the largest number. */
std::string
ReasonNotWhole(const std::string & text);

/** Throws CLI::ValidationError if the value of an option is empty, or is another option, as in "--json --quiet". */
void
RequireValues(const CLI::App & app);

} // namespace sensornoise::tools

#endif
