// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_moments_Constants_h
#define sensornoise_moments_Constants_h

#include "base/Constants.h"

#include <cstddef>
#include <cstdint>

namespace sensornoise
{

/** The numbers of the component `moments`. */
struct MomentsConstants
{
  /** A pixel is defective if its read noise is more than this many times the read noise of a typical pixel [1]. Chosen
   * empirically on the noise of an sCMOS sensor (log-normal, standard deviation 0.4, a tail of 10 %): a factor of 4
   * removes 9 % of the rms noise, 8 removes 3 %, 16 less than 1 %. But 16 keeps pixels of ten times the noise; if they
   * are a hundredth of all pixels, their variance is larger than the variance of all others. If 1 % of the pixels are
   * so noisy, half of this factor makes the error of the gain 1.1 times as large, twice this factor 12 times. */
  double defectiveNoiseFactor{ 8.0 };

  /** \name Saturation levels found from repeated extreme values */
  ///@{
  /** Levels inside of the outermost level with which it is compared [levels]. Chosen empirically. */
  int levelsInsideClip{ 16 };
  /** Least number of pixels that have a saturation level as their extreme. Chosen empirically. */
  std::size_t fewestPixelsOfClipLevel{ 8 };
  /** A saturation level has more than this many times as many pixels as any of the levels inside [1]. Chosen
   * empirically: noise alone stays below it. */
  std::size_t clipLevelRatio{ 3 };
  /** Depth of the extremes, see ExtremeDepths, from which they are rare noise and no clip level [standard deviations].
   * Chosen empirically. */
  double largestClipDepth{ 2.5 };
  /** Largest number of stray pixels (stuck or hot ones) beyond a saturation level, relative to the pixels of that level
   * [1]. Chosen by design: a sensor whose pixels pass a level more often does not clip there. */
  double largestStrayFraction{ 0.1 };
  /** Least number of empty levels between a saturation level and the pixels beyond it, from which these pixels are
   * stray [levels]. Chosen by design: the tail of a noise has no gap of this width. */
  int levelsOutsideClip{ 4 };
  ///@}

  /** \name Counts from 0 */
  ///@{
  /** Range of the mean in which the ratio of variance to mean is examined [counts]. Below it, rare events dominate the
   * ratio; above it, a flicker of 3 % adds 2 % to the variance. */
  double leastCount{ 0.25 };
  double largestCount{ 30.0 };
  /** Largest relative standard error of the ratio of a group of pixels that is used, and largest relative difference of
   * the ratios of counts [1]. Chosen empirically: read noise of 0.3 steps changes the ratio by a tenth. */
  double errorOfCountRatio{ 0.02 };
  double largestCountRatio{ 0.05 };
  ///@}

  /** \name Quantization steps */
  ///@{
  /** Digital numbers off the grid up to which digital numbers are regular: a fraction of all digital numbers [1], plus
   * a number of digital numbers. Chosen empirically. */
  double largestOffGridFraction{ 0.02 };
  double offGridNumbers{ 2.0 };
  /** Least number of levels of floating-point data that must lie on a grid: by chance one grid in 10^21 holds so many.
   */
  std::size_t fewestLevelsOfGrid{ 32 };
  /** Largest distance of a level from the grid, relative to the step [1]. It allows for the rounding of scaled digital
   * numbers.
   */
  double largestOffGrid{ 0.1 };
  /** Least step of the grid, in units of the last digit of the largest level [1]: with smaller steps nearly every level
   * lies on the grid. */
  double leastStepInDigits{ 16.0 };
  /** Quantile of the spacings of the outermost levels that is taken as their step [1]. Chosen empirically: some levels
   * are missing. */
  double stepQuantile{ 0.1 };
  /** Least number of pixels of each of two neighbouring digital numbers whose distance is used. Where digital numbers
   * have 8 pixels on average, a number between them has none with a probability of e^-8. */
  std::uint32_t leastPixelsPerNumber{ 8 };
  /** Least number of distances whose mean is a local step: rounding changes each distance, and also their sum, by at
   * most 1 DN. */
  std::size_t distancesPerStep{ 12 };
  /** Largest difference between a distance and the local median distance, relative to the median [1]; at least the unit
   * of the digital numbers is allowed. Where one number is missing, the distance is twice as large. */
  double largestRelativeDifference{ 0.4 };
  /** Ratio of the largest to the smallest local step from which digital numbers are companded [1]. Chosen empirically:
   * where a smaller part of a tone curve is visible, the quantization noise differs by less than a fifth. */
  double leastRatioOfSteps{ 1.1 };
  /** Least difference of these steps that rounding does not explain, in units of the effect of rounding on one step
   * [1]. Chosen empirically: both steps are rounded at both ends. */
  double leastDifferenceOfSteps{ 4.0 };
  /** One in this many local steps is ignored at either end of the sorted steps. Chosen empirically. */
  std::size_t oddStepsOneIn{ 20 };
  ///@}

  /** \name Dark frames */
  ///@{
  /** Largest fraction of pixels that may reach a clip level [1]: the first in any case, or the fraction that follows
   * from one clipped sample in a thousand and the number of frames. A clipped sample moves the mean by 0.003 standard
   * deviations. */
  double largestClippedFraction{ 0.01 };
  double leastUnclippedFraction{ 0.999 };
  /** Least number of usable pixels from which an offset is measured. Chosen empirically. */
  std::size_t fewestDarkPixels{ 30 };
  /** Least number of dark frames in each half for a comparison of the mean levels. Chosen empirically: the
   * differences of neighbours in shorter halves do not determine the noise of the levels. */
  std::size_t fewestFramesOfHalf{ 3 };
  /** A pixel that has the same value in all frames is stuck if the probability of this is lower [1]. Chosen
   * empirically: of 10^6 normal pixels one is called stuck. */
  double chanceOfStuck{ 1e-6 };
  /** Least degrees of freedom and number of pixels for the median read noise. Chosen empirically: with fewer frames the
   * deconvolution is biased by more than 1 %. */
  double      leastDofOfMedian{ 5.0 };
  std::size_t fewestPixelsOfMedian{ 100 };
  ///@}

  /** \name Mosaics of colour filters
   * Sums over the blocks of a frame of the differences between the four phases of its 2 x 2 pixels. */
  ///@{
  /** Largest difference of the two greens, relative to the difference of green to the mean of red and blue [1]. Chosen
   * empirically: mosaics stay below 0.1. Frames without a mosaic have two similar diagonals and values near 1. Half
   * and twice change the result of none of the 150 frames of the tests. */
  double largestGreenDifference{ 0.25 };
  /** Least difference of any two colours, in the same unit, and in units of the difference of the greens, which is
   * noise [1]. Below it the two are one colour, as in a fine checkerboard. Chosen empirically: with half of either, a
   * noisy checkerboard of one pixel is taken for a mosaic. Twice the first misses red and blue that differ by a
   * seventh; twice the second misses dim mosaics. */
  double leastColourDifference{ 0.08 };
  double leastColourOverNoise{ 2.0 };
  /** Least difference of green to the mean of red and blue, relative to the difference between pixels and the mean of
   * their four neighbours [1]. Mosaics have 0.3 to 1; patterns of the scene at the borders of the blocks make less
   * than 0.05. Chosen empirically; half and twice as above. */
  double leastMosaicContrast{ 0.12 };
  ///@}

  /** \name Test whether the frames show one scene */
  ///@{
  /** Largest number of cells of a frame along each axis. Chosen empirically: a motion of a few pixels changes 16 x 16
   * cells little. */
  std::size_t thumbnailCells{ 16 };
  /** Fraction of the variance over the cells that the mean frame does not explain, from which the scene changes [1].
   * Chosen empirically: a block that crosses a third of the frame makes 0.06; another axis than time makes 0.33 or
   * more in all scenes tried. */
  double sceneChangeFraction{ 0.15 };
  /** Square root of the unexplained variance, relative to the mean level, from which the scene changes [1]. Chosen
   * empirically: a rolling shutter under illumination that flickers by 5 % makes 5 % of a flat field. */
  double sceneChangeOfTheLevel{ 0.1 };
  ///@}

  /** \name Frames unlike the others
   * Estimator.md, 3.1. */
  ///@{
  /** Largest fraction of frames that may be left out [1]: beyond it, it is not clear which frames are the burst. */
  double largestLeftOutFraction{ 0.2 };
  /** Largest fraction of frames in one group that have about the level of the rest and another noise [1]. Three frames
   * of five differ from two equal groups by more than chance, so that the majority is clear. */
  double largestOtherGroup{ 0.4 };
  /** Fraction of the cells of a frame that are uniform or hold no finite value, from which the frame is no picture with
   * noise [1]. Chosen empirically: half. */
  double largestEmptyFraction{ 0.5 };
  /** Fraction of the cells, with the largest deviations, that the test of a frame ignores [1]: a hot pixel, a cosmic
   * ray, a bird. Chosen empirically. */
  double fewCells{ 0.05 };
  /** A frame is unlike the others if its deviation exceeds the median deviation by this many standard deviations [1].
   * Chosen empirically: a vibration along two axes makes exponentially distributed squares, one in 5 10^12 of them so
   * large. */
  double unlikeZ{ 40.0 };
  /** Least effect of an unlike frame: the variance that it adds to a pixel, relative to the variance of the pixel [1].
   * Chosen for its effect: it changes the gain by a thousandth. */
  double leastUnlikeEffect{ 1e-3 };
  ///@}

  /** \name Changes of the illumination */
  ///@{
  /** Relative standard deviation of the illumination factor from which the illumination changes strongly [1]. The
   * variance of a pixel of 5,000 electrons is then 100 times its shot noise, and does not yield the noise to the 10 %
   * that weights and masks need. Chosen empirically: below, up to a flicker of 10 %, the raw variance serves as well.
   */
  double strongIlluminationChange{ 0.15 };
  /** Relative change of the illumination of a single frame from which the illumination changes strongly [1]. Chosen by
   * its effect: one unlit frame in a burst is a change of 1, and makes most of the raw variance of every pixel, so that
   * the guard band at the clip levels would hold the whole scene. A flicker of 10 % changes no frame of a burst by
   * half. */
  double strongChangeOfOneFrame{ 0.5 };
  /** Ratio of the variance of the level between frames to the noise variance of the pixels, from which the illumination
   * of a scene of one level changes strongly [1]. The illumination factor is not known without an offset. Chosen so
   * that an illumination steady to 1 % makes no strong change at 100,000 electrons. */
  double strongChangeOfFlat{ 10.0 };
  ///@}

  /** \name Linearity from exposures
   * Estimator.md, 3.8. */
  ///@{
  /** Distance from 0 and from the signal at saturation of the signals between which the linearity error is measured,
   * relative to the signal at saturation [1]: EMVA Standard 1288, Release 4.0 Linear, 6.7. */
  double linearityRangeLow{ 0.05 };
  /** Quantile of the signal over the cells that is the brightest signal [1], and least signal of the brightest cells
   * relative to it [1]. Chosen empirically: nearly all cells of a flat field are included. In a scene their signals
   * differ by 6 % rms, which changes the curvature of the mean level by 0.4 %. */
  double brightCellsQuantile{ 0.95 };
  double brightCellsFraction{ 0.8 };
  /** Largest ratio of the signals of the pixels in uniform cells to their centre [1], and least number of cells for a
   * level. Chosen empirically: the signals then differ by 10 % rms at most, which changes the curvature of the mean
   * level by 1 %. Textured scenes have 4 of these cells near their brightest places. */
  double      evenCellsRatio{ 1.25 };
  std::size_t fewestEvenCells{ 4 };
  /** Ratio of successive centres in the search [1]. */
  double evenCellsStep{ 0.95 };
  /** Least signal of the brightest cells without a clipped pixel, relative to the signal of the brightest of all cells,
   * for which the other cells are left out [1]. Chosen empirically: with less, too little of the range is covered. */
  double leastReachOfCells{ 0.5 };
  /** Iterations in which the scatter of the illumination and the weights of its estimate are made consistent. Chosen
   * empirically: the third changes less than 1 %. */
  int roundsOfExposureScatter{ 10 };
  /** Relative standard deviation of a level below which the scatter is taken as zero [1]: 2^-30 leaves room for
   * rounding. */
  double leastExposureScatter{ 1e-9 };
  ///@}
};

SENSORNOISE_CONSTANT MomentsConstants InMoments;

} // namespace sensornoise

#endif
