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
#ifndef itkSensorNoiseErrors_h
#define itkSensorNoiseErrors_h

#include "itkMacro.h"
#include "itkProcessObject.h"

#include <exception>
#include <stdexcept>
#include <string>

namespace itk
{

/** Calls \a function and returns its value. An error of type TError that is not an ITK exception is rethrown as an
 * ExceptionObject. Its message names \a object and has \a prefix before the message of the error. Other errors pass
 * through. */
template <typename TError = std::exception, typename TFunction>
auto
WithItkErrors(const Object * object, TFunction function, const char * prefix = "") -> decltype(function())
{
  try
  {
    return function();
  }
  catch (const ExceptionObject &)
  {
    throw;
  }
  catch (const TError & error)
  {
    itkGenericExceptionMacro(<< object->GetNameOfClass() << '(' << object << "): " << prefix << error.what());
  }
}

/** Returns whether an image has memory for its buffered region. Without Allocate() it has no memory, and a caller that
 * reads the pixels has to check this first. */
template <typename TImage>
bool
HasPixels(const TImage * image)
{
  const auto * const pixels = image->GetPixelContainer();
  return pixels && pixels->Size() >= image->GetBufferedRegion().GetNumberOfPixels();
}

/** Throws std::invalid_argument if an image has no memory for its pixels. \a name is the name of the image in the
 * message. */
template <typename TImage>
void
RequirePixels(const TImage * image, const char * name)
{
  if (!HasPixels(image))
  {
    throw std::invalid_argument(std::string(name) + " has a size but no pixels; expected an image that was allocated");
  }
}

/** Calls \a update, a part of the update of \a process, and resets the pipeline after an error. ITK would otherwise
 * assume that the failed update is still in progress. The next Update() would then return without an error, and without
 * a result or with half of a result. */
template <typename TUpdate>
void
ResetAfterError(ProcessObject * process, TUpdate update)
{
  try
  {
    update();
  }
  catch (...)
  {
    process->ResetPipeline();
    throw;
  }
}

} // namespace itk

#endif
