// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_StepResults_h
#define sensornoise_StepResults_h

#include "SensorNoiseExport.h"
#include "sensornoise/Report.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

/** \file
 * Results of the filters for single steps: TemporalStatisticsImageFilter (StackSummary), FlickerCorrectionImageFilter
 * (IsoIntensitySet, FlickerEstimate), VibrationCovarianceEstimator (VibrationCovariance), NoiseCorrelationEstimator
 * (CorrelationEstimate). */

namespace sensornoise
{

/** \class QuantisationSteps
 * \brief Quantization step as a function of the level, for companded data (non-uniform quantization).
 *
 * Cameras compand to save bits: they apply a tone curve, often a square root, to 8 or 10 bits, and undo it later. The
 * quantization step then grows with the level, and so does the quantization noise, step^2 / 12 [DN^2]. It adds to the
 * slope of the variance, which differs from the gain (Janesick, "Photon Transfer", SPIE 2007, ch. 11 on non-linear
 * encoding; step^2 / 12: Bennett 1948, Bell Syst. Tech. J. 27, 446). */
class SensorNoise_EXPORT QuantisationSteps
{
public:
  /** Quantization about a level. */
  struct Local
  {
    double levelDn;     ///< the level [DN]
    double stepDn;      ///< quantization step: mean distance of neighbouring digital numbers [DN]
    double varianceDn2; ///< variance of the quantization noise [DN^2]
  };

  /** Makes uniform quantization, without a table. */
  QuantisationSteps() = default;
  /** Takes the \a table, in ascending order of the levels, and the number \a unitDn that all digital numbers are
   * multiples of [DN]. */
  explicit QuantisationSteps(std::vector<Local> table, double unitDn = 1.0);

  /** Returns whether the step grows with the level. If it does not, the table is empty. */
  bool
  IsCompanded() const
  {
    return !m_Table.empty();
  }
  /** Returns the table, from dark to bright. StepAt() and VarianceAt() interpolate between its levels. Outside of them
   * the values of the nearest level hold. */
  const std::vector<Local> &
  GetTable() const
  {
    return m_Table;
  }
  /** Returns the number that all digital numbers are multiples of [DN]. */
  double
  GetUnitDn() const
  {
    return m_UnitDn;
  }
  /** Returns the quantization step about a level [DN]; 0 without a table. */
  double
  StepAt(double levelDn) const
  {
    return this->Interpolate(levelDn, &Local::stepDn);
  }
  /** Returns the variance of the quantization noise about a level [DN^2]; 0 without a table. */
  double
  VarianceAt(double levelDn) const
  {
    return this->Interpolate(levelDn, &Local::varianceDn2);
  }

private:
  double
  Interpolate(double levelDn, double Local::* value) const;

  std::vector<Local> m_Table;
  double             m_UnitDn{ 1.0 };
};

/** Quantization and clip levels of the data. */
struct DnRange
{
  std::optional<int>    bitDepth;                  ///< bit depth [bit]; null: floating-point data without a given one
  std::string           bitDepthSource{ "none" };  ///< "given", "data" or "none"
  double                quantisationStepDn{ 0.0 }; ///< step, for companded data at the darkest level [DN]; 0: none
  bool                  isRegular{ true };         ///< false: the data were rescaled, and the step varies
  QuantisationSteps     steps;                     ///< step by level, for companded data
  std::optional<double> clipLowDn;                 ///< a pixel that attains this level is clipped [DN]; null: none
  std::optional<double> clipHighDn;                ///< a pixel that attains this level is clipped [DN]; null: none
  std::string           clipSource{ "none" }; ///< "given", "pile-up", "code range", "none", or "low: ..., high: ..."

  /** Sets clipSource from the sources of the lower and of the upper clip level. */
  void
  SetClipSources(const std::string & low, const std::string & high)
  {
    clipSource = low == high ? low : "low: " + low + ", high: " + high;
  }
  /** Returns the source of the lower clip level, see clipSource. */
  std::string
  GetLowClipSource() const
  {
    const std::string prefix = "low: ";
    const std::size_t high = clipSource.find(", high: ");
    return high == std::string::npos ? clipSource : clipSource.substr(prefix.size(), high - prefix.size());
  }
  /** Returns the source of the upper clip level, see clipSource. */
  std::string
  GetHighClipSource() const
  {
    const std::string between = ", high: ";
    const std::size_t high = clipSource.find(between);
    return high == std::string::npos ? clipSource : clipSource.substr(high + between.size());
  }
  /** Returns the quantization step about a level [DN]; 0: the data are not quantized. */
  double
  StepAt(double levelDn) const
  {
    return steps.IsCompanded() ? steps.StepAt(levelDn) : quantisationStepDn;
  }
  /** Returns whether a pixel with this minimum over time attains the lower clip level. */
  bool
  IsClippedLow(double minimumDn) const
  {
    return clipLowDn && minimumDn <= *clipLowDn;
  }
  /** Returns whether a pixel with this maximum over time attains the upper clip level. */
  bool
  IsClippedHigh(double maximumDn) const
  {
    return clipHighDn && maximumDn >= *clipHighDn;
  }
  /** Returns whether a pixel with these extremes over time attains a clip level. */
  bool
  IsClipped(double minimumDn, double maximumDn) const
  {
    return this->IsClippedLow(minimumDn) || this->IsClippedHigh(maximumDn);
  }
};

/** Deprecated: the name of QuantisationSteps in earlier versions. */
using CodeSteps [[deprecated("use QuantisationSteps")]] = QuantisationSteps;
/** Deprecated: the name of DnRange in earlier versions. */
using CodeRange [[deprecated("use DnRange")]] = DnRange;

/** Results of the temporal moments of a stack, beside mean and variance. */
struct SensorNoise_EXPORT StackSummary
{
  /** Returns the DN range with only those clip levels that a pixel attains. */
  DnRange
  AttainedRange() const;
  /** Deprecated: the name of AttainedRange() in earlier versions. */
  [[deprecated("use AttainedRange()")]] DnRange
  AttainedCodes() const
  {
    return this->AttainedRange();
  }

  DnRange     dnRange;          ///< quantization and clip levels
  std::size_t clipped{ 0 };     ///< number of pixels that attain a clip level in a frame
  std::size_t clippedLow{ 0 };  ///< number of pixels that attain the lower clip level
  std::size_t clippedHigh{ 0 }; ///< number of pixels that attain the upper clip level
  std::size_t notFinite{ 0 };   ///< number of pixels that are NaN or infinite in a frame
};

/** \class IsoIntensitySet
 * \brief Pixels of nearly equal intensity, over which each frame is averaged: S^* or S_* of (3.7) and (3.13).
 *
 * The equations are in Sur & Gredi\'ac 2015, https://doi.org/10.1137/140977035. The level u is a quantile of the mean
 * over the pixels kept by the vibration mask. The set is |mean - u| <= 3 sigma_u, with the weights
 * exp(-(mean - u)^2 / (2 sigma_u^2)) of Remark 1.
 *
 * The paper calls sigma_u "the associated standard deviation", without a definition. Here it is the standard deviation
 * of the temporal *mean* at that level: the median temporal standard deviation of the pixels nearest to the level, over
 * sqrt(T). With the standard deviation of one frame instead, the standard deviations of the offset are up to ten times
 * smaller than in the tables of the paper.
 *
 * Remark 3 lets the quantile move if the set is too small. Here it moves inwards by 1 % up to four times. Then the band
 * widens by factors of 2, until the set has MinimumPixels. wideningSteps counts both.
 */
struct SensorNoise_EXPORT IsoIntensitySet
{
  /** Least number of pixels of a set. */
  static constexpr std::size_t MinimumPixels = 30;

  double                     levelDn{ 0.0 };             ///< u^* or u_* [DN]
  double                     levelSdDn{ 0.0 };           ///< sigma_u, standard deviation of the mean at the level [DN]
  double                     bandSdDn{ 0.0 };            ///< sigma_u of the weights: levelSdDn unless widened [DN]
  double                     temporalVarianceDn2{ 0.0 }; ///< temporal variance of a pixel at the level [DN^2]
  double                     quantile{ 0.0 };            ///< quantile that was used [1], 0 to 1
  unsigned int               wideningSteps{ 0 };         ///< number of widening steps; 0: the quantile is as given
  std::vector<std::uint32_t> pixels;                     ///< numbers of the pixels, row by row from 0, ascending
  std::vector<double>        weights;                    ///< weight of each of these pixels [1]; their sum is 1

  /** Returns the number of equally weighted pixels that average noise equally well: 1 / sum w^2. */
  double
  EffectivePixels() const;
};

/** Flicker and offset of a stack, by sections 3.2 and 3.5 of Sur & Gredi\'ac 2015. */
struct FlickerEstimate
{
  std::vector<double> brightRatio;      ///< v^*(t) of the bright set, (3.8) [1]
  std::vector<double> darkResidualDn;   ///< v_*(t) of the dark set, (3.14) [DN]
  double              slopeDn{ 0.0 };   ///< K, slope of v_* against v^* - 1 [DN]
  double              offsetDn{ 0.0 };  ///< mu, (3.16) [DN]
  std::vector<double> gamma;            ///< gamma_t of the whole frame, (3.17) [1]
  double              flickerSd{ 0.0 }; ///< standard deviation of gamma_t over time (by row: root mean square) [1]

  double                    sigmaRows{ 0.0 }; ///< sigma_y [rows]; 0: no gamma_t(y)
  std::size_t               rows{ 1 };        ///< number of rows of gammaRows, or 1
  std::vector<double>       gammaRows;        ///< gamma_t(y), frame by frame [1]; empty: no gamma_t(y)
  std::vector<std::uint8_t> rowKnown;         ///< for each row 0 if its flicker is not known; empty: all are known

  /** Excess of the variance of v^* over its sampling noise, in standard deviations of this noise [1]; may be infinite.
   */
  double flickerZ{ 0.0 };
  /** Residual variance of v_* about the line, over the variance expected from noise [1]; 1 if the model holds. */
  double offsetLinePhi{ 1.0 };

  /** Returns gamma_t(y) of frame \a t and row \a row if it was estimated, else gamma_t [1]. */
  double
  Gamma(std::size_t t, std::size_t row) const
  {
    return gammaRows.empty() ? gamma[t] : gammaRows[t * rows + row];
  }
  /** Returns whether the flicker of a row is known. */
  bool
  IsKnown(std::size_t row) const
  {
    return rowKnown.empty() || rowKnown[row] != 0;
  }
};

/** Covariance matrix of the vibration, Cov(alpha, beta), with the other coefficients of (2.20) of Sur & Gredi\'ac 2015.
 */
struct VibrationCovariance
{
  double      varianceXPixels2{ 0.0 };  ///< variance of alpha_t, along x [pixel^2]; below 0: not distinguished from 0
  double      varianceYPixels2{ 0.0 };  ///< variance of beta_t, along y [pixel^2]; below 0: not distinguished from 0
  double      covariancePixels2{ 0.0 }; ///< covariance of alpha_t and beta_t [pixel^2]
  double      flickerVariance{ 0.0 };   ///< sigma_gamma^2, the coefficient of the squared mean [1]
  std::size_t pixels{ 0 };              ///< number of pixels of the regression
  bool        isDetermined{ false };    ///< false: there are too few pixels, or the scene has no gradients
};

/** Number with its standard error. */
struct MeasuredNumber
{
  double value{ 0.0 };         ///< the number
  double standardError{ 0.0 }; ///< standard error, in the unit of the value

  /** Returns whether the absolute value exceeds \a least by more than \a z standard errors. */
  bool
  Exceeds(double least, double z) const;
};

/** Noise of the pixels of one intensity bin. There are up to four bins, with equal numbers of pixels. */
struct LightNoise
{
  double         lightDn{ 0.0 }; ///< mean signal: level minus offset [DN]
  MeasuredNumber varianceDn2;    ///< mean variance of a pixel in the frames as they are [DN^2]
  Quantity       sumOverLags;    ///< total covariance over lags as in CorrelationEstimate, for this bin [1]
};

/** Correlation of the noise between pixels and between frames, and the factor by which it changes the variance. */
struct CorrelationEstimate
{
  std::size_t width{ 0 };      ///< columns of a frame [pixel]
  std::size_t height{ 0 };     ///< rows of a frame [pixel]
  std::size_t frames{ 0 };     ///< number of frames of the stack
  std::size_t framesUsed{ 0 }; ///< number of frames of the sample; equal frames are counted once
  std::size_t pixelsUsed{ 0 }; ///< number of pixels of the sample

  NoiseCorrelationRecord correlation; ///< correlation by lag, and noise class
  /** Total covariance of the noise over all lags, relative to the variance of a pixel [1]. If a linear filter whose
   * weights sum to 1 changed the noise, the variance times this number is the variance before the filter. The variance
   * refers to the mean over the T frames; correlation between frames makes it smaller than the true variance, by the
   * factor 1 - 2 (sum of coefficients) / T. For white noise the number is 1 within its error, and the variance is best
   * left unchanged. The error is from a block jackknife and includes the lags that are not summed. The quantity has
   * `failed` if the noise is not linear or was not measured. */
  Quantity                sumOverLags{ Quantity::Without(EstimateStatus::Failed) };
  std::vector<LightNoise> lights; ///< noise by intensity bin, from dark to bright; empty: not measured
};

/** Name and version of the schema of the JSON record. */
inline constexpr const char * CorrelationSchema = "itk-sensornoise-correlation/1";

/** Returns the estimate as a JSON object. Each quantity has its unit; noise_correlation is as in the report. */
SensorNoise_EXPORT std::string
ToJson(const CorrelationEstimate & estimate);

} // namespace sensornoise

#endif
