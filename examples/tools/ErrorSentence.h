// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef ErrorSentence_h
#define ErrorSentence_h

#include <exception>
#include <string>

namespace sensornoise::tools
{

/** Returns an error as one line for users, also if a library reports only "std::bad_alloc". */
std::string
SentenceOf(const std::exception & error);

} // namespace sensornoise::tools

#endif
