// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "tools/TerminalText.h"

#include "base/Text.h"
#include "tools/LowerCase.h"

#include <cstdlib>
#include <unistd.h>

namespace sensornoise::tools
{
namespace
{
/** Returns whether the character set is UTF-8. As in POSIX, the first of LC_ALL, LC_CTYPE and LANG that is set
 * determines it. */
bool
IsUtf8()
{
  for (const char * const name : { "LC_ALL", "LC_CTYPE", "LANG" })
  {
    const char * const value = std::getenv(name); // NOLINT(concurrency-mt-unsafe)
    if (value != nullptr && *value != '\0')
    {
      const std::string locale = LowerCase(value);
      return locale.find("utf-8") != std::string::npos || locale.find("utf8") != std::string::npos;
    }
  }
  return false;
}

/** Returns the text, in ASCII if \a descriptor is a terminal whose character set is not UTF-8. */
std::string
ForStream(int descriptor, const std::string & text)
{
  return isatty(descriptor) != 0 && !IsUtf8() ? WithoutSigns(text) : text;
}
} // namespace

std::string
ForStandardOutput(const std::string & text)
{
  return ForStream(STDOUT_FILENO, text);
}

std::string
ForStandardError(const std::string & text)
{
  return ForStream(STDERR_FILENO, text);
}

} // namespace sensornoise::tools
