// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_refined_Constants_h
#define sensornoise_refined_Constants_h

#include "base/Constant.h"

#include <cstddef>

namespace sensornoise
{

/** The numbers of the room `refined`: errors, and what is told. Estimator.md, 3.8 to 3.10 and 4. */
struct RefinedConstants
{
  /** \name Whether the gain is told */
  ///@{
  /** Part of the usable pixels that a measurement needs [1]. Set by hand. */
  double leastUsedShare{ 0.1 };
  /** Departure of the variance from its line above which the data are not those of a sensor [1]: local gains that
   * differ by 4 % make 0.03 to 0.1 of it, a gamma of 1.3 from 0.13 on. Half: a shoulder of 4 % is refused; twice:
   * the same. */
  double largestNonlinearity{ 0.12 };
  /** Part of the values that may repeat that of the frame before, beyond what noise makes, where frames share noise
   * [1]. Chosen by the size of the effect: the sum over lags of so many is 6 % too large. */
  double largestRepeatedShare{ 0.03 };
  /** Factor by which the sum over lags may change the gain where illumination is left that could not be projected out
   * [1]. Chosen by the size of the effect: of what is more than twice the variance most is not the noise. */
  double largestCorrection{ 2.0 };
  /** Relative change of the gain that illumination which is left may make, over the relative change of the variance
   * that cells show [1]: 2 as the slope of the square of the signal, and as much again for what differs within cells.
   * Chosen on simulated bands of 12 rows, which made 2.5 to 4.7. */
  double slopeOfRest{ 4.0 };
  ///@}

  /** \name Errors of the gain */
  ///@{
  /** Vibration beyond which the expansion in derivatives fails, as a square [pixels^2], and what is then known of the
   * bias, relative to the gain, at the reference's square, with which it grows [1, pixels^2]. Measured by
   * the robustness cases of measure-cases. */
  double smallVibration{ 0.16 };
  double biasOfVibration{ 0.0015 };
  double referenceVibration{ 0.25 };
  /** Scatter of the classes beyond sampling, as a factor of the variance, that chance is given where departures from a
   * line are judged [1]. Set by hand: scenes and sensors that fit have 1 to 4; a tone curve has 50 and hides behind it.
   */
  double largestDispersion{ 4.0 };
  /** Sum of the squared coefficients from which areas are judged once more [1]. Set by hand: below, the scatter of
   * their means grows by less than a twentieth. Half: errors of brighter-fatter sensors are 1.7 times as large;
   * twice: gains of smoothed frames are 0.9 % low, errors twice as large. */
  double leastSharedSquares{ 1.1 };
  /** Pixels around an edge over which its surroundings' level is taken: 5 x 5 pixels, the border of usable pixels. */
  std::size_t edgeMargin{ 2 };
  /** Change of a pixel's variance, along the line, from its own level to that of its surroundings, from which it is an
   * edge [1]. A Gaussian of 1 pixel then misses its variance by a quarter of that. Set by hand: half changes nothing,
   * twice loses 1 % of the read noise of a texture. */
  double largestEdge{ 0.04 };
  ///@}

  /** \name Bends of the response */
  ///@{
  /** Departure of the variance from its line that is worth a word [1]. Set by hand: a hundredth moves the gain by about
   * half of it. */
  double leastNonlinearity{ 0.01 };
  /** What is left of the departure from a line as the error of the mean gain [1]. Set by hand: of three shapes of bend
   * by 2 and 4 % on two scenes the largest error was 0.29 of it; half fails to cover, twice covers all. */
  double errorOfNonlinearity{ 1.0 / 3.0 };
  /** The same of its difference from the slope [1]. Set by hand. */
  double errorOfMeanGain{ 0.5 };
  /** Part of the brightest levels' variance that the line may leave to read noise where the response bends [1]. Above
   * it, what looks like read noise may be the bend of a tone curve. Set by hand: bends of 4 % make 0.05 of it, a gamma
   * of 1.3 0.3. */
  double largestReadShare{ 0.1 };
  /** Part of the brightest levels' light that the darkest may have for a bend to be told from noise [1]. Set by hand:
   * flat fields have 0.9 and more, scenes less than 0.3. */
  double largestDarkestShare{ 0.5 };
  ///@}

  /** Part of the shot noise that the projection on the frames' levels leaves, at least, in the rough gain that corrects
   * for what it takes [1]: a guard against division by 0, where one or two frames alone carry the light. */
  double leastShotLeft{ 0.2 };

  /** \name The photon transfer of the frames */
  ///@{
  /** Least part of a frame's noise that the projection leaves, for its residuals to count [1]: where less is left,
   * rounding and the errors of the model exceed the noise. Chosen on simulated flat fields. */
  double leastLeftShare{ 0.05 };
  /** Part of a tile's mean square below which no frame's expected square is weighed [1]: a guard where a line is
   * negative. Chosen empirically: the dark frames of series of 5,000 electrons have 0.02. */
  double leastWeighedVariance{ 0.01 };
  /** Tiles of the noise sample that are needed: their scatter is the error. */
  std::size_t leastTilesOfTransfer{ 4 };
  /** How often the squares are weighed anew: the third time changes a gain by less than 1e-4 of its error. */
  int roundsOfTransfer{ 4 };
  /** Relative difference of a frame's noise variance from the variance that the line has at its level, from which on
   * the frame is left out [1]. Chosen by the size of the effect: two of 60 frames that differ by it make the gain 0.3 %
   * wrong. */
  double leastUnlikeNoise{ 0.1 };
  /** That difference where the illumination changes in some places in another way than in others, as its change there
   * is not known in every frame [1]. Chosen larger than the local changes of lamps that pulse under a rolling shutter.
   */
  double leastUnlikeUnderLocalLight{ 0.3 };
  /** That difference where the scene moves by more than smallVibration [1]: twice the noise. Chosen empirically: the
   * motion that is left in a frame adds less in the flatter half of a scene. */
  double leastUnlikeUnderMotion{ 1.0 };
  /** How often the groups of frames are found anew with their noise known. Chosen empirically: the third time changes
   * nothing for three frames of four times the noise. */
  int roundsOfFrameNoise{ 3 };
  /** Slopes that are tried on either side, as the noise of a frame need not rise with the slope. Chosen empirically. */
  int stepsOfSlope{ 4 };
  /** Part of the information on the slope that must be left without the fifth of the frames that have most of it [1].
   * Chosen between two cases: it is 0.25 of pulses in every fourth frame, 0.05 of two frames of 1.5 times the level
   * among 60 that flicker by 2 %. */
  double leastShareOfOthers{ 0.1 };
  /** Part of the squares that the levels make, rms, by which frames must differ to have several levels [1]. */
  double leastFrameContrast{ 1e-4 };
  ///@}

  /** \name Offset, read noise, flicker and motion */
  ///@{
  /** Part of the levels' range by which an offset may lie beyond its limits, beside chance [1]. Set by hand. */
  double slackOfRange{ 0.01 };
  /** Dispersion of the lines of local light about one zero that is worth a number [1]. Set by hand. */
  double largestLocalDispersion{ 4.0 };
  /** Part of what two ways to measure motion differ by that is its systematic error [1]. Chosen on simulated scenes:
   * the motion of pages of sharp text is off by a fifth of it, of others by less than a tenth. */
  double errorOfMotion{ 0.2 };
  /** Part of the motion along one axis, at most, that looks like motion along the other one, where the scene has one
   * direction and no motion along the first is seen [1]. Chosen: equal motion along both adds 0.5 % to it. */
  double largestShareOfOtherAxis{ 0.1 };
  ///@}

  /** \name Signal in the dark frames */
  ///@{
  /** Contrast of a tile, rms, below which the fixed pattern of the pixels may be what it has [1]: the response of the
   * pixels of cameras differs by 0.3 to 2 % rms (EMVA 1288 reports). */
  double leastContrastOfTile{ 0.03 };
  /** Fraction of the signal of the frames in the dark frames, from which on it counts [1]. Chosen by the size of the
   * effect: it moves the offset by that fraction of the mean signal. */
  double leastSignalOfDark{ 0.01 };
  ///@}

  /** \name The illumination of rows */
  ///@{
  /** Part of the slope of the variance that the illumination of rows or columns may add for it not to be taken off, and
   * for a gain to be given where it could not be [1]. Chosen by the size of the effect: the former is the standard
   * error of the gain of 60 frames of 200 x 240 pixels. */
  double leastLineLight{ 0.002 };
  double largestLineLight{ 0.01 };
  ///@}

  /** \name What is worth a warning */
  ///@{
  /** Share of the pixels that move, or that clipping could touch [1], and of those that are trimmed [1]. Set by hand.
   */
  double reportedShare{ 0.01 };
  double reportedTrimmed{ 2e-3 };
  /** Motion from which the scene is to be registered [pixels rms]. Set by hand: biasOfVibration begins there. */
  double strongVibration{ 0.4 };
  ///@}
};

SENSORNOISE_CONSTANT RefinedConstants InRefined;

} // namespace sensornoise

#endif
