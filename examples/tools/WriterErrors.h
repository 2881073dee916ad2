// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef WriterErrors_h
#define WriterErrors_h

#include "tools/ErrorSentence.h"
#include "tools/PendingFile.h"

#include <exception>
#include <stdexcept>
#include <string>

namespace sensornoise::tools
{

/** Calls \a write, which writes \a file under its temporary name. If an error names the temporary file, it throws an
 * error that names the target instead. */
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
