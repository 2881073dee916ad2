// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_moments_TemporalMaps_h
#define sensornoise_moments_TemporalMaps_h

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <vector>

namespace sensornoise
{

/** Maps of the temporal moments of a stack, each of a frame's size, after all of its frames have been added. */
template <typename TPixel>
struct TemporalMaps
{
  using Extreme = std::conditional_t<std::is_integral_v<TPixel>, std::int16_t, double>;
  /** Centre that is subtracted from the stored extremes [DN]: only unsigned 16-bit values need it to fit a signed
   * 16-bit number. */
  static constexpr std::int32_t Centre = std::is_unsigned_v<TPixel> && sizeof(TPixel) == 2 ? 32768 : 0;

  std::vector<double> mean;     ///< mean over time [DN]; NaN where the pixel was not finite in a frame
  std::vector<double> variance; ///< unbiased variance over time [DN^2]; 0 for a single frame; not finite where the
                                ///< mean is not
  std::vector<Extreme> minimum; ///< lowest value over time, minus Centre [DN]
  std::vector<Extreme> maximum; ///< highest value over time, minus Centre [DN]

  std::size_t
  GetNumberOfPixels() const
  {
    return mean.size();
  }
  /** Returns whether pixel \a p was finite in every frame. */
  bool
  IsFinite(std::size_t p) const
  {
    return std::is_integral_v<TPixel> || std::isfinite(mean[p]);
  }
  /** Lowest and highest value of pixel \a p over time [DN]; frames where it is NaN are ignored. */
  double
  GetMinimum(std::size_t p) const
  {
    return minimum[p] + Centre;
  }
  double
  GetMaximum(std::size_t p) const
  {
    return maximum[p] + Centre;
  }
};

} // namespace sensornoise

#endif
