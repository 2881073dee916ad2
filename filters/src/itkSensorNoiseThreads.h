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
#ifndef itkSensorNoiseThreads_h
#define itkSensorNoiseThreads_h

#include "itkMultiThreaderBase.h"
#include "sensornoise/Parallel.h"

#include <cstddef>
#include <functional>

namespace itk
{

/** Returns loops over the threads of ITK. \a workUnits is their number; 0: ITK's default. */
inline sensornoise::ParallelFor
SensorNoiseThreads(ThreadIdType workUnits = 0)
{
  return [workUnits](std::size_t count, const std::function<void(std::size_t)> & function) {
    const auto threader = MultiThreaderBase::New();
    if (workUnits > 0)
    {
      threader->SetNumberOfWorkUnits(workUnits);
    }
    threader->ParallelizeArray(0, count, [&function](SizeValueType i) { function(i); }, nullptr);
  };
}

} // namespace itk

#endif
