// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_pixels_Constants_h
#define sensornoise_pixels_Constants_h

#include "base/Constant.h"

#include <cstddef>

namespace sensornoise
{

/** The numbers of the room `pixels`: which pixels fit, and the line through them. Estimator.md, 3.5 to 3.8. */
struct PixelsConstants
{
  /** \name Roughness */
  ///@{
  /** Standard deviation of the motion below which roughness is that of a radius of 2 pixels [pixels]; above, the radius
   * is larger by so many standard deviations, of a motion of at most so many pixels. Set by hand. */
  double smallMotion{ 0.35 };
  double motionSds{ 3.0 };
  double largestMotion{ 4.0 };
  /** Part of a pixel's freedom that the motion's series may take, at most [1]. Set by hand. */
  double largestLeverage{ 0.5 };
  /** Part of the degrees of freedom that a change of the illumination must take to be allowed for [1]. Set by hand:
   * below, standard errors are at most half of it too small. A flicker of 10 % rms takes so much. */
  double leastLossOfFreedom{ 0.01 };
  /** Share of the classes, the flat ones, that draw the first line [1]. Set by hand. */
  double flatShare{ 0.6 };
  ///@}

  /** \name Single pixels, neighbourhoods and classes that do not fit */
  ///@{
  /** Half width of a neighbourhood [pixels]. Set by hand: 225 variances of 100 frames have a mean to 1 %. */
  std::size_t misfitRadius{ 7 };
  /** Excess over the line by which a neighbourhood's mean variance does not fit [1], and the share of its pixels that
   * it needs [1]. Set by hand. */
  double leastMisfit{ 0.04 };
  double leastCountedShare{ 0.3 };
  /** Share of the frame's pixels that do not fit, below which the line that they took part in stands [1]. Set by hand:
   * so few have not drawn it. */
  double fewMisfits{ 1e-3 };
  /** Excess over the flat classes by which a class of roughness does not fit [1]; or its outliers beyond theirs, of its
   * pixels [1]. Set by hand. */
  double leastClassExcess{ 0.0015 };
  double leastClassOutliers{ 0.01 };
  /** The flattest class that may be left out. Set by hand: those below are the reference. */
  std::size_t firstJudgedClass{ 4 };
  ///@}

  /** \name The first line */
  ///@{
  /** Bins of the square root of the signal, and the pixels that one must have to count. Chosen empirically: an
   * extrapolation by a factor of 2 or more is seen, and a median of 50 variances is known to 4 %. */
  std::size_t levelBins{ 16 };
  std::size_t leastPixelsOfLevel{ 50 };
  /** Fraction of the bright pixels that must be near a line through dark and bright ones [1]. Chosen empirically: edges
   * move in most scenes. */
  double leastNearLine{ 0.75 };
  ///@}

  /** \name The judging line */
  ///@{
  /** Side of a square [pixels]: enough for a mean to 2 %, few enough to be of one level; and its pixels that must
   * count. Set by hand. */
  static constexpr std::size_t judgingSquareSide{ 16 }; // the size of arrays
  double                       leastSquarePixels{ 64.0 };
  /** Squares that are enough: of twice as many or more every second counts, and so on. Set by hand: the medians of 16
   * levels are known to 0.2 %. Half and twice move no gain of 1024 x 1024 pixels by 0.05 of its error. */
  std::size_t enoughJudgingSquares{ 1024 };
  /** Levels at most, and squares of each at least. Set by hand. */
  std::size_t mostJudgingLevels{ 16 };
  std::size_t squaresPerLevel{ 8 };
  /** Departure from the line, beside chance, that counts [1]. Set by hand: neighbourhoods are
   * blamed from 4 % on; half of it is within the noise of frames of 128 x 128 pixels. */
  double leastDeparture{ 0.01 };
  /** One in so many squares, the darkest, tells the scatter of the pixels' own noise. Set by hand. */
  std::size_t darkSquaresOneIn{ 5 };
  /** Variance of what the pixels' own offsets do to the line, relative to its square at the darkest level, up to which
   * pixels are judged at their own level [1]. Set by hand: at the limit a ratio of variances is off by 2 %. */
  double largestOwnOffset{ 0.02 };
  ///@}

  /** \name The variance line */
  ///@{
  /** Probability of each tail of chi-square that is trimmed where pixels are judged [1]. Set by hand. */
  double trimTail{ 1e-4 };
  /** Where the line serves as a variance it is cut at this part of the smallest median of a bin [1]. Set by hand. */
  double lowestShare{ 0.2 };
  /** Pixels of a bin of the first line, and of a fit, at least. Set by hand. */
  double      fewestPixelsOfBin{ 5.0 };
  std::size_t fewestPixelsOfFit{ 10 };
  /** Pixels, or up to twice as many, that draw a line by which pixels are judged, or from which a fit of all pixels
   * starts. Set by hand: those of 100 frames know a variance to 0.05 %, the smallest effect that is judged is 0.15 %.
   * Half and twice move no gain of 1024 x 1024 pixels by 0.05 of its error. */
  std::size_t pixelsOfRoughLine{ 65536 };
  /** Steps from there to the line of all pixels (estimator.md, 3.6). One: 0.2 errors of the gain with 1 % noisy pixels,
   * elsewhere 1e-4; four: 5e-5. */
  int stepsFromRoughLine{ 2 };
  /** Derivative of the fitted gain to the gain by which the variances were corrected, up to which that gain need not
   * be settled [1]: its error is then at most 1 % too small. Set by hand. */
  double leastFeedback{ 0.01 };
  /** The derivative above which the frames do not determine a gain [1]: nine tenths of it were put in, and what is
   * wrong with the rest counts ten times. Set by hand. */
  double largestFeedback{ 0.9 };
  /** Part of the illumination that frames carry together which are named as the cause [1]. Set by hand. */
  double shareOfFewFrames{ 0.9 };
  /** Times that a line is drawn and its gain settled, at most, and the relative change of the gain that ends it [1].
   * Set by hand: the solution is exact but for weights and outliers, which change once or twice. */
  int    settlingRounds{ 4 };
  double settledChange{ 1e-4 };
  /** Determinant of a line's equations, relative to its diagonal, up to which the levels are one [1]: rounding. */
  double leastDeterminant{ 1e-12 };
  /** Probability that chance carries a pixel of the brightest level beyond the reach of TrimRule::Distance [1]. Set by
   * hand, small enough to leave the mean alone: a tenth and ten times of it move no gain by 0.01 %. */
  double reachTail{ 1e-5 };
  /** Variance of the pixels' own noise, in units of what the sampling noise makes of it at the darkest level, below
   * which the weights leave it out [1]. Set by hand: at the limit equal weights cost 0.3 % of the precision. */
  double leastNoiseSpread{ 0.1 };
  /** Error that a pattern may cause, in standard errors, which is left out [1]. Set by hand: it adds 3 % to the error.
   */
  double negligiblePattern{ 0.25 };
  ///@}

  /** \name Noise of companded codes */
  ///@{
  /** What is not known of the noise of rounding, relative to it [1]. Set by hand: of square roots, powers and
   * logarithms to 8 and 10 bits, at four gains, a scene of few levels left 0 to 6 % of it in the slope where the codes
   * are as coarse as the noise; a texture less. */
  double errorOfCodeNoise{ 0.05 };
  /** What rounding the expanded codes to their unit does to the variance at one level, which the codes at that level
   * stretch or squeeze by chance: relative to the unit times the root of noise and step [1]. Set by hand, on charts
   * whose darkest patch has one level. */
  double errorOfRounding{ 0.15 };
  ///@}
};

SENSORNOISE_CONSTANT PixelsConstants InPixels;

/** The numbers of the room `pixels` by which pixels' own patterns and local light are told. Estimator.md, 3.7. */
struct PatternConstants
{
  /** Side of a square [pixels], in small frames, and the pixels of a frame that is not small: many columns tell their
   * pattern, but a small frame may have no large square that is flat. Set by hand: with 8 in large frames those squares
   * are the flattest whose few columns are alike by chance. */
  static constexpr std::size_t squareSide{ 16 }; // the size of arrays
  std::size_t                  smallSquareSide{ 8 };
  std::size_t                  largeFramePixels{ 16384 };
  /** Pixels of either half of a square that counts. Set by hand. */
  double leastHalfPixels{ 24.0 };
  /** Share of the squares that count as the flattest [1], and their least number. Set by hand: with half and twice the
   * share the shares of natural scenes change by a third. */
  double      flattestShare{ 0.05 };
  std::size_t fewestSquares{ 4 };
  /** Standard deviations of patterns of real sensors, at most: of gain or efficiency [1], and of offset, in units of
   * the noise at the level of the flattest squares [1]. What is larger, in a scene that is rough everywhere, is light.
   * Set by hand, three times and twice what data sheets and measured sensors have. */
  double largestGain{ 0.03 };
  double largestOffset{ 5.0 };
  /** Variance of the slope by whole columns or rows, relative to that by pixels, that is more than chance [1]. Set by
   * hand: 256 columns scatter by 0.1. */
  double leastLikeness{ 1.5 };

  /** Pixels of a tile that tells a line of responses to local light, and, for an offset, what its levels must differ by
   * in units of the noise of their means, as variances [1]. Set by hand. */
  double leastLeakPixels{ 20.0 };
  double leastTilePixels{ 12.0 };
  double leastTileContrast{ 30.0 };
  /** Side of a tile [pixels], chi-square by which tiles may depart from one line, relative to their number [1], and
   * what that line must explain in units of that chi-square [1], for local light to be a drift of the offset. Set by
   * hand. */
  std::size_t driftTileSide{ 32 };
  double      largestDriftChi2{ 4.0 };
  double      leastDriftExplained{ 10.0 };
};

SENSORNOISE_CONSTANT PatternConstants InPattern;

/** The numbers of the room `pixels` by which the gains of the parts of a frame are compared. Estimator.md, 3.15. */
struct PartsConstants
{
  /** Tiles along an axis, at most, and larger tiles whose 16 phases are compared. Chosen empirically: the regressions
   * then take a few per cent of the time of a burst. */
  std::size_t mostTiles{ 32 };
  std::size_t mostPhaseTiles{ 8 };
  /** Tiles that a comparison needs. Chosen empirically. */
  std::size_t fewestTiles{ 24 };
  /** Variance of a pixel over the line from which on it is left out of the sums [1]: defective, or something moves.
   * Chosen above what twice the gain and chance together make of 10 frames. */
  double largestRatio{ 6.0 };
  /** Difference of the gains, rms over the pixels, from which on it counts [1]. Chosen by the size of the effect:
   * below, the gain of no half is off by more than its error in bursts of 100 frames. */
  double leastDifference{ 0.0075 };
  /** The same from which on the rejection of pixels allows for it [1]: neighbourhoods are rejected from 4 % on. */
  double largeDifference{ 0.0125 };
  /** Scatter of the tiles within parts over that of sampling, up to which parts are uniform in themselves [1]: where
   * something moves it is 10 and more. Chosen empirically. */
  double largestScatter{ 3.0 };
  /** What is known of the coefficients beforehand, as standard deviations [1]: gains are alike within a factor of 2,
   * the variances without signal (read noise, offset) within 30 %, a curve departs from its line by a few per cent. */
  double priorOfGain{ 1.0 };
  double priorOfDark{ 0.3 };
  double priorOfCurve{ 0.05 };
  /** Knots of the curve, and rounds of the regression, half of them by absolute deviations. */
  std::size_t knots{ 6 };
  int         rounds{ 12 };
  /** Levels at which a step is tried, or a curve has its knots. Chosen for the time. */
  std::size_t levelsOfStep{ 32 };
  /** Tukey's constant, which has 95 % of the efficiency of least squares (Beaton & Tukey 1974) [1]. */
  double tukey{ 4.685 };
};

SENSORNOISE_CONSTANT PartsConstants InParts;

/** The numbers of the room `pixels` by which a step of the variance is found. Estimator.md, 3.16. */
struct StepConstants
{
  /** Reduced chi-square of the variance about its line from which on a step is looked for [1]: a step of five
   * standard errors adds as much to that of 64 bins. */
  double leastChi2{ 1.25 };
  /** Size of a step, relative to the larger variance beside it, from which on it counts [1]. Chosen by the size of the
   * effect: in the middle of the levels a step of so much moves the gain by 1 to 2 %. */
  double leastSize{ 0.03 };
  /** Part of its size that a step must keep beside a parabola [1]: of a bend nothing is left. Chosen empirically. */
  double leastBesideCurve{ 0.5 };
  /** Bins on either side of a step, at least. Chosen empirically: a line of fewer is not known. */
  std::size_t leastBins{ 4 };
  /** Standard deviations of the noise about the step, at which a pixel is of either amplifier in some frames, and does
   * not count [1]. Beyond, fewer than 5 % of its values are of the other one. */
  double widthSds{ 2.0 };
  /** What is known beforehand of the gains of two amplifiers, after the camera has matched them, as the standard
   * deviation of either from the common one [1]. From public reports on dual-gain sensors, whose branches differ by 0.5
   * to 2 % in level. */
  double priorOfGains{ 0.01 };
};

SENSORNOISE_CONSTANT StepConstants InSteps;

} // namespace sensornoise

#endif
