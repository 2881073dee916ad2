// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_correlation_Constants_h
#define sensornoise_correlation_Constants_h

#include "base/Constant.h"

#include <cstddef>

namespace sensornoise
{

/** The numbers of the room `correlation`. Estimator.md, 3.12. */
struct CorrelationConstants
{
  /** \name The sample */
  ///@{
  /** Tiles, pixels and degrees of freedom below which nothing is measured. Set by hand. */
  std::size_t leastTiles{ 4 };
  std::size_t leastPixels{ 1024 };
  double      leastFreedom{ 3.0 };
  /** Bins of equal count along the light in which the variance is averaged, at most, and the least pixels of one. Set
   * by hand. */
  std::size_t noiseBins{ 32 };
  std::size_t leastPixelsOfBin{ 256 };
  /** Part of the levels' range above black up to which the darkest may lie to be the zero of the light [1]: flat fields
   * have none that is near it. Set by hand. */
  double darkShare{ 0.3 };
  /** Part of the square of the products of the lights that is their spread, from which levels tell what grows with the
   * light from what does not [1]: below, the error of both would be seven times that of their sum. Set by hand. */
  double leastSpread{ 0.05 };
  /** Tiles whose lines determine the illumination of rows, at most; of more tiles, every n-th line is taken. Chosen for
   * the time: a thousandth of that of 100 frames of 512 x 512 pixels. */
  std::size_t mostTilesOfLineLight{ 32 };
  /** Smallest spread of the signal along a line, relative to its mean square, for a regression on the signal beside the
   * constant [1]: a guard against rounding, as both are taken off together. */
  double leastSpreadOfLine{ 1e-4 };
  /** Smallest part of a pixel's variance that taking off its line may leave [1]: a pixel that makes up half of its line
   * determines the line, and not its own noise. */
  double leastLeftOfLine{ 0.5 };
  /** Part of the lines' variance that the series of the scene may take for light [1]. Set by hand: a row noise as large
   * as the read noise loses 3 to 8 %. */
  double lostToSeries{ 0.04 };
  ///@}

  /** \name Whether neighbours share */
  ///@{
  /** Coefficient that is worth a word [1]. Set by hand: charge coupling of 0.3 % makes 0.006 of it, the noise of a
   * plain sample 0.0004 to 0.0007. */
  double leastCoefficient{ 0.002 };
  /** What the nearest four share together that is worth a word, relative to the variance of the bright pixels [1].
   * Chosen by the size of the effect, which the gain has, too: a brighter-fatter effect of 2 % at full well makes 0.02.
   */
  double leastEffect{ 0.0025 };
  ///@}

  /** \name The sum over neighbours */
  ///@{
  /** What a further ring adds to the sum that is left out of it and counted as its error, even if it is seen, of the
   * sum [1]. Set by hand: the error of the sum is 0.2 % at best. With 0.005 the gain after smoothing by 0.6 pixels is
   * 0.6 % low where the frames are large. */
  double leastRing{ 0.001 };
  /** Of the sum over lags [pixels]: smoothing by a Gaussian of 1 pixel reaches as far. */
  int largestReach{ 5 };
  /** Of the error of the next ring, that it may hold where it is not seen [1]. Set by hand: intervals of smoothed
   * frames of 256 x 256 pixels hold the gain in 239 of 240 with 1, in 238 with 0.75; those of 512 x 512 in 18 of 20
   * with 1, in 17 with 0.75, in 16 with half. Of brighter-fatter sensors twice makes errors 1.4 times as large. */
  double unseenErrors{ 0.75 };
  /** The same where it is left out because charge reaches less far [1]. Set by hand. */
  double unseenErrorsOfCharge{ 0.5 };
  /** Of the size of the next, that all rings beyond largestReach may add [1]: 1.3 for a Gaussian of 1.5 pixels, 1.7 of
   * 2. */
  double ringsBeyondReach{ 2.0 };
  ///@}

  /** \name Kinds and shapes */
  ///@{
  /** Coefficient up to which charge may be coupled [1]: sensors have a few hundredths. */
  double largestCrosstalk{ 0.06 };
  /** Distance up to which charge is coupled [pixels]. Set by hand. */
  int reachOfCharge{ 2 };
  /** What is farther, relative to the variance, that tells a filter from coupled charge [1]. Set by hand. */
  double smallRing{ 0.005 };
  /** Evidence that a constant needs, as a difference of chi-squares [1]: one in e. Set by hand. */
  double evidenceOfConstant{ 2.0 };
  /** Evidence that each part of the noise after a filter needs, as a difference of chi-squares [1]: 2 ln 16, so that
   * all together are as probable as none. */
  double evidenceOfPart{ 5.545 };
  /** Chi-square that a bend of the variance may count at most [1]: the response may bend, too. Set by hand. */
  double mostEvidenceOfBend{ 20.0 };
  /** Part of that chi-square that may be left of a bend that charge makes [1]. Set by hand. */
  double largestShareOfBend{ 0.5 };
  /** Probability from which what neighbours share, with the opposite sign, is taken for the rounding of blocks [1]. Set
   * by hand. */
  double roundingProbability{ 0.05 };
  /** Chi-square of the best shape from which nothing explains it [1]: the 99 % quantile for four bins and one number.
   */
  double largestChi2{ 11.3 };
  /** Root mean square by which a negative share of nearest neighbours may differ with the place in a block [1]. Set by
   * hand: a JPEG of quality 98 makes 0.01. (A positive one may: frames that were binned, sensors read in groups of
   * rows.) */
  double largestSpreadOfPhases{ 0.003 };
  /** Frequency from which a coefficient's oscillation is looked for [cycles/pixel]: enlargements up to 16 times. */
  double leastCyclesPerPixel{ 1.0 / 16.0 };
  /** Amplitude that only fewer samples than pixels leave [1]. Set by hand: enlarging by 1.25 to 4 times, doubling and
   * the interpolation of a mosaic make 0.16 to 0.64, filters of a texture, a chart or a ramp at most 0.008. */
  double leastOscillation{ 0.03 };
  /** Of its square to the mean of those at other frequencies [1]: chance exceeds it in one of 10^6 spectra of 10^5. */
  double oscillationRatio{ 25.0 };
  /** Part of the noise variance that places which move by themselves may have where neighbours share noise [1]. Chosen
   * by the size of the effect: the lags within reach sum up to ten times as much. */
  double leastLocalMotion{ 0.005 };
  /** Excess kurtosis that no linear filter leaves [1]. Set by hand: the correction of defects at 3 standard deviations
   * makes -0.06 to -0.08 of the noise and 0.1 to 0.25 of four neighbours in turn, white and filtered noise 0.01. */
  double largestExcess{ 0.04 };
  /** Part of a pixel's variance that a series must have for its kurtosis to count [1]. Set by hand: of copies of a
   * pixel nothing is left but rounding. */
  float leastNoise{ 1e-3F };
  ///@}

  /** \name Frames */
  ///@{
  /** Coefficient that is worth a word [1]. Set by hand: slow drifts of a few pixels make 0.003 of it. */
  double leastTimeCoefficient{ 0.01 };
  /** Coefficient of the last two lags at which the sum ends [1], and the lags that it may have at most [frames]: three
   * quarters of the last frame are forgotten after 20. */
  double smallTimeCoefficient{ 0.005 };
  int    mostTimeLags{ 24 };
  /** Frames after which a recursive filter has forgotten how it began, for its first frame is not filtered; and at most
   * one in so many of all. Set by hand. */
  std::size_t firstFrames{ 8 };
  std::size_t firstFramesOneIn{ 5 };
  ///@}
};

SENSORNOISE_CONSTANT CorrelationConstants InCorrelation;

} // namespace sensornoise

#endif
