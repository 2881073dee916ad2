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
#ifndef sensornoise_pixels_FarVariance_h
#define sensornoise_pixels_FarVariance_h

#include <cmath>

namespace sensornoise
{

/** Whether a chi-square variable over its \a freedom is 4.5 standard deviations above 1 or more: its cube root is about
 * normal (Wilson & Hilferty 1931). */
inline bool
IsFarAbove(double ratio, double freedom)
{
  const double s = 2.0 / (9.0 * freedom);
  const double limit = 1.0 - s + 4.5 * std::sqrt(s);
  return !(ratio < limit * limit * limit);
}
/** The same on either side. */
inline bool
IsFarOff(double ratio, double freedom)
{
  const double s = 2.0 / (9.0 * freedom);
  const double limit = 1.0 - s - 4.5 * std::sqrt(s);
  return IsFarAbove(ratio, freedom) || !(ratio > limit * limit * limit);
}

} // namespace sensornoise

#endif
