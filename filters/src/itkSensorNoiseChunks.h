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
#include "base/FramesTogether.h"

#include <algorithm>

namespace itk
{

/** Bytes of a stack that are read at a time: 32 MiB, unless sensornoise::FramesTogether take more. Set by hand: far
 * above the caches, so that half and twice cost the same time, and small beside the maps of a large frame. */
inline constexpr SizeValueType SensorNoiseChunkBytes = SizeValueType{ 32 } << 20;

/** Bytes of a stack in memory that are worked on at a time, so that observers see the progress grow: 128 MiB. Set by
 * hand: with half of it temporal statistics take 14 % longer, all at once 12 % less. */
inline constexpr SizeValueType SensorNoisePieceBytes = SizeValueType{ 128 } << 20;

/** How many frames of \a frameBytes bytes make a chunk, or another part of \a bytes bytes. */
inline SizeValueType
SensorNoiseFramesPerChunk(SizeValueType frameBytes, SizeValueType bytes = SensorNoiseChunkBytes)
{
  return std::max<SizeValueType>(sensornoise::FramesTogether, bytes / std::max<SizeValueType>(1, frameBytes));
}

} // namespace itk

#endif
