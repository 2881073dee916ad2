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
#ifndef itkSensorNoiseFileErrors_h
#define itkSensorNoiseFileErrors_h

#include "sensornoise/FrameFile.h"
#include "itkImageIOBase.h"
#include "itkMacro.h"

#include <exception>

namespace itk
{

/** Returns the result of \a function. An exception that is not of ITK becomes an itk::ExceptionObject with the same
 * message. */
template <typename TFunction>
auto
WithFileErrors(TFunction function) -> decltype(function())
{
  try
  {
    return function();
  }
  catch (const ExceptionObject &)
  {
    throw;
  }
  catch (const std::exception & error)
  {
    throw ExceptionObject(__FILE__, __LINE__, error.what(), ITK_LOCATION);
  }
}

/** Returns the component type of ITK for the pixels of a frame. */
inline IOComponentEnum
ComponentTypeOf(sensornoise::FramePixel pixel)
{
  switch (pixel)
  {
    case sensornoise::FramePixel::UnsignedChar:
      return IOComponentEnum::UCHAR;
    case sensornoise::FramePixel::UnsignedShort:
      return IOComponentEnum::USHORT;
    case sensornoise::FramePixel::Short:
      return IOComponentEnum::SHORT;
    case sensornoise::FramePixel::Float:
      return IOComponentEnum::FLOAT;
    default:
      return IOComponentEnum::DOUBLE;
  }
}

} // namespace itk

#endif
