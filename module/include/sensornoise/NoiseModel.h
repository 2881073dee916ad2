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
 * The noise model of a sensor, its check on other frames, and the transform that gives the noise of all levels the same
 * variance. */

namespace sensornoise
{

/** Noise model: the variance of a pixel as a function of its level x, a x + b [DN^2]. A denoiser needs nothing else of
 * a sensor. Dark offset and read noise are contained in b = sigma^2 - a mu, and need not be known. */
struct SensorNoise_EXPORT NoiseModel
{
  double varianceSlopeDn{ 0.0 };   ///< a, `variance_slope` of a report [DN/e-]; above 0
  double totalInterceptDn2{ 0.0 }; ///< b, `total_intercept` of a report [DN^2]; of either sign

  /** Returns the variance of a pixel at a level [DN^2]. */
  double
  VarianceAt(double levelDn) const
  {
    return varianceSlopeDn * levelDn + totalInterceptDn2;
  }

  /** Throws std::invalid_argument unless the slope is finite and above 0 and the intercept finite. */
  void
  Validate() const;
};

/** Returns the noise model of a report, its varianceSlope and totalIntercept. The report needs no offset, and may be of
 * smoothed frames. Throws std::invalid_argument if one of the two has no value, or if the slope is not above 0. */
SensorNoise_EXPORT NoiseModel
NoiseModelOf(const Report & report);

/** \class NoiseModelCheck
 * \brief Comparison of the noise of frames with a noise model: the ratio of their variances, level by level.
 *
 * This ratio is the variance after the generalized Anscombe transform, apart from the known deviation of the transform
 * itself (transformVariance, by integration). The frames are not transformed for it. The ratio is taken from the
 * variance without flicker and motion, which the refined method measures for every pixel. It is exact for any flicker.
 * Flicker cannot be removed exactly from transformed frames.
 *
 * A band fits if its ratio is within 0.02 of 1 or within four standard errors. The first and the last band have a wider
 * tolerance: pixels are sorted by temporal means, and the noise of these means adds to the ratio there. The standard
 * errors are the errors of a variance of as many pixels and frames, times the excess scatter of neighbouring bins. This
 * excess comes from correlated noise, from pixels that differ, and from tails of the distribution. The errors of the
 * model are not included. */
struct NoiseModelCheck
{
  /** Range of neighbouring levels. */
  struct Band
  {
    double                lowDn{ 0.0 };         ///< mean level of the darkest bin of the band [DN]
    double                highDn{ 0.0 };        ///< mean level of the brightest bin of the band [DN]
    std::size_t           pixels{ 0 };          ///< number of pixels
    std::optional<double> ratio;                ///< variance over the model variance [1]; null: the latter is <= 0
    double                standardError{ 0.0 }; ///< standard error of the ratio [1]
    /** Expected variance after the transform if the model is right [1]; null: the level is below about 10 e-, and the
     * read noise is not known. */
    std::optional<double> transformVariance;
    bool                  fits{ false }; ///< whether the ratio is 1 within the tolerance
  };

  enum class Verdict : std::uint8_t
  {
    Fits,          ///< all bands fit
    DoesNotFit,    ///< at least one band does not fit
    NotDetermined, ///< nothing was measured, or the errors are above 5 % in most bands
    NotTold [[deprecated("use NotDetermined")]] = NotDetermined ///< name in earlier versions
  };

  std::vector<Band> bands;                             ///< from dark to bright; empty: nothing was measured
  Verdict           verdict{ Verdict::NotDetermined }; ///< result for all bands
  std::string       sentence;                          ///< the result as one sentence, for people
};

/** Compares the noise of frames with a noise model.
 * \param frames report of the refined method on the frames to be checked
 * \param model noise model
 * \param readNoiseElectrons read noise of the sensor [e-], for Band::transformVariance only; null: not known
 * \throws std::invalid_argument as NoiseModel::Validate(). */
SensorNoise_EXPORT NoiseModelCheck
CheckNoiseModel(const Report &        frames,
                const NoiseModel &    model,
                std::optional<double> readNoiseElectrons = std::nullopt);

/** Compares the noise of \a frames with the noise model of \a report. The sentence of the result says so if the
 * quantization steps of the two differ. Throws std::invalid_argument as NoiseModelOf(). */
SensorNoise_EXPORT NoiseModelCheck
CheckReport(const Report & frames, const Report & report);

/** Returns the name of the verdict: "fits", "does-not-fit" or "not-told". */
SensorNoise_EXPORT const char *
NameOf(NoiseModelCheck::Verdict verdict);

/** Returns the check as JSON, schema "itk-sensornoise-check/1". */
SensorNoise_EXPORT std::string
ToJson(const NoiseModelCheck & check);

/** Returns the bands as a table, followed by the sentence. */
SensorNoise_EXPORT std::string
MakeTable(const NoiseModelCheck & check);

/** Inverse transforms, from a stabilised value D to a level x. E = x / a + b / a^2 is the level in electrons above the
 * zero level -b / a, at which the model has no variance. */
enum class AnscombeInverse : std::uint8_t
{
  /** The level at which the mean of the stabilised values is D. Use it after a denoiser, or for a mean of stabilised
   * values. It is the closed form of M. M\"akitalo, A. Foi, IEEE Trans. Image Process. 22(1), 2013,
   * https://doi.org/10.1109/TIP.2012.2202675, E = D^2/4 - 1/8 + sqrt(3/2)/4 D^-1 - 11/8 D^-2 + 5 sqrt(3/2)/8 D^-3.
   * Their lambda is E - sigma^2/a^2: the read noise cancels. E is 0 if D is below sqrt(3/2), the smallest mean. */
  ExactUnbiased,
  /** f^-1, E = D^2/4 - 3/8, for single values. For a mean it is too low, by 1/4 e- at high signals. */
  Algebraic,
  /** E = D^2/4 - 1/8, the limit of ExactUnbiased for high signals. It is too high in the dark, by up to 1/4 e-. */
  Asymptotic
};

/** Returns the inverse with this name: "exact-unbiased", "algebraic" or "asymptotic". Throws std::invalid_argument for
 * any other name. */
SensorNoise_EXPORT AnscombeInverse
AnscombeInverseOf(const std::string & name);

/** Returns the name of the inverse, as AnscombeInverseOf() reads it. */
SensorNoise_EXPORT const char *
NameOf(AnscombeInverse inverse);

/** \class GeneralizedAnscombe
 * \brief Transforms levels x into values whose noise has variance 1 at every level, and back.
 *
 *   f(x) = (2/a) sqrt(max(0, a x + 3/8 a^2 + b)),   a slope, b total intercept of the noise model.
 *
 * F. Murtagh, J.-L. Starck, A. Bijaoui, Astron. Astrophys. Suppl. Ser. 112, 1995, with sigma^2 - a mu written as b. The
 * variance of f is 1 within 0.02 above 10 e-, and smaller in the dark; NoiseModelCheck::Band::transformVariance has it.
 *
 * The arithmetic is double; square roots are computed in the type of the stabilised values. The result of a value does
 * not depend on its position. Input and output may be the same memory if they have the same type. NaN gives NaN.
 *
 * Instantiated for pixels of unsigned char, unsigned short, short, float and double, stabilised as float and double.
 */
class SensorNoise_EXPORT GeneralizedAnscombe
{
public:
  /** Takes the noise model of the levels. Throws std::invalid_argument as NoiseModel::Validate(). */
  explicit GeneralizedAnscombe(const NoiseModel & model);

  /** Computes f of \a count levels [DN] into \a stabilised, which has room for \a count values [1]. Returns the number
   * of levels that are more than 3/8 e- below the zero level. The argument of the root is negative there, and f is 0.
   */
  template <typename TPixel, typename TReal>
  std::size_t
  Stabilise(const TPixel * levelsDn, std::size_t count, TReal * stabilised) const;

  /** Computes the levels [DN] of \a count stabilised values into \a levelsDn, which has room for \a count levels.
   * Negative values count as 0. An integer level is rounded to the nearest number, half up, within the range of its
   * type. Returns the number of NaN values for which the level is an integer, else 0: these get the lowest number. */
  template <typename TReal, typename TPixel>
  std::size_t
  Invert(const TReal * stabilised, std::size_t count, TPixel * levelsDn, AnscombeInverse inverse) const;

  /** Returns the noise model. */
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
