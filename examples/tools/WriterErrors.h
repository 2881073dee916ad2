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
#ifndef WriterErrors_h
#define WriterErrors_h

#include "tools/ErrorSentence.h"
#include "tools/PendingFile.h"

#include <exception>
#include <stdexcept>
#include <string>

namespace sensornoise::tools
{

/** Calls \a write, which writes \a file under its temporary name: an error that names that one names its target
 * instead. */
template <typename TWrite>
void
WriteNamed(const PendingFile & file, TWrite write)
{
  try
  {
    write();
  }
  catch (const std::exception & error)
  {
    std::string       text = SentenceOf(error);
    const std::string temporary = file.Temporary().string();
    const auto        found = text.find(temporary);
    if (found == std::string::npos)
    {
      throw;
    }
    throw std::runtime_error("cannot write " + file.Target().name + ": " +
                             text.replace(found, temporary.size(), file.Target().name));
  }
}

} // namespace sensornoise::tools

#endif
