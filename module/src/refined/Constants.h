// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_refined_Constants_h
#define sensornoise_refined_Constants_h

#include "base/Constants.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace sensornoise
{

/** Constants of the component `refined`: errors, and conditions for an estimate to be identifiable. Estimator.md, 3.8
 * to 3.10 and 4. */
struct RefinedConstants
{
  /** \name Conditions for the gain to be identifiable */
  ///@{
  /** Smallest fraction of the usable pixels that must be used [1]. Chosen empirically. */
  double leastUsedFraction{ 0.1 };
  /** Deviation of the variance from its line above which the data are not from a sensor [1]: local gains that differ by
   * 4 % make 0.03 to 0.1, a gamma of 1.3 makes 0.13 or more. With half the value, a shoulder of 4 % is rejected; twice
   * the value changes nothing in the cases of estimator.md, 3.13. */
  double largestNonlinearity{ 0.12 };
  /** Largest fraction of values that repeat the value in the frame before, beyond the number that noise explains, where
   * the noise is correlated, and of lines that are copies of the line before [1]. Chosen by its effect: with it, the
   * total covariance over lags is 1 % too large. */
  double largestRepeatedFraction{ 0.005 };
  /** Largest factor by which the total covariance over lags may change the gain where illumination changes could not be
   * projected out [1]. Chosen by its effect: beyond twice the variance, most of the covariance is not noise. */
  double largestCorrection{ 2.0 };
  /** Largest relative change of the gain by remaining illumination changes, over the relative change of the variance
   * that tiles show [1]. The slope of the squared signal contributes 2, differences within tiles as much again. Chosen
   * on simulated bands of 12 rows, which made 2.5 to 4.7. */
  double slopeOfRemaining{ 4.0 };
  ///@}

  /** \name Errors of the gain */
  ///@{
  /** Vibration above which the expansion in derivatives fails [pixels rms].
   * The bias of the gain is then proportional to the squared vibration: \a biasOfVibration of the gain [1/pixels^2].
   * Measured by the robustness cases of measure-cases. */
  double strongVibration{ 0.4 };
  double biasOfVibration{ 0.006 };
  /** Largest factor by which the scatter between classes widens the variance in tests for deviations from a line [1].
   * Chosen empirically: scenes and sensors that fit have 1 to 4; a tone curve has 50, which would hide it. */
  double largestDispersion{ 4.0 };
  /** Variance inflation by noise correlation above which pixels are tested a second time [1]. Chosen empirically: below
   * it, the scatter of the means of tiles grows by less than a twentieth. With half the value, errors of
   * brighter-fatter sensors are 1.7 times as large. With twice the value, gains of smoothed frames are 0.9 % low, and
   * errors twice as large. */
  double leastVarianceInflation{ 1.1 };
  /** Relative change of the variance by the line, from a pixel's own level to the mean level of 5 x 5 pixels, above
   * which the pixel lies on an edge [1]. After smoothing by a Gaussian of 1 pixel, a quarter of this is missing from
   * its variance. Chosen empirically: half the value changes nothing; with twice the value, the read noise of a
   * texture is 1 % low. */
  double largestEdge{ 0.04 };
  ///@}

  /** \name Non-linear response */
  ///@{
  /** Error of the mean gain, relative to the gain, over the deviation from a line [1]. Chosen empirically: for three
   * shapes of non-linearity of 2 and 4 % on two scenes, the largest error was 0.29. Half the value is too small an
   * error; twice the value contains all cases. */
  double errorOfNonlinearity{ 1.0 / 3.0 };
  /** Error of the mean gain over its difference from the slope [1]. Chosen empirically. */
  double errorOfMeanGain{ 0.5 };
  /** Largest fraction of the brightest levels' variance that the line may attribute to read noise where the response is
   * non-linear [1]. Above it, the apparent read noise may be caused by a tone curve. Chosen empirically:
   * non-linearities of 4 % make 0.05, a gamma of 1.3 makes 0.3. */
  double largestReadFraction{ 0.1 };
  /** Largest signal of the darkest levels, relative to the brightest, for which a non-linear response is
   * distinguishable from noise [1]. Chosen empirically: flat fields have 0.9 and more, scenes less than 0.3. */
  double largestDarkestFraction{ 0.5 };
  ///@}

  /** Smallest fraction of the shot noise that the projection on the frames' levels is assumed to leave, in the
   * approximate gain that corrects for the projection [1]. It guards against division by 0, where one or two frames
   * alone are illuminated. */
  double leastShotLeft{ 0.2 };

  /** \name The photon transfer of the frames */
  ///@{
  /** Smallest fraction of a frame's noise that the projection must leave, for its residuals to count [1]. Where less
   * remains, rounding and the errors of the model exceed the noise. Chosen on simulated flat fields. */
  double leastRemainingFraction{ 0.05 };
  /** Smallest expected square of a frame's residuals for the weights, relative to the tile's mean square [1]: a guard
   * where a line is negative. Frames with less have too little light to be compared with others. Chosen empirically:
   * the dark frames of series of 5,000 electrons have 0.02. */
  double leastWeighedVariance{ 0.01 };
  /** Relative difference of a frame's noise variance from the line at its level above which the frame is left out [1].
   * Chosen by its effect: two of 60 frames that differ by it make the gain 0.3 % wrong. */
  double leastUnlikeNoise{ 0.1 };
  /** Limit of the difference under local changes of the illumination, which are not known in every frame and tile [1].
   * Chosen larger than the local changes by pulsed illumination under a rolling shutter. */
  double leastUnlikeUnderLocalIllumination{ 0.3 };
  /** Limit of the difference where the scene moves by more than strongVibration [1]: twice the noise. Chosen
   * empirically: the remaining motion of a frame adds less in the flatter half of a scene. */
  double leastUnlikeUnderMotion{ 1.0 };
  /** Number of iterations that find the groups of frames with their noise from the iteration before. Chosen
   * empirically: the third one changes nothing for three frames of four times the noise. */
  int roundsOfFrameNoise{ 3 };
  /** Number of slopes that are tried on either side, as the noise of a frame need not increase with the slope. Chosen
   * empirically. */
  int stepsOfSlope{ 4 };
  /** Smallest fraction of the information on the slope that must remain without the fifth of the frames that contribute
   * most [1]. Chosen between two cases: it is 0.25 for pulses in every fourth frame, and 0.05 for two frames of 1.5
   * times the level among 60 frames that flicker by 2 %. */
  double leastInformationWithoutLargest{ 0.1 };
  /** Smallest rms difference between frames for them to have several levels, as a fraction of the expected squares by
   * the levels [1]. */
  double leastFrameContrast{ 1e-4 };
  ///@}

  /** \name Offset, read noise, flicker and motion */
  ///@{
  /** Largest distance of an offset beyond its bounds, as a fraction of the range of levels, besides statistical error
   * [1]. Chosen empirically. */
  double slackOfRange{ 0.01 };
  /** Fraction of the difference between two estimates of motion that is taken as its systematic error [1]. Chosen on
   * simulated scenes: the motion of pages of sharp text is wrong by a fifth of it, the motion of other scenes by less
   * than a tenth. */
  double errorOfMotion{ 0.2 };
  /** Fraction of the error of least squares by edges sharper than a pixel, see ScaleErrorsOf(), that is left in the
   * motion by instruments [1]. Chosen on simulated mosaics: the motion of charts is wrong by half of it, the motion
   * of textures by less than a tenth. */
  double errorOfSharpEdges{ 0.5 };
  /** Largest fraction of the motion along one axis that may appear as motion along the other axis [1]. It applies where
   * the scene has one direction, and no motion along the first axis is detected. Chosen by its effect: equal motion
   * along both axes adds 0.5 %. */
  double largestFractionOfOtherAxis{ 0.1 };
  ///@}

  /** \name Signal in the dark frames */
  ///@{
  /** Smallest fraction of the frames' signal in the dark frames that counts [1]. Chosen by its effect: the offset
   * changes by that fraction of the mean signal. */
  double leastSignalOfDark{ 0.01 };
  /** Quantile of the levels of the tiles of dark frames that represents the level without charge [1]. Chosen
   * empirically. */
  double darkestTiles{ 0.05 };
  /** Largest slope of the variance of dark frames over their level that is charge, relative to the gain, whose slope it
   * is [1]. Chosen empirically: amplifiers of unlike offset and read noise make any slope. */
  double mostSlopeOfCharge{ 1.5 };
  ///@}

  /** \name The illumination of rows */
  ///@{
  /** Relative increase of the slope of the variance by the illumination of rows or columns above which it is
   * subtracted, and above which no gain is given if it remains [1]. Chosen by its effect: the former is the standard
   * error of the gain of 60 frames of 200 x 240 pixels. */
  double leastLineIllumination{ 0.002 };
  double largestLineIllumination{ 0.01 };
  ///@}

  /** \name Reporting thresholds */
  ///@{
  /** Fraction of the pixels that move, or that may be affected by clipping [1], and of the trimmed pixels [1]. Chosen
   * empirically. */
  double reportedFraction{ 0.01 };
  double reportedTrimmed{ 2e-3 };
  ///@}
};

SENSORNOISE_CONSTANT RefinedConstants InRefined;

/** Returns the factor by which a reduced chi-square widens a covariance [1]: the chi-square itself where it exceeds 1
 * by more than Significance.hint of its standard deviations, else 1. \a dof are its degrees of freedom. */
inline double
BeyondChance(double reducedChi2, double dof)
{
  return reducedChi2 > 1.0 + Significance.hint * std::sqrt(2.0 / std::max(1.0, dof)) ? reducedChi2 : 1.0;
}

} // namespace sensornoise

#endif
