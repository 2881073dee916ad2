// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/SimulationSettings.h"

#include "base/Text.h"
#include "simulation/CollectedCharge.h"
#include "simulation/FixedPattern.h"
#include "simulation/FrameProcessing.h"
#include "simulation/ReadOut.h"
#include "simulation/SettingChecks.h"

#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

namespace sensornoise
{
namespace
{
/** \throws std::invalid_argument if the setting cannot be used. */
void
CheckSettings(const RepetitionSettings & settings)
{
  RequireSetting(
    settings.count >= 1, "number of times that a frame is written", static_cast<double>(settings.count), "1 or more");
  RequireSetting(
    settings.period >= 1, "period of repeated frames", static_cast<double>(settings.period), "1 or more exposures");
}
} // namespace

CameraModel
PaperCamera(char name)
{
  switch (name)
  {
    case 'A':
      return { 600.0, 5.0, 200.0, 15.0 };
    case 'B':
      return { 3000.0, 1.0, 100.0, 8.0 };
    case 'C':
      return { 10000.0, 0.3, 40.0, 3.0 };
    default:
      throw std::invalid_argument(std::string("camera \"") + name + "\" is not known; expected A, B or C");
  }
}

SceneConditions
PaperConditions(int number)
{
  switch (number)
  {
    case 1:
      return { 0.1, 0.3, 0.2 };
    case 2:
      return { 0.01, 0.1, 0.05 };
    case 3:
      return { 0.05, 0.01, 0.02 };
    default:
      throw std::invalid_argument("condition " + std::to_string(number) + " is not known; expected 1, 2 or 3");
  }
}

void
CheckSettings(const SimulationSettings & settings)
{
  const CameraModel & camera = settings.camera;
  RequireSetting(
    camera.electrons > 0.0 && camera.electrons <= 1e9, "number of electrons", camera.electrons, "0 < A <= 1e9");
  RequireSetting(camera.gainDnPerElectron > 0.0 && camera.gainDnPerElectron <= 1e9,
                 "gain",
                 camera.gainDnPerElectron,
                 "a number above 0, at most 1e9");
  RequireSetting(std::abs(camera.offsetDn) <= 1e9, "offset", camera.offsetDn, "-1e9 to 1e9");
  RequireNotNegative(camera.readNoiseDn, "read noise");
  RequireNotNegative(settings.conditions.flickerSd, "flicker standard deviation");
  RequireNotNegative(settings.conditions.vibrationSdXPixels, "horizontal vibration standard deviation");
  RequireNotNegative(settings.conditions.vibrationSdYPixels, "vertical vibration standard deviation");
  RequireSetting(settings.frames >= 1, "number of frames", static_cast<double>(settings.frames), "at least 1");
  CheckSettings(settings.illumination, settings.frames);
  RequireSetting(settings.bitDepth <= 32, "bit depth", settings.bitDepth, "0 (no clipping) to 32");
  RequireSetting(settings.opticalBlurPixels >= 0.0 && settings.opticalBlurPixels <= 1000.0,
                 "optical blur",
                 settings.opticalBlurPixels,
                 "0 to 1000 pixels");
  RequireNotNegative(settings.rollingShutterPeriodRows, "rolling-shutter period");
  RequireNotNegative(settings.prnuSd, "PRNU");
  RequireNotNegative(settings.dsnuSdDn, "DSNU");
  RequireNotNegative(settings.hotPixelNoiseFactor, "noise factor of hot pixels");
  RequireFraction(settings.hotPixelFraction, "fraction of hot pixels");
  CheckSettings(settings.flaws.filters);
  CheckSettings(settings.flaws.pattern);
  CheckSettings(settings.flaws.readNoise);
  CheckSettings(settings.flaws.response);
  CheckSettings(settings.flaws.lineNoise);
  CheckSettings(settings.flaws.brighterFatter, camera.electrons);
  CheckSettings(settings.flaws.coupling);
  CheckSettings(settings.flaws.defectCorrection);
  CheckSettings(settings.flaws.temporalFilter);
  CheckSettings(settings.flaws.median);
  CheckSettings(settings.flaws.smoothing);
  CheckSettings(settings.flaws.binning);
  CheckSettings(settings.flaws.resampling);
  CheckSettings(settings.flaws.blocks, settings.bitDepth);
  CheckSettings(settings.flaws.companding, settings.bitDepth);
  CheckSettings(settings.flaws.repetition);
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const double     low = settings.clipLowDn.value_or(-infinity);
  const double     high = settings.clipHighDn.value_or(infinity);
  if (!(low < high))
  {
    throw std::invalid_argument("the clip levels are " + Text(low) + " and " + Text(high) +
                                "; expected the low one below the high one");
  }
}

} // namespace sensornoise
