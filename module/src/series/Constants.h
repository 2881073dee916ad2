// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_series_Constants_h
#define sensornoise_series_Constants_h

#include "base/Constant.h"

#include <array>
#include <cstddef>

namespace sensornoise
{

/** The numbers of the room `series`. Estimator.md, 3.3 and 3.4. */
struct SeriesConstants
{
  /** \name Equations of the frames */
  ///@{
  /** Quantiles of the roughness that part the gradient classes [1]. Set by hand: the flat classes hold most pixels. */
  std::array<double, 5> classEdges{ { 0.4, 0.6, 0.75, 0.87, 0.95 } };
  /** Part of a derivative's square sum that must be signal, not noise of the mean, for it to be a column [1]. Set by
   * hand. Half: the same; twice: no derivative is left, and gains are up to 1.3 % off. */
  double leastSignalShare{ 0.5 };
  /** Share of a column that others may leave of it for it to be told from them [1]. Set by hand: what is less is within
   * what vignetting makes of a ramp, and an offset by it would be ten times as uncertain as by levels. */
  double leastOwnShare{ 0.01 };
  /** Frames from which derivatives of the third order are tried. Set by hand. */
  std::size_t framesForThirdOrder{ 20 };
  ///@}

  /** Contrast below which noise is taken for levels, and looks like flicker [1]. Set by hand: natural scenes have 0.99;
   * at 0.5 flats with an offset pattern pass, 0.95 asks 100 frames of a flat field with a shading of 3 %. */
  double leastContrast{ 0.9 };

  /** \name Frames of another dark offset */
  ///@{
  /** Offsets that are tried over the possible ones, and as many twice about the best. Chosen empirically: 4000 DN are
   * then known to 0.02 DN. */
  int offsetsTried{ 200 };
  /** Ratio of the spread of the densest half of the frames to the least, up to which an offset fits as well [1]. Chosen
   * empirically: chance makes 1.2 of it for 20 frames. */
  double likelyOffset{ 1.3 };
  /** Step of the offset, relative to the noise of the darkest pixels [1]. Chosen by the size of the effect: a fifth of
   * the frames that differ by it change the read noise by 0.5 %. */
  double leastOffsetStep{ 0.25 };
  /** The same relative to the change of the signal of the darkest pixels to the centre in that frame [1]: a response
   * that is bent by a few per cent makes less. */
  double leastStepOfChange{ 0.05 };
  ///@}

  /** \name Instruments of the shifts */
  ///@{
  /** Half width of the box that smooths the derivatives twice along each axis [pixels]: a triangle of standard
   * deviation 2.8 pixels, whose instruments see long wavelengths only. Set by hand. */
  static constexpr std::size_t instrumentRadius{ 3 };
  /** Half width of the box over which the weights fall to 0 where pixels are missing, and of that over which the noise
   * is averaged [pixels]. Set by hand. */
  std::size_t missingRadius{ 4 };
  std::size_t noiseRadius{ 8 };
  /** Determinant of the instruments' equations relative to its diagonal, below which too little of the scene is whole
   * [1]. Set by hand. */
  double leastDeterminant{ 0.01 };
  ///@}

  /** Illumination of a frame, relative to that of the mean frame, below which it has no shift of its own [1]. Set by
   * hand: the shift of such a frame is ten times as uncertain as at the mean illumination, and moves the frame by a
   * tenth. */
  double leastIlluminationOfShift{ 0.1 };

  /** \name Local light, and the basis */
  ///@{
  /** Part of the variance by motion that derivatives do not explain, which is noise to the light of cells [1]. Set by
   * hand. */
  double motionLeftInCells{ 0.2 };
  /** Pixels of a cell that tells. Set by hand. */
  double fewestPixelsOfCell{ 20.0 };
  /** Relative difference between the noise of frames below which it counts as equal [1]: the edge below has 25 % for
   * it. Chosen empirically, on simulated changes of illumination. */
  double equalFrameNoise{ 0.1 };
  /** Least variance of a frame relative to that at the mean illumination [1]; a guard against division by 0. */
  double leastFrameVariance{ 1e-6 };
  /** Cells by which the ratio of shot noise to read noise is estimated, where there are as many, and values of theirs
   * in all frames, by which there are more. They bound the time. 60 frames of 175 cells determine the ratio to 5 %. */
  std::ptrdiff_t cellsOfShotFraction{ 32 };
  std::ptrdiff_t valuesOfShotFraction{ 16384 };
  /** Powers of 2 that are tried as the ratio of shot variance to read variance in the brightest cell; the least one
   * stands for 0. The largest one is a million electrons and a read noise of one. */
  int leastShotPower{ -6 };
  int largestShotPower{ 20 };
  /** Frames that the known series must leave free for a search of local light. Set by hand. */
  std::ptrdiff_t leastFreedomOfCells{ 4 };
  /** What a squared singular value must have of the edge of the noise, by Marchenko and Pastur, to be light [1]. Set by
   * hand. Half: noise that neighbours share is taken for light, gains of smoothed frames are 2 % low; twice: the same.
   */
  double edgeOfNoise{ 1.25 };
  /** Standard deviation of a frame's cells over that of a typical frame, from which it is scaled down where light that
   * frames share is looked for [1]. Chosen: between frames of four times the noise variance, 2, and the scatter of
   * frames with light of their own, 0.5 to 1.2 in a real burst. */
  double noisyFrame{ 1.5 };
  /** Series of local light, at most, and frames that each needs. Set by hand. */
  std::size_t mostLocalSeries{ 12 };
  std::size_t framesPerLocalSeries{ 6 };
  /** Series of the basis relative to the frames but two, at most [1]: a short burst leaves out the last of the
   * motion's. Set by hand: with 0.4 vibrations of 0.3 pixels bias the gain of 20 frames of texture by 0.15 %. */
  double mostSeriesOfFrames{ 0.6 };
  ///@}
};

SENSORNOISE_CONSTANT SeriesConstants InSeries;

} // namespace sensornoise

#endif
