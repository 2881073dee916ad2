// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/Settings.h"

#include "base/Text.h"

#include <cmath>
#include <stdexcept>
#include <string>

namespace sensornoise
{

CodeSettings
MakeCodeSettings(unsigned int bitDepth, double clipLowDn, double clipHighDn, double quantisationStepDn)
{
  CodeSettings settings;
  if (bitDepth > 0)
  {
    settings.bitDepth = static_cast<int>(bitDepth);
  }
  if (!std::isnan(clipLowDn))
  {
    settings.clipLowDn = clipLowDn;
  }
  if (!std::isnan(clipHighDn))
  {
    settings.clipHighDn = clipHighDn;
  }
  if (quantisationStepDn > 0.0)
  {
    settings.quantisationStepDn = quantisationStepDn;
  }
  return settings;
}

void
ValidateCodeSettings(const CodeSettings & codes)
{
  if (codes.bitDepth && (*codes.bitDepth < 1 || *codes.bitDepth > 16))
  {
    throw std::invalid_argument("the bit depth is " + std::to_string(*codes.bitDepth) + "; expected 1 to 16");
  }
  for (const std::optional<double> & level : { codes.clipLowDn, codes.clipHighDn })
  {
    if (level && !(std::abs(*level) <= LargestLevelDn))
    {
      throw std::invalid_argument("a clip level is " + Text(*level) + " DN; expected a level within " +
                                  Text(LargestLevelDn) + " DN of 0");
    }
  }
  if (codes.clipLowDn && codes.clipHighDn && !(*codes.clipLowDn < *codes.clipHighDn))
  {
    throw std::invalid_argument("the clip levels are " + Text(*codes.clipLowDn) + " and " + Text(*codes.clipHighDn) +
                                " DN; expected low < high");
  }
  if (codes.quantisationStepDn && !(*codes.quantisationStepDn > 0.0 && *codes.quantisationStepDn <= LargestStepDn))
  {
    throw std::invalid_argument("the code step is " + Text(*codes.quantisationStepDn) +
                                " DN; expected a positive number, at most " + Text(LargestStepDn));
  }
}

} // namespace sensornoise
