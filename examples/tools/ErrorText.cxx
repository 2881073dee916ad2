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
#include "input/ErrorText.h"

#include "itkMacro.h"

#include <algorithm>
#include <cstddef>

namespace sensornoise::tools
{
namespace
{
/** The end of "itk::ERROR: Class(address): ". */
std::size_t
StartOfWords(const std::string & description)
{
  const std::size_t address = description.find("): ");
  return address == std::string::npos ? 0 : address + 3;
}
} // namespace

std::string
TextOf(const std::exception & error)
{
  const auto * const itkError = dynamic_cast<const itk::ExceptionObject *>(&error);
  if (itkError == nullptr)
  {
    return error.what();
  }
  // what() would name the line of the source, too
  std::string text = itkError->GetDescription();
  text.erase(0, StartOfWords(text));
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

std::string
CauseOf(const itk::ExceptionObject & error)
{
  const std::string text = error.GetDescription();
  const std::size_t nrrd = text.rfind("[nrrd]");
  const std::size_t start = nrrd != std::string::npos ? nrrd : StartOfWords(text);
  return text.substr(start, text.find('\n', start) - start);
}

std::string
PixelErrorOf(const std::string & file, const itk::ExceptionObject & error)
{
  return file + ": its pixels cannot be read; " + CauseOf(error);
}

} // namespace sensornoise::tools
