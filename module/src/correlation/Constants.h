// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_correlation_Constants_h
#define sensornoise_correlation_Constants_h

#include "base/Constants.h"

#include <cstddef>

namespace sensornoise
{

/** Constants of the component `correlation`. Estimator.md, 3.12. */
struct CorrelationConstants
{
  /** \name The sample */
  ///@{
  /** Smallest numbers of tiles, pixels and degrees of freedom for a measurement. Chosen empirically. */
  std::size_t leastTiles{ 4 };
  std::size_t leastPixels{ 1024 };
  double      leastDof{ 3.0 };
  /** Largest number of intensity bins of equal count in which the variance is averaged, and smallest number of pixels
   * in one bin. Chosen empirically. */
  std::size_t noiseBins{ 32 };
  std::size_t leastPixelsOfBin{ 256 };
  /** The darkest level is taken as the zero of the signal if it lies below this fraction of the range from black to the
   * brightest level [1]: flat fields have no level near black. Chosen empirically. */
  double darkFraction{ 0.3 };
  /** Smallest determinant of the two normal equations, relative to the product of their diagonal, for which a component
   * that grows with the signal is separated from a constant one [1]. Below it, the error of either component would be
   * seven times the error of their sum. Chosen empirically. */
  double leastSpread{ 0.05 };
  /** Number of tiles that suffice to find illumination of rows and echoes; of more tiles, every n-th line or tile is
   * used. Chosen for the computing time: a thousandth of the time for 100 frames of 512 x 512 pixels. */
  std::size_t tilesOfFirstLook{ 32 };
  /** Smallest variance of the signal along a line, relative to its mean square, for which the signal is a regressor
   * beside the constant [1]. It guards against rounding errors, as both regressors are subtracted together. Also of
   * cosine and sine of a wave along a tile. */
  double leastVarianceOfLine{ 1e-4 };
  /** Smallest fraction of a pixel's variance that may remain after the regression along its line [1]. A pixel that
   * makes up half of its line determines the regression, and little of its own noise remains. */
  double leastLeftOfLine{ 0.5 };
  /** Fraction of the variance of row or column noise that the temporal components of the scene may absorb as
   * illumination [1]. Chosen empirically: row noise as large as the read noise loses 3 to 8 %. */
  double fractionLostToComponents{ 0.04 };
  ///@}

  /** \name Periodic interference */
  ///@{
  /** Number of spectra of a tile in a frame that are averaged: a line of 0.15 % of the noise variance doubles the power
   * of its frequency, and chance changes the power by 6 %. More spectra cost time in proportion. */
  std::size_t spectra{ 256 };
  /** Smallest ratio of the power of a line to the largest power at a distance of two frequencies [1]. Filters that
   * smooth by up to 1.2 pixels change it by 1.25 at most; 2 % of the power of a line leak to that distance. */
  double leastPeak{ 2.0 };
  /** Largest number of waves: a pulse of the power supply has some harmonics. */
  std::size_t mostWaves{ 8 };
  /** Smallest number of pixels of a tile in which a wave is subtracted: both amplitudes then take 3 % of the noise. */
  std::size_t leastPixelsOfWave{ 64 };
  ///@}

  /** \name Pixels that are computed from their neighbours */
  ///@{
  /** Largest number of frames on which pixels are compared with their neighbours: by 32 frames one measured pixel in
   * 10^6 differs from them as little as a computed one. */
  std::size_t framesOfComparison{ 32 };
  /** Largest mean square of the difference between a pixel and the mean of its neighbours, relative to the median of
   * all pixels, for which the pixel may be computed [1], and its smallest value. Rounding makes 0.06 where the noise is
   * of one quantization step. The pixels from whose mean another one is computed have 0.25 or more. */
  float largestDifference{ 0.15F };
  float smallestDifference{ 0.02F };
  /** Smallest fraction of such pixels for which they are left out [1]: fewer change the gain by at most 0.1 %. */
  double leastInterpolated{ 5e-4 };
  /** Largest fraction of such pixels [1]: of a demosaiced frame half of the pixels or more are computed. */
  double mostInterpolated{ 0.1 };
  /** Largest fraction of the pixels found that may be found by chance [1], which changes the gain by a tenth of the
   * effect of computed pixels. */
  double mostByChance{ 0.1 };
  ///@}

  /** \name Detection of spatial noise correlation */
  ///@{
  /** Reporting threshold of a correlation coefficient [1]. Chosen empirically: charge coupling of 0.3 % makes a
   * coefficient of 0.006, the noise of an unprocessed sample 0.0004 to 0.0007. */
  double leastCoefficient{ 0.002 };
  /** Reporting threshold of the summed covariance with the nearest four neighbours, relative to the variance of the
   * bright pixels [1]. Chosen by the effect on the gain, which is as large: a brighter-fatter effect of 2 % at full
   * well makes 0.02. */
  double leastEffect{ 0.0025 };
  /** Least covariance of neighbours in the median tile, relative to the mean of all tiles [1]: a filter acts
   * everywhere, and details of the scene that move act in few tiles. Chosen empirically. */
  double leastTypical{ 0.5 };
  ///@}

  /** \name The total covariance over spatial lags */
  ///@{
  /** Covariance of the next ring, relative to the total covariance, below which the ring is left out and counted as an
   * error, even if it is significant [1]. Chosen empirically: the error of the total is 0.2 % at best. With 0.005 the
   * gain after smoothing by 0.6 pixels is 0.6 % low where the frames are large. */
  double leastRing{ 0.001 };
  /** Largest distance of the lags that are summed [pixels]: smoothing by a Gaussian of 1 pixel reaches as far. */
  int largestReach{ 5 };
  /** Error that is added for a next ring without significant covariance, relative to the standard error of that ring
   * [1]. Chosen empirically: for smoothed frames of 256 x 256 pixels, the interval contains the gain in 239 of 240
   * cases with 1, and in 238 with 0.75. For frames of 512 x 512 pixels, it does in 18 of 20 cases with 1, in 17 with
   * 0.75, and in 16 with 0.5. For brighter-fatter sensors, twice the value makes errors 1.4 times as large. */
  double unseenErrors{ 0.75 };
  /** Error as \a unseenErrors, for a ring that is left out because coupled charge does not reach it [1]. Chosen
   * empirically. */
  double unseenErrorsOfCharge{ 0.5 };
  /** Largest total of all rings beyond largestReach, relative to the next ring [1]: the total is 1.3 for a Gaussian of
   * 1.5 pixels, 1.7 for a Gaussian of 2 pixels. */
  double ringsBeyondReach{ 2.0 };
  ///@}

  /** Least covariance of the four nearest neighbours at the bright levels, relative to the variance, if there is none
   * at all levels [1]: the illumination changes in fine patterns. Chosen by the size of the effect: where simulated
   * stars twinkle, the gain is a quarter of it too large. */
  double leastBrightCovariance{ 0.05 };

  /** \name Noise classes and shapes */
  ///@{
  /** Largest coefficient that coupled charge may cause [1]: sensors have a few hundredths. */
  double largestCrosstalk{ 0.06 };
  /** Largest distance over which charge is coupled [pixels]. Chosen empirically. */
  int reachOfCharge{ 2 };
  /** Covariance beyond that distance, relative to the variance, above which the cause is a filter and not coupled
   * charge [1]. Chosen empirically. */
  double smallRing{ 0.005 };
  /** Evidence that is required for a constant covariance, as a difference of chi-squares [1]: a prior probability of
   * one in e. Chosen empirically. */
  double evidenceOfConstant{ 2.0 };
  /** Evidence that is required for each fraction of the noise after a filter, as a difference of chi-squares [1]. With
   * 2 ln 16 all fractions together have the prior probability of none. */
  double evidenceOfPart{ 5.545 };
  /** Largest difference of chi-squares that a curvature of the variance contributes [1], as a non-linear response
   * causes curvature, too. Chosen empirically. */
  double mostEvidenceOfCurvature{ 20.0 };
  /** Largest fraction of that chi-square that may remain when the brighter-fatter effect explains the curvature [1].
   * Chosen empirically. */
  double largestFractionOfCurvature{ 0.5 };
  /** Probability of a constant covariance above which a negative noise correlation is attributed to the rounding of
   * blocks [1]. Chosen empirically. */
  double roundingProbability{ 0.05 };
  /** Chi-square of the best shape above which no shape explains the covariance [1]: the 99 % quantile for four bins and
   * one fitted number. */
  double largestChi2{ 11.3 };
  /** Largest root mean square by which a negative correlation of nearest neighbours may depend on the position in a
   * block [1]. Chosen empirically: a JPEG of quality 98 makes 0.01. A positive correlation may depend on it: frames
   * may have been binned, or rows read in groups. */
  double largestRmsOfPhases{ 0.003 };
  /** Lowest frequency at which an oscillation of a coefficient is searched [cycles/pixel]: enlargements up to 16 times.
   */
  double leastCyclesPerPixel{ 1.0 / 16.0 };
  /** Amplitude above which frames have fewer samples than pixels [1]. Chosen empirically: enlarging by 1.25 to 4 times,
   * doubling and the interpolation of a mosaic make 0.16 to 0.64. Filters make at most 0.008 on a texture, a chart or
   * a ramp. */
  double leastOscillation{ 0.03 };
  /** Exponent of the ratio of the smallest to the largest variance around a pixel, by which pairs count [1]. Chosen
   * empirically: a ratio of 0.9 counts 0.43, of 0.5 nothing. */
  double exponentOfFlatness{ 8.0 };
  /** Smallest ratio of the squared amplitude to the mean squared amplitude at other frequencies [1]: by chance, one in
   * 10^6 spectra of 10^5 frequencies exceeds it. */
  double oscillationRatio{ 25.0 };
  /** Reporting threshold of local motion of the scene, as a fraction of the noise variance, where the noise is
   * spatially correlated [1]. Chosen by its effect: the lags within reach sum up to ten times as much. */
  double leastLocalMotion{ 0.005 };
  /** Excess kurtosis that no linear filter causes [1]. Chosen empirically: the correction of defects at 3 standard
   * deviations makes -0.06 to -0.08 for pixels, and 0.1 to 0.25 for alternating sums of four neighbours. White and
   * filtered noise make 0.01. */
  double largestExcess{ 0.04 };
  /** Excess kurtosis of the differences between successive frames that no linear filter causes [1]. Chosen empirically:
   * noise reduction that mixes frames only where they differ little makes 0.2 to 20. */
  double largestExcessOfSteps{ 0.1 };
  /** Largest coefficient of neighbouring frames for which the kurtosis behind a recursive filter is computed [1].
   * Behind a stronger filter, a burst has too few independent frames. */
  double largestRecursion{ 0.9 };
  /** Begin of the upper tail, in standard deviations [1]. Normal noise has 0.023 % of its values there, few electrons
   * have more. Outliers are removed from 2.5 to 3.5 on, about a centre that is estimated from the frames. */
  double tailBegins{ 3.5 };
  /** Fraction of the upper tail of normal noise that is missing where a camera removes outliers [1]. Chosen by its
   * effect: their removal at 3 standard deviations makes the gain 2 to 5 % too small. */
  double largestTailDeficit{ 0.25 };
  /** Smallest noise variance of a pixel whose tail counts, in variances of the quantization [1]: its standard deviation
   * is twice the quantization step. */
  double leastVarianceOfTail{ 48.0 };
  /** Smallest variance of a series, relative to the variance of its pixel, for which its kurtosis counts [1]. Chosen
   * empirically: differences of pixels that are copies of each other contain rounding errors only. */
  float leastNoise{ 1e-3F };
  ///@}

  /** \name Temporal noise correlation */
  ///@{
  /** Correlation coefficient of frames above which their covariance is summed, until the last two lags are below it
   * [1]. Chosen empirically: slow drifts of a few pixels make 0.003. */
  double leastTimeCoefficient{ 0.005 };
  /** Largest number of lags [frames]: of a filter that keeps three quarters of the previous frame, less than 0.5 %
   * remains after 20 frames. */
  int mostTimeLags{ 24 };
  /** Largest misfit of white noise with a tail, over the misfit of white noise alone [1]: recursive filters of first
   * order have 0.00 to 0.05 by the noise of small frames, means over 4 or 5 frames at least 0.18. */
  double largestTailMisfit{ 0.1 };
  /** Largest ratio of successive autocovariances of a tail [1], of a filter that keeps 95 % of the previous frame:
   * slower noise is hardly distinguishable from the temporal components. */
  double largestTailRatio{ 0.95 };
  /** Number of frames after which the first frame, which a recursive filter leaves unfiltered, has no influence. At
   * most one in \a firstFramesOneIn frames is left out for it. Chosen empirically. */
  std::size_t firstFrames{ 8 };
  std::size_t firstFramesOneIn{ 5 };
  ///@}
};

SENSORNOISE_CONSTANT CorrelationConstants InCorrelation;

} // namespace sensornoise

#endif
