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
#include "sensornoise/published/PublishedSettings.h"

#include "sensornoise/base/Text.h"
#include "sensornoise/published/VibrationMask.h"

#include <stdexcept>
#include <string>

namespace sensornoise
{

void
PublishedSettings::Validate() const
{
  ChiSquare2Quantile(level);
  if (!(darkQuantile >= 0.0 && darkQuantile < brightQuantile && brightQuantile <= 1.0))
  {
    throw std::invalid_argument("the dark and bright quantiles are " + Text(darkQuantile) + " and " +
                                Text(brightQuantile) + "; expected 0 <= dark < bright <= 1");
  }
  if (rollingShutter == RollingShutter::Fixed && !(sigmaRows > 0.0 && sigmaRows <= 1e5))
  {
    throw std::invalid_argument("sigma_y of the rolling shutter is " + Text(sigmaRows) +
                                " rows; expected a positive number, at most 100000");
  }
  if (shutterAxis > 1)
  {
    throw std::invalid_argument("the shutter axis is " + std::to_string(shutterAxis) + "; expected 0 (x) or 1 (y)");
  }
  ValidateCodeSettings(codes);
}

} // namespace sensornoise
