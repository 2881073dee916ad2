// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_moments_DarkMaps_h
#define sensornoise_moments_DarkMaps_h

#include <cstddef>
#include <cstdint>
#include <vector>

namespace sensornoise
{

/** Maps of every pixel from dark frames; the variance needs two or more frames. */
struct DarkMaps
{
  std::vector<double> offsetDn;            ///< mean over time [DN]; NaN: not finite, clipped or masked
  std::vector<double> varianceDn2;         ///< variance over time, without the common drift of the frames, with
                                           ///< quantization noise [DN^2]; NaN as above
  std::vector<std::uint8_t> usable;        ///< 0: not finite, clipped, masked or defective, see DefectivePixels.h
  std::size_t               frames{ 0 };   ///< number of frames; the degrees of freedom of a variance are one less
  double                    stepDn{ 0.0 }; ///< quantization step [DN]; 0: the data have no codes
};

} // namespace sensornoise

#endif
