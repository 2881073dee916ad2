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
#ifndef sensornoise_moments_DarkMaps_h
#define sensornoise_moments_DarkMaps_h

#include <cstddef>
#include <cstdint>
#include <vector>

namespace sensornoise
{

/** What two or more dark frames tell of every pixel of the frame. */
struct DarkMaps
{
  std::vector<double> offsetDn;            ///< mean over time [DN]; NaN: not finite, clipped or masked
  std::vector<double> varianceDn2;         ///< over time, without the frames' common drift, with the noise of rounding
                                           ///< to codes [DN^2]; NaN as above
  std::vector<std::uint8_t> usable;        ///< 0: not finite, clipped, masked or defective, see DefectivePixels.h
  std::size_t               frames{ 0 };   ///< a variance has one degree of freedom less
  double                    stepDn{ 0.0 }; ///< spacing of the codes [DN]; 0: the data have no codes
};

} // namespace sensornoise

#endif
