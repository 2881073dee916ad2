// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "simulation/Companding.h"

#include "simulation/SettingChecks.h"

#include <algorithm>
#include <cmath>

namespace sensornoise
{

void
CheckSettings(const CompandingSettings & settings, unsigned int bitDepth)
{
  if (!settings.IsOn())
  {
    return;
  }
  RequireSetting(
    settings.bits >= 2 && settings.bits <= 16, "number of bits of the companding", settings.bits, "0 or 2 to 16");
  RequireSetting(bitDepth > 0, "bit depth", bitDepth, "1 or more, for companding needs the converter's range");
}

void
Compand(double * codesDn, std::size_t count, const CompandingSettings & settings, unsigned int bitDepth)
{
  const double top = std::ldexp(1.0, static_cast<int>(bitDepth)) - 1.0;
  const double storedTop = std::ldexp(1.0, static_cast<int>(settings.bits)) - 1.0;
  std::transform(codesDn, codesDn + count, codesDn, [=](double code) {
    const double stored = std::floor(std::sqrt(std::clamp(code, 0.0, top) / top) * storedTop + 0.5) / storedTop;
    return top * stored * stored;
  });
}

} // namespace sensornoise
