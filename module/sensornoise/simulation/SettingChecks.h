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

#include <cmath>
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
    throw std::invalid_argument(std::string("the ") + name + " is " + std::to_string(found) + "; expected " + expected);
  }
}

/** \throws std::invalid_argument unless \a value is finite and 0 or more. */
inline void
RequireNotNegative(double value, const char * name)
{
  RequireSetting(std::isfinite(value) && value >= 0.0, name, value, "a finite number, 0 or more");
}

/** \throws std::invalid_argument unless \a value is from 0 to 1. */
inline void
RequireFraction(double value, const char * name)
{
  RequireSetting(value >= 0.0 && value <= 1.0, name, value, "0 to 1");
}

} // namespace sensornoise

#endif
