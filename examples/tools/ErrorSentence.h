// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef ErrorSentence_h
#define ErrorSentence_h

#include <exception>
#include <string>

namespace sensornoise::tools
{

/** What an error says, in one line for people: also where a library says no more than "std::bad_alloc". */
std::string
SentenceOf(const std::exception & error);

} // namespace sensornoise::tools

#endif
