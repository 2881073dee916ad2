// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "moments/StackRequirements.h"

#include "sensornoise/FrameGeometry.h"

#include <stdexcept>
#include <string>

namespace sensornoise
{

void
RequireStack(const FrameGeometry & geometry, std::size_t frames, std::size_t maskPixels)
{
  if (frames < MinimumFrames)
  {
    throw std::invalid_argument("the stack has " + std::to_string(frames) + (frames == 1 ? " frame" : " frames") +
                                "; expected at least " + std::to_string(MinimumFrames) +
                                ". Give all frames of the burst, as a list, a folder or a stack");
  }
  if (frames > MaximumFrames)
  {
    throw std::invalid_argument("the stack has " + std::to_string(frames) + " frames; expected at most " +
                                std::to_string(MaximumFrames) + ". Measure a part of them: --frames");
  }
  if (geometry.width < 3 || geometry.height < 3)
  {
    throw std::invalid_argument("the frames have " + std::to_string(geometry.width) + " x " +
                                std::to_string(geometry.height) + " pixels; expected at least 3 x 3");
  }
  if (maskPixels != 0 && maskPixels != geometry.Pixels())
  {
    throw std::invalid_argument("the mask has " + std::to_string(maskPixels) + " pixels, but the frames have " +
                                std::to_string(geometry.Pixels()) + "; expected one value for each pixel");
  }
}

} // namespace sensornoise
