// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "tools/ErrorSentence.h"

// The page in a browser is compiled without ITK.
#if defined(__has_include) && __has_include("itkMacro.h")
#  include "itkMacro.h"
#  define SENSORNOISE_HAS_ITK
#endif

#include <algorithm>
#include <array>
#include <cstddef>
#include <filesystem>
#include <new>
#include <stdexcept>
#include <string>

namespace sensornoise::tools
{
namespace
{
/** Returns the message of an exception. The message of an ITK exception becomes one line without the prefix of class
 * and address. */
std::string
TextOf(const std::exception & error)
{
#ifdef SENSORNOISE_HAS_ITK
  if (const auto * const itkError = dynamic_cast<const itk::ExceptionObject *>(&error))
  {
    // what() also names the line of the source
    std::string       text = itkError->GetDescription();
    const std::size_t address = text.find("): ");
    if ((text.rfind("itk::ERROR: ", 0) == 0 || text.rfind("ITK ERROR: ", 0) == 0) && address != std::string::npos)
    {
      text.erase(0, address + 3);
    }
    std::replace(text.begin(), text.end(), '\n', ' ');
    return text;
  }
#endif
  return error.what();
}

/** Returns whether an allocation failed in ITK or in the C++ library, which report it in different words. */
bool
IsOutOfMemory(const std::exception & error, const std::string & text)
{
  const std::array<const char *, 5> words{ "Failed to allocate memory", "bad_alloc", "max_size()", "_M_", "bad array" };
  return dynamic_cast<const std::bad_alloc *>(&error) != nullptr ||
         std::any_of(
           words.begin(), words.end(), [&text](const char * word) { return text.find(word) != std::string::npos; });
}
} // namespace

std::string
SentenceOf(const std::exception & error)
{
  if (const auto * const file = dynamic_cast<const std::filesystem::filesystem_error *>(&error))
  {
    return file->path1().string() + ": " + file->code().message();
  }
  std::string text = TextOf(error);
  if (IsOutOfMemory(error, text))
  {
    return "there is not enough memory for images of this size; expected smaller ones (--roi, --frames, --size), or "
           "more memory";
  }
  if (text.find(": truncated") != std::string::npos || text.find(": damaged") != std::string::npos)
  {
    return text + ". Copy the file again, or leave it out";
  }
  return text;
}

} // namespace sensornoise::tools
