// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_moments_Constants_h
#define sensornoise_moments_Constants_h

#include "base/Constant.h"

#include <cstddef>
#include <cstdint>

namespace sensornoise
{

/** The numbers of the room `moments`. */
struct MomentsConstants
{
  /** A pixel is defective if its read noise is more than this many times that of a typical pixel [1]. Set by hand: 4
   * cuts 9 % of the rms of an sCMOS sensor (log-normal, spread 0.4, a tail of 10 %), 8 cuts 3 %, 16 less than 1 % but
   * keeps pixels of ten times the noise, of which a hundredth is more than all others. Where 1 % of the pixels are
   * such, half: error of the gain 1.1 times as large, twice: 12 times. */
  double defectiveNoiseFactor{ 8.0 };

  /** \name Pile-ups */
  ///@{
  /** How many levels inside of the outermost one it is compared with. Set by hand. */
  int levelsInsidePileUp{ 16 };
  /** Fewer pixels on one level are no pile-up. Set by hand. */
  std::size_t fewestPixelsOfPileUp{ 8 };
  /** Times as many pixels as on any level inside that a pile-up has more than [1]. Set by hand: noise alone has fewer.
   */
  std::size_t pileUpRatio{ 3 };
  /** Depth of the extremes, see ExtremeDepths, from which they are rare noise and no clip level [standard deviations].
   * Set by hand. */
  double largestPileUpDepth{ 2.5 };
  /** Stray pixels beyond a pile-up, as stuck or hot ones, relative to its own pixels, at most [1]. Chosen: a sensor
   * whose pixels pass a level more often than that does not clip there. */
  double largestStrayShare{ 0.1 };
  /** Levels next to a pile-up on its outer side that no pixel attains, where pixels farther out are stray. Chosen: the
   * tail of a noise has no such gap. */
  int levelsOutsidePileUp{ 4 };
  ///@}

  /** \name Counts from 0 */
  ///@{
  /** Pixels, about, that tell whether values are counts. They bound the time. */
  std::size_t pixelsOfCounts{ 65536 };
  /** Means between which the ratio of variance and mean is looked at [counts]: below, rare events carry it; above, a
   * flicker of 3 % adds 2 % to the variance. */
  double leastCount{ 0.25 };
  double largestCount{ 30.0 };
  /** Standard error of that ratio for a group of pixels to count, and difference of the ratios, of counts at most,
   * relative to them [1]. Chosen: read noise of 0.3 steps changes it by a tenth. */
  double errorOfCountRatio{ 0.02 };
  double largestCountRatio{ 0.05 };
  ///@}

  /** \name Steps of the codes */
  ///@{
  /** Codes off the grid of the step, relative to all and beside that, up to which codes are regular [1, codes]. Set by
   * hand. */
  double largestOffGridShare{ 0.02 };
  double offGridCodes{ 2.0 };
  /** Levels of floating-point data that a grid must hold: by chance one in 10^21 does. */
  std::size_t fewestLevelsOfGrid{ 32 };
  /** Distance of a level from the grid, in steps, at most [1], which allows for the rounding of scaled codes. */
  double largestOffGrid{ 0.1 };
  /** Step of the grid, in units of the last digit of the largest level, at least [1]: below, levels hardly lie off it.
   */
  double leastStepInDigits{ 16.0 };
  /** Quantile of the spacings of the outermost levels that is their step [1]. Set by hand: some levels are missing. */
  double stepQuantile{ 0.1 };
  /** Pixels that each of two neighbouring codes needs to tell their distance: where codes have 8 pixels, one between
   * them has none by a chance of e^-8. */
  std::uint32_t leastPixelsOfCode{ 8 };
  /** Distances that a local step is the mean of, at least: rounding moves each by up to 1 DN, their sum by no more. */
  std::size_t distancesPerStep{ 12 };
  /** By how much a distance may differ from the median one about it, relative to that, and at least by the codes' unit
   * [1]: where one code between is missing, it is twice as large. */
  double largestRelativeDifference{ 0.4 };
  /** Ratio of the largest local step to the smallest from which on codes are called companded [1]. Set by hand: where
   * less of a tone curve is seen, the noise of rounding differs by less than a fifth. */
  double leastRatioOfSteps{ 1.1 };
  /** Difference of these steps that rounding does not make, in units of what it makes of one [1]. Set by hand: both
   * steps are rounded at both ends. */
  double leastDifferenceOfSteps{ 4.0 };
  /** One in so many local steps, the largest and the smallest, may be anything. Set by hand. */
  std::size_t oddStepsOneIn{ 20 };
  ///@}

  /** \name Dark frames */
  ///@{
  /** Pixels that may reach a clip level, relative to all: so many in any case, or where no more than one sample in a
   * thousand is cut off, by the number of frames [1]. Cutting off that sample moves the mean by 0.003 sigma. */
  double largestClippedShare{ 0.01 };
  double leastShareOfSamples{ 0.999 };
  /** Pixels that tell a level. Set by hand. */
  std::size_t fewestDarkPixels{ 30 };
  /** Chance of one code in all frames below which a pixel that holds one is stuck [1]. Set by hand: of 10^6 pixels one
   * does by chance. */
  double chanceOfStuck{ 1e-6 };
  /** Distance of a pixel from the median beyond which it is left out of the common level, in units of the distance of
   * the quantiles 0.16 and 0.84, two standard deviations [1]. Set by hand. */
  double levelReach{ 3.0 };
  /** Degrees of freedom and pixels that the median read noise needs. Set by hand: with fewer frames the deconvolution
   * is biased by more than a per cent. */
  double      leastFreedomOfMedian{ 5.0 };
  std::size_t fewestPixelsOfMedian{ 100 };
  ///@}

  /** \name Mosaics of colour filters
   * Sums over the blocks of a frame of the differences between the four phases of its 2 x 2 pixels. */
  ///@{
  /** Largest difference of the two greens, in units of that of green to the mean of red and blue [1]. Set by hand: a
   * mosaic has less than 0.1, what is no mosaic has two alike diagonals, near 1; half and twice change none of the
   * 150 frames of the tests. */
  double largestGreenDifference{ 0.25 };
  /** Least difference of any two colours, in the same units, and in units of that of the greens, which is noise [1]:
   * below it the two are one, as in a fine checkerboard. Set by hand: half of either takes a noisy checkerboard of one
   * pixel for a mosaic, twice the first misses red and blue that differ by a seventh, twice the second dim mosaics. */
  double leastColourDifference{ 0.08 };
  double leastColourOverNoise{ 2.0 };
  /** Least difference of green to the mean of red and blue, relative to how far pixels are from the mean of their four
   * neighbours [1]: a mosaic has 0.3 to 1, what patterns of the scene leave at the borders of the blocks is below 0.05.
   * Set by hand; half and twice as above. */
  double leastMosaicContrast{ 0.12 };
  ///@}

  /** \name Whether the frames show one scene */
  ///@{
  /** Cells of a frame along each axis, at most. Set by hand: of 16 x 16 cells a motion of a few pixels changes little.
   */
  std::size_t thumbnailCells{ 16 };
  /** Cells that tell. Set by hand: two numbers of the mean frame's are fitted to them. */
  std::size_t fewestThumbnailCells{ 9 };
  /** Variance over the cells that is not as in the mean frame, relative to all of it, from which on the scene changes
   * [1]. Set by hand: a block that crosses a third of the frame makes 0.06, another axis than time 0.33 and more of
   * all scenes tried. */
  double sceneChangeShare{ 0.15 };
  /** The root of that variance over the mean level from which on the scene changes [1]. Set by hand: a rolling shutter
   * under a lamp that flickers by 5 % makes 5 % of a flat field. */
  double sceneChangeOfTheLevel{ 0.1 };
  ///@}

  /** \name Frames unlike the others
   * Estimator.md, 3.1. */
  ///@{
  /** Frames that may be left out, relative to all [1]: of more it is not clear which are the burst. */
  double largestLeftOutShare{ 0.2 };
  /** The same of frames of about one level whose noise is another than that of the rest, which is one group [1]: three
   * frames of five are more than chance makes of two equal groups, and it is clear which are the burst. */
  double largestOtherGroup{ 0.4 };
  /** Share of a frame's cells that are even, or hold nothing finite, from which on it is no picture with noise [1]. Set
   * by hand: half. */
  double largestEmptyShare{ 0.5 };
  /** Share of the cells, those that differ most, by which a frame is not judged [1]: a hot pixel, a ray, a bird. Set by
   * hand. */
  double fewCells{ 0.05 };
  /** Standard deviations of the frames' misfits by which that of an unlike frame exceeds their median [1]. Chosen
   * empirically: a vibration along two axes makes squares that are distributed exponentially, of which one in 5 10^12
   * is so far. */
  double unlikeZ{ 40.0 };
  /** Mean square of what a frame is not as the others from which on it matters: what such a frame adds to the variance
   * of a pixel, relative to that variance [1]. Chosen for its effect: a gain that is wrong by a thousandth. */
  double leastUnlikeEffect{ 1e-3 };
  /** How often the mean is made again of the frames that are most like it. Set by hand: two are enough where the unlike
   * ones are of one kind. */
  int roundsOfUnlikeFrames{ 5 };
  ///@}

  /** \name Changes of the illumination */
  ///@{
  /** Relative standard deviation of the illumination factor from which on it changes strongly [1]: the variance of a
   * pixel of 5,000 electrons is then 100 times its shot noise, and the noise is no longer told from it to the 10 % that
   * weights and masks need. Chosen empirically: below, up to a flicker of 10 %, the raw variance serves as well. */
  double strongIlluminationChange{ 0.15 };
  /** Variance of the level from frame to frame over the variance of the pixels' noise from which on the illumination of
   * a scene of one level changes strongly [1]; its factor is not known without an offset. Chosen so that a lamp that is
   * steady to 1 % makes no strong change at 100,000 electrons. */
  double strongChangeOfFlat{ 10.0 };
  /** Standard error of a frame's slope, in units of that change, below which the cells have contrast [1]. Chosen so
   * that noise makes no strong change: it is three standard errors. */
  double largestSlopeError{ 1.0 / 3.0 };
  ///@}

  /** \name Linearity from exposures
   * Estimator.md, 3.8. */
  ///@{
  /** Signals between which the linearity error is measured, relative to the signal at saturation [1]: EMVA Standard
   * 1288, Release 4.0 Linear, 6.7. */
  double linearityRangeLow{ 0.05 };
  double linearityRangeHigh{ 0.95 };
  /** Levels in that range that the linearity error needs: one more than the two parameters of a line. */
  std::size_t fewestExposureLevels{ 3 };
  /** Quantile over the cells of the signal that the brightest cells have [1], and the signal relative to it from which
   * on a cell is one of them [1]. Chosen empirically: these are nearly all cells of a flat field. In a scene their
   * signals differ by 6 % rms, which changes the curvature of the mean level by 0.4 %. */
  double brightCellsQuantile{ 0.95 };
  double brightCellsShare{ 0.8 };
  /** Ratio up to which the signals of the pixels of even cells differ from their centre [1], and cells that a level
   * needs. Chosen empirically: the signals then differ by 10 % rms at most, which changes the curvature of the mean
   * level by 1 %. Textured scenes have 4 such cells near their brightest places. */
  double      evenCellsRatio{ 1.25 };
  std::size_t fewestEvenCells{ 4 };
  /** Ratio of the centres that are tried one after the other [1]. */
  double evenCellsStep{ 0.95 };
  /** Signal of the brightest cells without a clipped pixel, relative to the signal of the brightest of all cells, from
   * which on the other cells are left out [1]. Chosen empirically: with less, too little of the range is covered. */
  double leastReachOfCells{ 0.5 };
  /** Rounds in which the scatter of the illumination and the weights of its estimate are made to agree. Chosen
   * empirically: the third changes less than a per cent. */
  int roundsOfExposureScatter{ 10 };
  /** Relative standard deviation of a level below which no scatter is believed [1]: 2^-30 leaves room for rounding. */
  double leastExposureScatter{ 1e-9 };
  ///@}
};

SENSORNOISE_CONSTANT MomentsConstants InMoments;

} // namespace sensornoise

#endif
