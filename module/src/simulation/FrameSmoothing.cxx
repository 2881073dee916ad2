// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "simulation/FrameSmoothing.h"

#include "sensornoise/Simulator.h"
#include "simulation/SettingChecks.h"

namespace sensornoise
{

void
CheckSettings(const SmoothingSettings & settings)
{
  RequireSetting(settings.sdPixels >= 0.0 && settings.sdPixels <= 100.0,
                 "smoothing in the camera",
                 settings.sdPixels,
                 "0 to 100 pixels");
}

DoubleFrame
SmoothFrame(DoubleFrame codesDn, const SmoothingSettings & settings, const ParallelFor & parallelFor)
{
  codesDn.values = GaussianBlur(codesDn.values, codesDn.width, codesDn.height, settings.sdPixels, parallelFor);
  return codesDn;
}

} // namespace sensornoise
