// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
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
