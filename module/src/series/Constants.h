// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_series_Constants_h
#define sensornoise_series_Constants_h

#include "base/Constants.h"

#include <array>
#include <cstddef>

namespace sensornoise
{

/** The numbers of the component `series`. Estimator.md, 3.3 and 3.4. */
struct SeriesConstants
{
  /** \name Equations of the frames */
  ///@{
  /** Quantiles of the roughness that separate the gradient classes [1]. Chosen empirically: the flat classes hold most
   * pixels. */
  std::array<double, 5> classEdges{ { 0.4, 0.6, 0.75, 0.87, 0.95 } };
  /** A derivative is a column only if at least this fraction of its sum of squares is signal, not noise of the mean
   * [1]. Chosen empirically. Half: the same results; twice: no derivative is left, and gains are up to 1.3 % off. */
  double leastSignalFraction{ 0.5 };
  /** Fraction of a column that must remain beside the other columns for it to be identifiable [1]. Chosen empirically:
   * a smaller fraction is within the effect of vignetting on a ramp, and the offset would be ten times as uncertain as
   * from levels. */
  double leastDistinctFraction{ 0.01 };
  /** Number of frames from which derivatives of the third order are tried. Chosen empirically. */
  std::size_t framesForThirdOrder{ 20 };
  ///@}

  /** Contrast below which noise is taken for levels, and resembles flicker [1]. Chosen empirically: natural scenes have
   * 0.99. With 0.5, flat fields with DSNU are accepted; 0.95 requires 100 frames of a flat field with a shading of 3
   * %. */
  double leastContrast{ 0.9 };

  /** \name Frames of another dark offset */
  ///@{
  /** Number of offsets that are tried over the possible range, and the same number twice about the best. Chosen
   * empirically: within 4000 DN the offset is then known to 0.02 DN. */
  int offsetsTried{ 200 };
  /** Ratio of the dispersion of the densest half of the frames to the smallest one, up to which an offset fits equally
   * well [1]. Chosen empirically: chance makes 1.2 for 20 frames. */
  double likelyOffset{ 1.3 };
  /** Least step of the offset, relative to the noise of the darkest pixels [1]. Chosen by the size of the effect: if a
   * fifth of the frames differ by it, the read noise changes by 0.5 %. */
  double leastOffsetStep{ 0.25 };
  /** Least step of the offset, relative to the change of the signal between the darkest pixels and the centre in that
   * frame [1]. A non-linearity of the response of a few per cent makes a smaller step. */
  double leastStepOfChange{ 0.05 };
  ///@}

  /** \name Instruments of the shifts */
  ///@{
  /** Half width of the box that smooths the derivatives twice along each axis [pixels]. The result is a triangle of
   * standard deviation 2.8 pixels, so that the instruments contain only long wavelengths. Chosen empirically. */
  static constexpr std::size_t instrumentRadius{ 3 };
  /** Half width of the box over which the weights fall to 0 where pixels are missing, and half width of the box over
   * which the noise is averaged [pixels]. Chosen empirically. */
  std::size_t missingRadius{ 4 };
  std::size_t noiseRadius{ 8 };
  /** Determinant of the equations of the instruments relative to its diagonal, below which too little of the scene is
   * free of missing pixels [1]. Chosen empirically. */
  double leastDeterminant{ 0.01 };
  ///@}

  /** Illumination of a frame, relative to the mean frame, below which no separate shift is used [1]. Chosen
   * empirically: the shift of this frame is ten times as uncertain as at the mean illumination, and changes the frame
   * by a tenth. */
  double leastIlluminationOfShift{ 0.1 };

  /** \name Local illumination, and the temporal basis */
  ///@{
  /** Fraction of the variance by motion that derivatives do not explain, which is noise of the signal of cells [1].
   * Chosen empirically. */
  double motionLeftInCells{ 0.2 };
  /** Least number of pixels of a cell that is used. Chosen empirically. */
  double fewestPixelsOfCell{ 20.0 };
  /** Relative difference between the noise of frames below which it counts as equal [1]: `edgeOfNoise` allows 25 % for
   * it. Chosen empirically, on simulated changes of illumination. */
  double equalFrameNoise{ 0.1 };
  /** Least variance of a frame relative to the variance at the mean illumination [1]; a guard against division by 0. */
  double leastFrameVariance{ 1e-6 };
  /** The ratio of shot noise to read noise is estimated from this many cells, if there are as many. More cells are used
   * if these have fewer values than the second number in all frames. The numbers bound the time. 60 frames of 175
   * cells determine the ratio to 5 %. */
  std::ptrdiff_t cellsOfShotFraction{ 32 };
  std::ptrdiff_t valuesOfShotFraction{ 16384 };
  /** Range of the powers of 2 that are tried as the ratio of shot variance to read variance in the brightest cell; the
   * least one stands for 0. The largest one is a million electrons and a read noise of one electron. */
  int leastShotPower{ -6 };
  int largestShotPower{ 20 };
  /** Least degrees of freedom that the known series must leave for a search of local illumination. Chosen empirically.
   */
  std::ptrdiff_t leastDofOfCells{ 4 };
  /** Ratio to the edge of the noise, by Marchenko and Pastur, above which an eigenvalue is due to the illumination [1].
   * Chosen empirically. Half: spatially correlated noise is taken for illumination, and gains of smoothed frames are 2
   * % low; twice: the same results. */
  double edgeOfNoise{ 1.25 };
  /** Least dispersion of the size of the flicker over the cells of a frame that counts [1]: the offset may be wrong by
   * this fraction of the range of the signal. */
  double leastUnevenness{ 0.01 };
  /** Standard deviation of the cells of a frame, relative to a typical frame, from which the frame is scaled down [1].
   * It is used in the search for factors that frames have in common. Chosen between 2, for frames of four times the
   * noise variance, and the scatter of frames with local illumination, 0.5 to 1.2 in a real burst. */
  double noisyFrame{ 1.5 };
  /** Largest number of series of local illumination, and number of frames that each needs. Chosen empirically. */
  std::size_t mostLocalSeries{ 12 };
  std::size_t framesPerLocalSeries{ 6 };
  /** Largest number of series of the basis, relative to the number of frames minus two [1]: a short burst leaves out
   * the last series of the motion. Chosen empirically: with 0.4, vibrations of 0.3 pixels bias the gain of 20 frames
   * of texture by 0.15 %. */
  double mostSeriesOfFrames{ 0.6 };
  ///@}
};

SENSORNOISE_CONSTANT SeriesConstants InSeries;

} // namespace sensornoise

#endif
