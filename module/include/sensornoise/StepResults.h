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
 * Results of the filters that do one step: TemporalStatisticsImageFilter (StackSummary), FlickerCorrectionImageFilter
 * (IsoIntensitySet, FlickerEstimate), VibrationCovarianceEstimator, NoiseCorrelationEstimator (CorrelationEstimate). */

namespace sensornoise
{

/** \class CodeSteps
 * \brief How far apart the codes lie, as a function of the level, where that grows with it.
 *
 * Cameras compand to save bits: a tone curve, often a square root, to 8 or 10 bits, which is undone on reading. Then
 * the codes are dense in the dark and coarse in the light, and so is the noise of rounding, step^2 / 12 [DN^2]: it
 * grows with the level and adds to the slope of the variance, which is no more the gain (Janesick, "Photon Transfer",
 * SPIE 2007, ch. 11 on non-linear encoding; step^2 / 12: Bennett 1948, Bell Syst. Tech. J. 27, 446). */
class SensorNoise_EXPORT CodeSteps
{
public:
  /** What the codes are like about a level. */
  struct Local
  {
    double levelDn;
    double stepDn;      ///< mean distance of neighbouring codes
    double varianceDn2; ///< of rounding to them
  };

  CodeSteps() = default;
  /** \a table rises with the level. */
  explicit CodeSteps(std::vector<Local> table, double unitDn = 1.0);

  /** Returns whether the step grows with the level. If not there is no table. */
  bool
  IsCompanded() const
  {
    return !m_Table.empty();
  }
  /** Returns the table, from dark to bright. Between its levels the values are interpolated; outside of them the value
   * of the nearest level holds. */
  const std::vector<Local> &
  GetTable() const
  {
    return m_Table;
  }
  /** Returns the number that all codes are multiples of [DN]. */
  double
  GetUnitDn() const
  {
    return m_UnitDn;
  }
  /** Returns the spacing of the codes about a level [DN]; 0 without a table. */
  double
  StepAt(double levelDn) const
  {
    return this->Interpolate(levelDn, &Local::stepDn);
  }
  /** Returns the variance of rounding to the codes about a level [DN^2]; 0 without a table. */
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

/** What is known about the codes of the data. */
struct CodeRange
{
  std::optional<int> bitDepth;                  ///< null for floating-point data
  std::string        bitDepthSource{ "none" };  ///< "given", "data" or "none"
  double             quantisationStepDn{ 0.0 }; ///< spacing of the codes [DN], of companded ones the darkest; 0: none
  bool               isRegular{ true };         ///< false: rescaled data, the spacing varies
  CodeSteps          steps;                     ///< the spacing by level, of companded codes
  std::optional<double> clipLowDn;              ///< a pixel that attains it is clipped [DN]; null: none
  std::optional<double> clipHighDn;             ///< a pixel that attains it is clipped [DN]; null: none
  std::string           clipSource{ "none" };   ///< "given", "pile-up", "code range", "none", or "low: ..., high: ..."

  /** Sets the source of the clip levels from those of the lower and the upper one. */
  void
  SetClipSources(const std::string & low, const std::string & high)
  {
    clipSource = low == high ? low : "low: " + low + ", high: " + high;
  }
  /** The spacing of the codes about a level [DN]; 0: the data have no codes. */
  double
  StepAt(double levelDn) const
  {
    return steps.IsCompanded() ? steps.StepAt(levelDn) : quantisationStepDn;
  }
  /** Whether a pixel with these extremes over time attains a clip level. */
  bool
  IsClippedLow(double minimumDn) const
  {
    return clipLowDn && minimumDn <= *clipLowDn;
  }
  bool
  IsClippedHigh(double maximumDn) const
  {
    return clipHighDn && maximumDn >= *clipHighDn;
  }
  bool
  IsClipped(double minimumDn, double maximumDn) const
  {
    return this->IsClippedLow(minimumDn) || this->IsClippedHigh(maximumDn);
  }
};

/** What the moments of a stack say beside mean and variance. */
struct SensorNoise_EXPORT StackSummary
{
  /** The codes with the clip levels that a pixel attains: one that none attains has cut off nothing. */
  CodeRange
  AttainedCodes() const;

  CodeRange   codes;
  std::size_t clipped{ 0 };     ///< pixels that attain a clip level in a frame
  std::size_t clippedLow{ 0 };  ///< those that attain the lower one
  std::size_t clippedHigh{ 0 }; ///< those that attain the upper one
  std::size_t notFinite{ 0 };   ///< pixels that are NaN or infinite in a frame
};

/** \class IsoIntensitySet
 * \brief Pixels of nearly one intensity, over which a frame's response is averaged: S^* or S_* of (3.7) and (3.13).
 *
 * Sur & Gredi\'ac 2015, https://doi.org/10.1137/140977035. The level u is a quantile of the mean over the pixels kept
 * by the vibration mask. The set is |mean - u| <= 3 sigma_u, with the weights exp(-(mean - u)^2 / (2 sigma_u^2)) of
 * Remark 1.
 *
 * The paper leaves open what sigma_u, "the associated standard deviation", is. Here it is the standard deviation of the
 * *mean* at that level: the median temporal standard deviation of the pixels nearest to the level, over sqrt(T). Read
 * as the standard deviation of one frame it gives spreads of the offset up to ten times smaller than those of the
 * paper's tables.
 *
 * Remark 3 lets the quantile move where the set is too small. Here it moves inwards by 1 % up to four times, and
 * then the band widens by factors of 2, until the set holds MinimumPixels; wideningSteps counts both.
 */
struct SensorNoise_EXPORT IsoIntensitySet
{
  static constexpr std::size_t MinimumPixels = 30;

  double                     levelDn{ 0.0 };             ///< u^* or u_* [DN]
  double                     levelSdDn{ 0.0 };           ///< sigma_u: of the mean, at that level [DN]
  double                     bandSdDn{ 0.0 };            ///< sigma_u of the weights: levelSdDn unless widened [DN]
  double                     temporalVarianceDn2{ 0.0 }; ///< of one frame, at that level [DN^2]
  double                     quantile{ 0.0 };            ///< the quantile that was used, 0 to 1
  unsigned int               wideningSteps{ 0 };         ///< 0: as asked for
  std::vector<std::uint32_t> pixels;                     ///< ascending
  std::vector<double>        weights;                    ///< of each pixel; their sum is 1

  /** Number of equally weighted pixels that would average noise as well: 1 / sum w^2. */
  double
  EffectivePixels() const;
};

/** Flicker and offset of a stack, sections 3.2 and 3.5 of Sur & Gredi\'ac 2015. */
struct FlickerEstimate
{
  std::vector<double> brightRatio;      ///< v^*(t), (3.8) [1]
  std::vector<double> darkResidualDn;   ///< v_*(t), (3.14) [DN]
  double              slopeDn{ 0.0 };   ///< K, slope of v_* against v^* - 1 [DN]
  double              offsetDn{ 0.0 };  ///< mu, (3.16) [DN]
  std::vector<double> gamma;            ///< gamma_t of the whole frame, (3.17) [1]
  double              flickerSd{ 0.0 }; ///< standard deviation of gamma_t over time (by row: root mean square) [1]

  double                    sigmaRows{ 0.0 }; ///< sigma_y [rows]; 0: no gamma_t(y)
  std::size_t               rows{ 1 };        ///< rows of gammaRows, or 1
  std::vector<double>       gammaRows;        ///< gamma_t(y), frame by frame; empty: no gamma_t(y)
  std::vector<std::uint8_t> rowKnown;         ///< per row: whether the row set reaches it; empty: all known

  /** How many standard deviations of its sampling noise the variance of v^* exceeds that noise by; may be infinite. */
  double flickerZ{ 0.0 };
  /** Residual variance of v_* about the line, over that expected of noise: 1 if the model holds. */
  double offsetLinePhi{ 1.0 };

  /** gamma_t, or gamma_t(y) where it is modelled. */
  double
  Gamma(std::size_t t, std::size_t row) const
  {
    return gammaRows.empty() ? gamma[t] : gammaRows[t * rows + row];
  }
  bool
  IsKnown(std::size_t row) const
  {
    return rowKnown.empty() || rowKnown[row] != 0;
  }
};

/** Cov(alpha, beta) of the vibration, with the other coefficients of (2.20). */
struct VibrationCovariance
{
  double      varianceXPixels2{ 0.0 };  ///< of alpha_t, along x [pixel^2]; below 0: none can be seen
  double      varianceYPixels2{ 0.0 };  ///< of beta_t, along y [pixel^2]
  double      covariancePixels2{ 0.0 }; ///< of alpha_t and beta_t [pixel^2]
  double      flickerVariance{ 0.0 };   ///< sigma_gamma^2, the coefficient of the squared mean [1]
  std::size_t pixels{ 0 };
  bool        isDetermined{ false }; ///< false: too few pixels, or a scene without gradients
};

/** A number and its standard error. */
struct MeasuredNumber
{
  double value{ 0.0 };
  double standardError{ 0.0 };

  /** Whether its size is above \a least beyond chance. */
  bool
  Exceeds(double least, double z) const;
};

/** Noise at a level of the light: the mean of a quarter of the pixels. */
struct LightNoise
{
  double         lightDn{ 0.0 }; ///< above the level without light [DN]
  MeasuredNumber varianceDn2;    ///< of a pixel as it is, with the codes' noise [DN^2]
  Quantity       sumOverLags;    ///< as CorrelationEstimate's [1]
};

/** What neighbours and frames share of their noise, and what the variance has to be multiplied by. */
struct CorrelationEstimate
{
  std::size_t width{ 0 };
  std::size_t height{ 0 };
  std::size_t frames{ 0 };     ///< of the stack
  std::size_t framesUsed{ 0 }; ///< of the sample, equal ones counted once
  std::size_t pixelsUsed{ 0 }; ///< of the sample

  NoiseCorrelationRecord correlation;
  /** The sum of the noise's covariances over all lags, relative to the variance of a pixel [1]: after a linear filter
   * whose weights sum to 1, variance times this is the variance before it. The variance is that of the frames about
   * their own mean, which mixed frames make a little less than a value's own: by 1 - 2 (sum of coefficients) / T. 1
   * within its error where the noise is white: the variance is then better left alone. Its error is that of a block
   * jackknife, with what is beyond the last lag. `failed` where the noise is not linear or was not measured. */
  Quantity                sumOverLags{ Quantity::Without(EstimateStatus::Failed) };
  std::vector<LightNoise> lights; ///< from dark to bright; empty: not measured
};

/** The version of its JSON. */
inline constexpr const char * CorrelationSchema = "itk-sensornoise-correlation/1";

/** As JSON: one object, units in each quantity; noise_correlation as in the report's. */
SensorNoise_EXPORT std::string
ToJson(const CorrelationEstimate & estimate);

} // namespace sensornoise

#endif
