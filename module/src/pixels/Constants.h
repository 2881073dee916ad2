// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_pixels_Constants_h
#define sensornoise_pixels_Constants_h

#include "base/Constants.h"

#include <cstddef>

namespace sensornoise
{

/** Constants of the component `pixels` for the rejection of pixels and the variance line. Estimator.md, 3.5 to 3.8. */
struct PixelsConstants
{
  /** \name Roughness */
  ///@{
  /** Standard deviation of the motion up to which the roughness is computed within a radius of 2 pixels [pixel]. For
   * larger motion the radius grows by motionSds standard deviations of the motion, which counts up to largestMotion
   * [pixel]. Chosen empirically. */
  double smallMotion{ 0.35 };
  double motionSds{ 3.0 };
  double largestMotion{ 4.0 };
  /** Largest fraction of a pixel's degrees of freedom that the motion components may take [1]. Chosen empirically. */
  double largestLeverage{ 0.5 };
  /** Smallest loss of degrees of freedom by a change of the illumination that is allowed for, as a fraction [1]. Chosen
   * empirically: below, standard errors are too small by at most half of this fraction. A flicker of 10 % rms has this
   * loss. */
  double leastLossOfDof{ 0.01 };
  /** Largest change of the variance by the rounding of the temporal basis, in units of the standard error of the mean
   * variance of all pixels [1]. Chosen empirically: it does not show in any reported digit. */
  double largestRoundingError{ 0.01 };
  /** Fraction of the roughness classes, the flattest ones, that the first line is fitted to [1]. Chosen empirically. */
  double flatFraction{ 0.6 };
  ///@}

  /** \name Rejection of pixels, neighbourhoods and roughness classes */
  ///@{
  /** Half width of a neighbourhood [pixel]. Chosen empirically: the mean of 225 variances of 100 frames is known to
   * 1 %. */
  std::size_t neighbourhoodRadius{ 7 };
  /** Excess of a neighbourhood's mean variance over the line above which it is rejected [1], and the fraction of its
   * pixels that must count for this test [1]. Chosen empirically. */
  double leastNeighbourhoodExcess{ 0.04 };
  double leastCountedFraction{ 0.3 };
  /** Fraction of the frame's pixels in rejected neighbourhoods below which the line is not fitted again without them
   * [1]. Chosen empirically: so few pixels do not change the line. */
  double fewRejected{ 1e-3 };
  /** Variance of a pixel over its shot noise below which it may be a mean of its neighbours [1]: a mean of two has
   * half.
   */
  double largestQuietVariance{ 0.5 };
  /** Fraction of such pixels from which they are left out [1]: fewer change the gain by at most 0.15 %. */
  double leastQuietFraction{ 1e-3 };
  /** A roughness class is rejected if its mean variance exceeds the mean of the flat classes by this fraction [1], or
   * if its fraction of outliers exceeds their fraction by this number [1]. Chosen empirically. */
  double leastClassExcess{ 0.0015 };
  double leastClassOutliers{ 0.01 };
  /** The flattest class that can be rejected. Chosen empirically: the classes below it are the reference. */
  std::size_t firstTestedClass{ 4 };
  ///@}

  /** \name The first line */
  ///@{
  /** Number of bins of the square root of the signal, or of levels of the rejection model, and the pixels that a bin
   * must have to count. Chosen empirically: an extrapolation by a factor of 2 or more is detected, and the median of 50
   * variances is known to 4 %. */
  std::size_t levelBins{ 16 };
  std::size_t leastPixelsOfLevel{ 50 };
  /** Fraction of the bright pixels that must be near a line through dark and bright pixels [1]. Chosen empirically: in
   * most scenes edges move. */
  double leastFractionNearLine{ 0.75 };
  ///@}

  /** \name The rejection model */
  ///@{
  /** Side of a tile [pixel], also for the fixed pattern of large frames. Chosen empirically: the mean of a tile is
   * known to 2 %, and its pixels are of about one level. With a side of 8 in large frames, the flattest tiles are those
   * whose few columns are alike by chance. */
  static constexpr std::size_t tileSide{ 16 }; // a constant expression: the size of arrays
  /** Number of tiles that suffice. Every second tile is used if there are twice as many or more, every third if there
   * are three times as many, and so on. Chosen empirically: the medians at 16 levels are known to 0.2 %. Half and twice
   * this number change no gain of 1024 x 1024 pixels by more than 0.05 of its error. */
  std::size_t enoughRejectionTiles{ 1024 };
  /** Smallest number of tiles at each level. Chosen empirically. */
  std::size_t tilesPerLevel{ 8 };
  /** Deviation of the variance from its line, beyond chance, above which it counts and is reported [1]. Chosen
   * empirically: it changes the gain by about half of it. Neighbourhoods are rejected from 4 % on, and half of this
   * deviation is within the noise of frames of 128 x 128 pixels. */
  double leastDeviation{ 0.01 };
  /** The darkest tiles, one in this number, give the dispersion of the noise from pixel to pixel. Chosen
   * empirically. */
  std::size_t darkTilesOneIn{ 5 };
  /** Variance that the offset pattern (DSNU) adds to the line's value, relative to the square of this value at the
   * darkest level. Up to this limit pixels are tested at their own level, above it at their neighbours' level [1].
   * Chosen empirically: at the limit a ratio of variances is biased by 2 %. */
  double largestDsnuEffect{ 0.02 };
  ///@}

  /** \name The variance line */
  ///@{
  /** Probability of each trimmed tail of chi-square where pixels are tested [1]. Chosen empirically. */
  double trimTail{ 1e-4 };
  /** Fraction of the variance of the neighbours' means that must be common to the pixels' own, for these means to be
   * the instrument of the line that pixels are tested against [1]. Chosen empirically: where the rest is larger, most
   * is fixed-pattern noise, and both lines are imprecise. */
  double leastCommonVariance{ 0.5 };
  /** Smallest number of pixels of a bin of the first line, and of a fit. Chosen empirically. */
  double      fewestPixelsOfBin{ 5.0 };
  std::size_t fewestPixelsOfFit{ 10 };
  /** Iterations from the line of these pixels to the line of all pixels (estimator.md, 3.6). One iteration leaves 0.2
   * errors of the gain with 1 % noisy pixels, elsewhere 1e-4; four leave 5e-5. */
  int stepsFromRoughLine{ 2 };
  /** Derivative of the fitted gain with respect to the gain that corrects the variances. Up to this limit no fixed
   * point is needed [1]: the error of the gain is then at most 1 % too small. Chosen empirically. */
  double leastFeedback{ 0.01 };
  /** Largest derivative with which the frames determine a gain [1]. Above it nine tenths of the fitted gain are the
   * gain that was put in, and errors of the rest count ten times. Chosen empirically. */
  double largestFeedback{ 0.9 };
  /** The fewest frames that together carry this fraction of the illumination are named as the reason of a failed
   * estimate [1]. Chosen empirically. */
  double fractionOfFewFrames{ 0.9 };
  /** Relative change of the gain that ends the iteration of fits and corrections [1]. Chosen empirically: the solution
   * is exact but for weights and outliers, which change once or twice. */
  double fixedPointChange{ 1e-4 };
  /** Determinant of a line's normal equations, relative to the product of their diagonal, up to which all levels are
   * equal but for rounding [1]. */
  double leastDeterminant{ 1e-12 };
  /** Probability that a pixel of the brightest level is beyond the limit of TrimRule::Distance by chance [1]. Chosen
   * empirically, so small that it does not bias the mean: a tenth and ten times of it change no gain by 0.01 %. */
  double reachTail{ 1e-5 };
  /** Dispersion of the pixels' noise variances, relative to their sampling variance, below which the weights neglect it
   * [1]. Chosen empirically: at the limit equal weights cost 0.3 % of the precision. */
  double leastNoiseDispersion{ 0.1 };
  /** Largest error by fixed-pattern noise that is neglected, in standard errors [1]. Chosen empirically: it adds 3 % to
   * the error. */
  double negligiblePattern{ 0.25 };
  ///@}

  /** \name Noise of companded digital numbers */
  ///@{
  /** Relative uncertainty of the quantization noise [1]. Chosen empirically on data companded by square roots, powers
   * and logarithms to 8 and 10 bits, at four gains. A scene of few levels left 0 to 6 % of this noise in the slope
   * where the quantization step is as large as the noise; a texture left less. */
  double errorOfQuantisationNoise{ 0.05 };
  /** Error of the variance at one level because the expanded digital numbers are rounded to their unit, relative to the
   * unit times the square root of noise and step [1]. Chosen empirically on charts whose darkest patch has one
   * level. */
  double errorOfRounding{ 0.15 };
  ///@}
};

SENSORNOISE_CONSTANT PixelsConstants InPixels;

/** Constants of the component `pixels` for fixed-pattern noise and local illumination. Estimator.md, 3.7. */
struct PatternConstants
{
  /** Side of a tile in small frames [pixel], and the pixels of a large frame. Many columns are needed to measure a
   * pattern of columns, but a small frame may have no large flat tile. Chosen empirically. */
  std::size_t smallTileSide{ 8 };
  std::size_t largeFramePixels{ 16384 };
  /** Smallest number of pixels of either half of a tile. Chosen empirically. */
  double leastHalfPixels{ 24.0 };
  /** Fraction of the tiles that count as the flattest [1], and their smallest number. Chosen empirically: with half and
   * twice this fraction, the results for natural scenes change by a third. */
  double      flattestFraction{ 0.05 };
  std::size_t fewestPatternTiles{ 4 };
  /** Largest standard deviation of the fixed-pattern noise of real sensors: of gain or efficiency (PRNU), relative to
   * the mean [1], and of offset (DSNU), in units of the noise at the level of the flattest tiles [1]. Larger
   * differences, in a scene without flat areas, are signal. Chosen empirically, three times and twice the values of
   * data sheets and measured sensors. */
  double largestGain{ 0.03 };
  double largestOffset{ 5.0 };
  /** Largest step between parts of a sensor, relative to the signal [1]: larger ones are of the scene. Chosen as twice
   * the largest difference of amplifiers that is known from reports. */
  double largestStep{ 0.1 };
  /** Least fraction of the pixels beside a boundary whose levels are known [1]. A judgement: a step along less than
   * that may be of the scene. */
  double leastPairs{ 0.5 };
  /** Variance of the slope from whole columns or rows, relative to the variance from pixels, above which it exceeds
   * chance [1]. Chosen empirically: with 256 columns the ratio scatters by 0.1. */
  double leastLikeness{ 1.5 };

  /** Limits for tiles with local illumination. leastLeakagePixels, leastTilePixels: the pixels that a tile needs for a
   * line, to estimate the leakage of motion and the offset. leastTileContrast: the variance of its levels, relative to
   * the noise of their means, that the offset needs [1]. Chosen empirically. */
  double leastLeakagePixels{ 20.0 };
  double leastTilePixels{ 12.0 };
  double leastTileContrast{ 30.0 };
  /** Dispersion of the lines of tiles about one zero, above 1, that counts in the error alone, however significant it
   * is [1]. Chosen by its effect: it widens the error by 12 %. */
  double smallDispersion{ 0.25 };
  /** Least excess of what the derivatives explain in single tiles, relative to chance, that is motion of their own [1].
   * Chosen empirically, on bursts in which half of the scene sways by 0.05 pixels,
   * and on bursts under two lamps. */
  double leastLocalMotion{ 0.1 };
  /** Limits for local illumination to be a drift of the offset: side of a tile [pixel], largest chi-square about one
   * line, relative to the number of tiles [1], and the smallest chi-square that the line explains,
   * relative to that chi-square [1]. Chosen empirically. */
  std::size_t driftTileSide{ 32 };
  double      largestDriftChi2{ 4.0 };
  double      leastDriftExplained{ 10.0 };
};

SENSORNOISE_CONSTANT PatternConstants InPattern;

/** Constants of the component `pixels` for the comparison of the gains of the parts of a frame. Estimator.md, 3.15. */
struct PartsConstants
{
  /** Largest number of tiles along an axis, and of larger tiles whose 16 phases are compared. Chosen empirically: the
   * regressions then take a few per cent of the time of a burst. */
  std::size_t mostTiles{ 32 };
  std::size_t mostPhaseTiles{ 8 };
  /** Number of tiles that a comparison needs. Chosen empirically. */
  std::size_t fewestTiles{ 24 };
  /** Variance of a pixel over the line above which the sums leave it out, because it is defective or something moves
   * [1]. Chosen above the joint effect of twice the gain and of chance in 10 frames. */
  double largestRatio{ 6.0 };
  /** Smallest difference of the gains that counts, rms over the pixels [1]. Chosen by the size of the effect: below,
   * the gain of no half deviates by more than its error in bursts of 100 frames. */
  double leastDifference{ 0.0075 };
  /** Smallest difference of the gains that the rejection of pixels allows for [1]. Neighbourhoods are rejected from 4 %
   * on. */
  double largeDifference{ 0.0125 };
  /** Dispersion of the tiles within parts over their sampling error, up to which the parts are uniform [1]. Moving
   * objects make it 10 and more. Chosen empirically. */
  double largestScatter{ 3.0 };
  /** Least fraction of the pixels that are left out as not static, for which their gain is compared [1]. Chosen by the
   * size of the effect: twice the gain in so many pixels is a tenth of the mean gain. */
  double leastLeftOut{ 0.1 };
  /** Largest scatter of the excess of tiles, and largest difference between less and more rough surroundings, relative
   * to the excess, for which it is a gain [1]. Chosen empirically: gains in blobs and at edges make 0.03 to 0.3,
   * objects that move 0.4 and more. */
  double largestSpread{ 0.3 };
  /** Smallest rms difference between the gains of columns, and between the gains of rows, that is by interpolation
   * where both have it [1]: linear weights at evenly spread places make 22 %, amplifiers a few per cent. */
  double sizeByWeights{ 0.1 };
  /** Number of pixels from which the effect of the parts on the line is computed: it is an error, and the sampling
   * noise of its derivatives is below 1 %. */
  std::size_t pixelsOfDerivatives{ std::size_t{ 1 } << 18 };
  /** Prior odds of a sensor whose halves, or quadrants, have unlike variances without signal, against a uniform sensor
   * [1]: a judgement, one sensor of ten. With odds of 1, differences by chance make the errors of the gain up to 1.7
   * times as large. */
  double priorOfUnlikeParts{ 0.1 };
  /** Prior standard deviations of the coefficients [1]: gains, and variances without signal (read noise, offset), agree
   * within a factor of 2, and a curve deviates from its line by a few per cent. */
  double priorOfParts{ 1.0 };
  double priorOfCurve{ 0.05 };
  /** Number of knots of the curve, and rounds of the regression; half of the rounds minimize absolute deviations. */
  std::size_t knots{ 6 };
  int         rounds{ 12 };
  /** Number of levels at which a step is tried, or a curve has its knots. Chosen for the time. */
  std::size_t levelsOfStep{ 32 };
  /** Tukey's constant for 95 % of the efficiency of least squares (Beaton & Tukey 1974) [1]. */
  double tukey{ 4.685 };
};

SENSORNOISE_CONSTANT PartsConstants InParts;

/** Constants of the component `pixels` for the detection of a step of the variance. Estimator.md, 3.16. */
struct StepConstants
{
  /** Reduced chi-square of the variance about its line above which a step is tested [1]. A step of five standard errors
   * increases the reduced chi-square of 64 bins by this much. */
  double leastChi2{ 1.25 };
  /** Smallest size of a step that counts, relative to the larger of the variances beside it [1]. Chosen by the size of
   * the effect: in the middle of the levels a step of this size changes the gain by 1 to 2 %. */
  double leastSize{ 0.03 };
  /** Fraction of its size that a step must keep beside a parabola [1]; a smooth non-linearity keeps nothing. Chosen
   * empirically. */
  double leastBesideCurve{ 0.5 };
  /** Smallest number of bins on either side of a step, whose slope both sides share. A single bin may be an outlier. */
  std::size_t leastBins{ 2 };
  /** Prior standard deviation of the gain of either amplifier from the common gain, after the camera has matched them
   * [1]. From public reports on dual-gain sensors, whose branches differ by 0.5 to 2 % in level. */
  double priorOfGains{ 0.01 };
};

SENSORNOISE_CONSTANT StepConstants InSteps;

} // namespace sensornoise

#endif
