// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_stabilise_GeneralizedAnscombe_h
#define sensornoise_stabilise_GeneralizedAnscombe_h

#include "SensorNoiseExport.h"
#include "sensornoise/NoiseModel.h"

#include <cstddef>
#include <cstdint>
#include <string>

namespace sensornoise
{

/** The way back from a stabilised value D to a level. With E = x / a + b / a^2, the level in electrons above the zero
 * level -b / a, where the model has no variance: */
enum class AnscombeInverse : std::uint8_t
{
  /** The level whose noisy values have the mean D when stabilised: for what a denoiser, or a mean, made of them. The
   * closed form of M. M\"akitalo, A. Foi, IEEE Trans. Image Process. 22(1), 2013,
   * https://doi.org/10.1109/TIP.2012.2202675, E = D^2/4 - 1/8 + sqrt(3/2)/4 D^-1 - 11/8 D^-2 + 5 sqrt(3/2)/8 D^-3,
   * where their lambda is E - sigma^2/a^2: the read noise cancels. 0 where D is below sqrt(3/2), which no mean is. */
  ExactUnbiased,
  /** f^-1, for single values: E = D^2/4 - 3/8. A mean comes out too low, by 1/4 e- where there is light enough. */
  Algebraic,
  /** E = D^2/4 - 1/8: the exact one's limit for bright light. Too high, by up to 1/4 e-, in the dark. */
  Asymptotic
};

/** The inverse of a name: "exact-unbiased", "algebraic" or "asymptotic". Throws std::invalid_argument for others. */
SensorNoise_EXPORT AnscombeInverse
AnscombeInverseOf(const std::string & name);

/** The name of an inverse. */
SensorNoise_EXPORT const char *
NameOf(AnscombeInverse inverse);

/** \class GeneralizedAnscombe
 * \brief Turns levels x into values whose noise has variance 1, whatever the level, and back.
 *
 *   f(x) = (2/a) sqrt(max(0, a x + 3/8 a^2 + b)),   a slope, b total intercept of the noise model.
 *
 * F. Murtagh, J.-L. Starck, A. Bijaoui, Astron. Astrophys. Suppl. Ser. 112, 1995, with sigma^2 - a mu written as b. The
 * variance of f is 1 within 0.02 above 10 e-, and less in the dark; MomentsOfStabilised() tells how much.
 *
 * Computed in double, but for roots that are wanted as float; the same bits wherever a value stands. Input and output
 * may be the same memory where they have the same type. NaN gives NaN.
 *
 * Instantiated for pixels of unsigned char, unsigned short, short, float and double, stabilised as float and double.
 */
class SensorNoise_EXPORT GeneralizedAnscombe
{
public:
  /** Throws std::invalid_argument as NoiseModel::Validate(). */
  explicit GeneralizedAnscombe(const NoiseModel & model);

  /** f of \a count levels [DN]. Returns how many of them had a negative argument, further below the zero level than
   * 3/8 e-: these give 0. */
  template <typename TPixel, typename TReal>
  std::size_t
  Stabilise(const TPixel * levelsDn, std::size_t count, TReal * stabilised) const;

  /** The levels [DN] of \a count stabilised values; negative ones count as 0. For integers the level is rounded to the
   * nearest, half up, and kept within the type's range. Returns how many values are NaN, which integers cannot hold:
   * these give the lowest level. */
  template <typename TReal, typename TPixel>
  std::size_t
  Invert(const TReal * stabilised, std::size_t count, TPixel * levelsDn, AnscombeInverse inverse) const;

  const NoiseModel &
  GetModel() const
  {
    return m_Model;
  }

private:
  NoiseModel m_Model;
};

} // namespace sensornoise

#endif
