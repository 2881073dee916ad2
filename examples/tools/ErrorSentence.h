/*=========================================================================
 *
 *  Copyright the ITKSensorNoise contributors
 *
 *  Licensed under the Apache License, Version 2.0 (the "License");
 *  you may not use this file except in compliance with the License.
 *  You may obtain a copy of the License at
 *
 *         https://www.apache.org/licenses/LICENSE-2.0.txt
 *
 *  Unless required by applicable law or agreed to in writing, software
 *  distributed under the License is distributed on an "AS IS" BASIS,
 *  WITHOUT WARRANTIES OR CONDITIONS OF ANY KIND, either express or implied.
 *  See the License for the specific language governing permissions and
 *  limitations under the License.
 *
 *=========================================================================*/
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
