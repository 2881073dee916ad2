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
#include "sensornoise/moments/StackRequirements.h"

#include "sensornoise/base/FrameGeometry.h"

#include <stdexcept>
#include <string>

namespace sensornoise
{

void
RequireStack(const FrameGeometry & geometry, std::size_t frames, std::size_t maskPixels)
{
  if (frames < MinimumFrames)
  {
    throw std::invalid_argument("the stack has " + std::to_string(frames) + " frames; expected at least " +
                                std::to_string(MinimumFrames));
  }
  if (geometry.width < 3 || geometry.height < 3)
  {
    throw std::invalid_argument("the frames have " + std::to_string(geometry.width) + " x " +
                                std::to_string(geometry.height) + " pixels; expected at least 3 x 3");
  }
  if (maskPixels != 0 && maskPixels != geometry.Pixels())
  {
    throw std::invalid_argument("the mask has " + std::to_string(maskPixels) + " pixels, but the frames have " +
                                std::to_string(geometry.Pixels()));
  }
}

} // namespace sensornoise
