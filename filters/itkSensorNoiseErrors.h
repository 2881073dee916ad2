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

/** Calls \a function for its value; an error of the kind TError that is not ITK's becomes ITK's, in the name of \a
 * object and with \a prefix before its message. Others pass through. */
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

/** Whether an image has memory for the region that it says it holds. Without Allocate() it has none, and whoever reads
 * its pixels has to see to that. */
template <typename TImage>
bool
HasPixels(const TImage * image)
{
  const auto * const pixels = image->GetPixelContainer();
  return pixels && pixels->Size() >= image->GetBufferedRegion().GetNumberOfPixels();
}

/** Throws where an image, by \a name, has no memory for its pixels. */
template <typename TImage>
void
RequirePixels(const TImage * image, const char * name)
{
  if (!HasPixels(image))
  {
    throw std::invalid_argument(std::string(name) + " has a size but no pixels; expected an image that was allocated");
  }
}

/** Calls \a update, a part of the update of \a process, and resets the pipeline after an error: ITK would otherwise
 * take the next Update() for one that is under way, and return without a word and without a result, or with half of
 * one. */
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
