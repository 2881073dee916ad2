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
