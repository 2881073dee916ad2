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
#include "tools/ErrorText.h"

#include "itkMacro.h"

#include <algorithm>
#include <cstddef>

namespace sensornoise::tools
{

std::string
TextOf(const std::exception & error)
{
  const auto * const itkError = dynamic_cast<const itk::ExceptionObject *>(&error);
  if (itkError == nullptr)
  {
    return error.what();
  }
  // what() would name the line of the source, too
  std::string       text = itkError->GetDescription();
  const std::size_t address = text.find("): ");
  if ((text.rfind("itk::ERROR: ", 0) == 0 || text.rfind("ITK ERROR: ", 0) == 0) && address != std::string::npos)
  {
    text.erase(0, address + 3);
  }
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

} // namespace sensornoise::tools
