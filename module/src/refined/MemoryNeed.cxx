// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "refined/MemoryNeed.h"

#include "base/FreeMemory.h"

#include <stdexcept>
#include <string>

namespace sensornoise
{

void
RequireMemoryLimit(double limitBytes, const FrameGeometry & geometry, std::size_t frames, std::size_t planes)
{
  const double least = static_cast<double>(planes) * MemoryNeed{ geometry.Pixels(), frames }.Least();
  if (limitBytes < least)
  {
    throw std::invalid_argument("the memory limit is " + TextOfBytes(limitBytes) + "; expected at least " +
                                TextOfBytes(least) + " for " +
                                (planes == 1 ? std::string("frames") : std::to_string(planes) + " planes") + " of " +
                                std::to_string(geometry.width) + " x " + std::to_string(geometry.height) + " pixels");
  }
}

} // namespace sensornoise
