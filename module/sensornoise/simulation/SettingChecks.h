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
#ifndef sensornoise_simulation_SettingChecks_h
#define sensornoise_simulation_SettingChecks_h

#include "sensornoise/base/Text.h"

#include <stdexcept>
#include <string>

/** \file
 * How the simulator refuses a setting: what was found, what was expected. */

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

/** \throws std::invalid_argument unless \a value is from 0 to 1e9: more is nonsense in any unit, and its square, or a
 * product of two, would soon not be finite. */
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
