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
#ifndef itkSensorNoiseChunks_h
#define itkSensorNoiseChunks_h

#include "itkIntTypes.h"
#include "base/Simd.h"

#include <algorithm>

namespace itk
{

/** Size of a chunk, the part of a stack that is read at a time: 32 MiB, or sensornoise::FramesTogether frames if these
 * are larger [bytes]. Chosen empirically: half and twice the size take the same time, as both are far above the caches,
 * and the chunk is small compared with the maps of a large frame. */
inline constexpr SizeValueType SensorNoiseChunkBytes = SizeValueType{ 32 } << 20;

/** Size of the part of a stack in memory that is processed between two progress events: 128 MiB [bytes]. Chosen
 * empirically on the time of temporal statistics: half the size takes 14 % longer, the whole stack at once 12 % less.
 */
inline constexpr SizeValueType SensorNoisePieceBytes = SizeValueType{ 128 } << 20;

/** Returns the number of frames of \a frameBytes bytes in a chunk, or in another part of \a bytes bytes. It is at least
 * sensornoise::FramesTogether. */
inline SizeValueType
SensorNoiseFramesPerChunk(SizeValueType frameBytes, SizeValueType bytes = SensorNoiseChunkBytes)
{
  return std::max<SizeValueType>(sensornoise::FramesTogether, bytes / std::max<SizeValueType>(1, frameBytes));
}

} // namespace itk

#endif
