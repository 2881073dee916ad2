// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_NoiseModel_h
#define sensornoise_NoiseModel_h

#include "SensorNoiseExport.h"
#include "sensornoise/Report.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

/** \file
 * The noise model of a sensor, its check on other frames, and the transform that makes the noise of all levels equal.
 */

namespace sensornoise
{

/** The variance of a pixel as a function of its level x: a x + b [DN^2]. All that a denoiser needs of a sensor: offset
 * and read noise are inside b = sigma^2 - a mu, so that neither has to be known. */
struct SensorNoise_EXPORT NoiseModel
{
  double varianceSlopeDn{ 0.0 };   ///< a, `variance_slope` of a report [DN/e-]; above 0
  double totalInterceptDn2{ 0.0 }; ///< b, `total_intercept` of a report [DN^2]; of either sign

  /** The variance at a level [DN^2]. */
  double
  VarianceAt(double levelDn) const
  {
    return varianceSlopeDn * levelDn + totalInterceptDn2;
  }

  /** Throws std::invalid_argument unless the slope is finite and above 0 and the intercept finite. */
  void
  Validate() const;
};

/** The model of a report. Nothing else of it is asked for: a report without offset serves, and so does one of frames
 * that were smoothed. Throws std::invalid_argument where one of the two has no value, or the slope is not above 0. */
SensorNoise_EXPORT NoiseModel
NoiseModelOf(const Report & report);

/** \class NoiseModelCheck
 * \brief Whether frames have the noise that a model says: their variance over the model's, level by level.
 *
 * This ratio is the variance after the generalized Anscombe transform, up to what the transform itself lacks, which is
 * known by integration and stands beside it. The frames are not transformed for it: their variance without flicker and
 * motion, which the refined method finds for every pixel, is exact for flicker of any strength, whereas the root of a
 * flickering level cannot be freed of it exactly.
 *
 * A band fits where the ratio is within 0.02 of 1 (at both ends more, for the noise of the means that pixels are sorted
 * by) or within four standard errors. The errors are those of a variance
 * of as many pixels and frames, times what neighbouring bins differ by in excess of that: shared noise, pixels that
 * differ, tails. The model's own errors are not in them. */
struct NoiseModelCheck
{
  /** Neighbouring levels. */
  struct Band
  {
    double                lowDn{ 0.0 };
    double                highDn{ 0.0 };
    std::size_t           pixels{ 0 };
    std::optional<double> ratio; ///< variance over the model's [1]; null: the model's is not above 0
    double                standardError{ 0.0 };
    /** Variance after the transform if the model is right [1]; null: in the dark, where the read noise is not known. */
    std::optional<double> transformVariance;
    bool                  fits{ false };
  };

  enum class Verdict : std::uint8_t
  {
    Fits,       ///< in all bands
    DoesNotFit, ///< in some
    NotTold     ///< nothing was measured, or with errors above 5 % in most bands
  };

  std::vector<Band> bands; ///< dark to bright
  Verdict           verdict{ Verdict::NotTold };
  std::string       sentence; ///< for people
};

/** Compares \a frames, what the refined method says of the frames to be checked, with \a model. \a readNoiseElectrons
 * serves Band::transformVariance only. */
SensorNoise_EXPORT NoiseModelCheck
CheckNoiseModel(const Report &        frames,
                const NoiseModel &    model,
                std::optional<double> readNoiseElectrons = std::nullopt);

/** The same with the model of a \a report; says so where the frames are of another scale. Throws as NoiseModelOf(). */
SensorNoise_EXPORT NoiseModelCheck
CheckReport(const Report & frames, const Report & report);

/** "fits", "does-not-fit" or "not-told". */
SensorNoise_EXPORT const char *
NameOf(NoiseModelCheck::Verdict verdict);

/** As JSON, schema "itk-sensornoise-check/1". */
SensorNoise_EXPORT std::string
ToJson(const NoiseModelCheck & check);

/** The bands as a table, and the sentence. */
SensorNoise_EXPORT std::string
MakeTable(const NoiseModelCheck & check);

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
