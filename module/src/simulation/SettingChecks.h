// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_simulation_SettingChecks_h
#define sensornoise_simulation_SettingChecks_h

#include "base/Text.h"

#include <stdexcept>
#include <string>

/** \file
 * Checks of the settings of the simulator. The messages contain the value that was found and the expected range. */

namespace sensornoise
{

/** \throws std::invalid_argument "the <name> is <found>; expected <expected>" unless \a isGood. */
inline void
RequireSetting(bool isGood, const char * name, double found, const char * expected)
{
  if (!isGood)
  {
    throw std::invalid_argument(std::string("the ") + name + " is " + Text(found) + "; expected " + expected);
  }
}

/** \throws std::invalid_argument unless \a value is from 0 to 1e9: larger values have no meaning in any unit, and their
 * products might not be finite. */
inline void
RequireNotNegative(double value, const char * name)
{
  RequireSetting(value >= 0.0 && value <= 1e9, name, value, "0 to 1e9");
}

/** \throws std::invalid_argument unless \a value is from 0 to 1. */
inline void
RequireFraction(double value, const char * name)
{
  RequireSetting(value >= 0.0 && value <= 1.0, name, value, "0 to 1");
}

} // namespace sensornoise

#endif
