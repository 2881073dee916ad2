// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/Settings.h"

#include "base/Text.h"
#include "moments/Exposures.h"
#include "report/ExcessNoise.h"

#include <cmath>
#include <stdexcept>
#include <string>

namespace sensornoise
{

void
RefinedSettings::Validate() const
{
  ValidateCodeSettings(codes);
  ValidateExposures(exposures);
  ValidateExcessNoiseFactor(excessNoiseFactor);
  if (levelRangeDn && !(levelRangeDn->lowDn < levelRangeDn->highDn && std::isfinite(levelRangeDn->lowDn) &&
                        std::isfinite(levelRangeDn->highDn)))
  {
    throw std::invalid_argument("the range of levels is from " + Text(levelRangeDn->lowDn) + " to " +
                                Text(levelRangeDn->highDn) + " DN; expected the lower level first, both finite");
  }
  if (offset &&
      !(std::isfinite(offset->valueDn) && std::isfinite(offset->standardErrorDn) && offset->standardErrorDn >= 0.0))
  {
    throw std::invalid_argument("the offset is " + Text(offset->valueDn) + " DN with a standard error of " +
                                Text(offset->standardErrorDn) +
                                " DN; expected a finite number and a standard error of 0 or more");
  }
}

void
RefinedSettings::RequireOffsetWithin(double limitDn, const std::string & whatOf) const
{
  if (offset && !(std::abs(offset->valueDn) <= limitDn && offset->standardErrorDn <= limitDn))
  {
    throw std::invalid_argument("the offset is " + Text(offset->valueDn) + " DN with a standard error of " +
                                Text(offset->standardErrorDn) + " DN; expected both within " + Text(limitDn) +
                                " DN of 0, " + whatOf);
  }
}

} // namespace sensornoise
