// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_base_Constants_h
#define sensornoise_base_Constants_h

#include <cstddef>

/** \def SENSORNOISE_CONSTANT
 * Precedes a struct of the numbers of the methods, which is a constant. With SENSORNOISE_VARY_CONSTANTS it is a
 * variable, which a program may change before a measurement, to study what a number does (measure-varied-cases). */
#ifdef SENSORNOISE_VARY_CONSTANTS
#  define SENSORNOISE_CONSTANT inline
#else
#  define SENSORNOISE_CONSTANT inline constexpr
#endif

namespace sensornoise
{

/** Levels of significance, as standard errors of a normal number [1].
 *
 * There is one rule: an effect counts if its size exceeds a separate threshold, and if chance exceeds it in fewer than
 * one burst in a hundred. The number of standard errors for the latter depends on the number of tests per burst. Half
 * and twice: Estimator.md, 3.13. */
struct SignificanceLevels
{
  /** 5 % two-sided: nothing is reported, but a number gets a larger error or another number is preferred. */
  double hint{ 2.0 };
  /** 0.3 %: one test per burst. */
  double oneTest{ 3.0 };
  /** 6e-5: up to some hundred tests per burst, as of lags, series or bins. */
  double severalTests{ 4.0 };
  /** 6e-7: up to 10^4 tests per burst, as of levels, tiles or neighbourhoods. */
  double manyTests{ 5.0 };
  /** 2e-9: a test of every pixel; or of frames, whose noise has longer tails than the normal distribution. */
  double everyPixel{ 6.0 };
};

SENSORNOISE_CONSTANT SignificanceLevels Significance;

/** Positive number in place of 0 in a divisor. Digital numbers may have any unit, also fractions of full scale, so that
 * it is below all squared variances, and its inverse squared is a number. */
inline constexpr double smallestDivisor = 1e-100;

/** Numbers that several components use. Numbers of one component are in its own Constants.h. */
struct CommonConstants
{
  /** Quantile of the mean that represents the darkest level, and distance of the brightest one from 1 [1]. Chosen
   * empirically: 130 of 65536 pixels lie beyond either, so that a single defect is not taken for a level. */
  double darkestQuantile{ 0.002 };

  /** Largest relative error of a number that is reported [1]: with a larger error the number is an order of magnitude.
   * Chosen empirically. The error is relative to the expected size, not to the estimate, so that a number is not
   * reported because it happens to be large. */
  double largestRelativeError{ 0.25 };

  /** Largest signal of a dark level, as a fraction of the signal of the brightest levels [1]. At levels of 20 to 80 % a
   * response with a gamma of 1.3 deviates from a line by 2 %, and gives half the gain. */
  double darkFraction{ 0.1 };

  /** Least difference of the variances without signal, relative to the larger one, that counts [1]. Chosen by the size
   * of the effect: 5 % of the read noise. */
  double leastDarkDifference{ 0.1 };

  /** Fraction of the pixels of a neighbourhood far above the expected variance, from which the whole neighbourhood does
   * not fit [1]. Chosen empirically. */
  double largestOutlierFraction{ 0.15 };

  /** Least fraction of its pixels that a tile or cell needs [1]. Chosen empirically. */
  double leastCoveredFraction{ 0.25 };

  /** Largest number of cells of a frame along either axis: a band of a third of the frame is 8 cells wide. Chosen
   * empirically: with 32 the medians of 32 pixels scatter more, and static cells are lost. With 12 the neighbours of a
   * moving object's region are half of this band. */
  std::size_t mostCells{ 24 };
  /** Least width of such a cell [pixels]. Chosen empirically. */
  std::size_t leastCellWidth{ 8 };
  /** Least number of cells that are compared with a mean frame or by their median. Chosen empirically: two parameters
   * of the mean frame are fitted to them. */
  std::size_t fewestCells{ 9 };

  /** Approximate number of pixels for what all pixels need not decide. It bounds the time. Chosen empirically: with 100
   * frames this number determines a variance to 0.05 %, and the smallest effect that is tested is 0.15 %. Half and
   * twice this number change no gain of 1024 x 1024 pixels by more than 0.05 of its error. */
  std::size_t pixelsOfSample{ 65536 };

  /** Least number of levels for a line through them: one more than its two parameters. */
  std::size_t fewestLevels{ 3 };

  /** Number of times that the pixels or frames that do not fit are excluded and the rest is fitted again. Chosen
   * empirically: the last fit changes the model by less than the weights need, and two are enough for unlike frames of
   * one kind. */
  int roundsOfExclusion{ 5 };
  /** Largest number of times that a line is fitted, each time with the weights or the correction by the line before.
   * Chosen empirically: the third one changes a gain by less than 1e-4 of its error. */
  int roundsOfFit{ 4 };

  /** Lower bound of a line or a prediction where it serves as a variance, as a fraction of the variance of the darkest
   * levels [1]. Chosen empirically: a fit may become negative. */
  double lowestFraction{ 0.2 };

  /** Smallest ratio of a variance to its expectation from the line [1]: a variance is above 0. Chosen empirically. */
  double leastVarianceRatio{ 0.1 };

  /** Noise variance, relative to the square of the quantization step, below which quantization hides the noise [1]: the
   * variance for a noise of half a step. */
  double hiddenVariance{ 0.25 };

  /** Difference of chi-squares, or of Schwarz' criterion, that is very strong evidence (Kass & Raftery 1995, on the
   * scale of 2 ln B) [1]. */
  double strongEvidence{ 10.0 };
};

SENSORNOISE_CONSTANT CommonConstants InCommon;

} // namespace sensornoise

#endif
