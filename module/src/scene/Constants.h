// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_scene_Constants_h
#define sensornoise_scene_Constants_h

#include "base/Constant.h"

#include <cstddef>

namespace sensornoise
{

/** The numbers of the room `scene`. Estimator.md, 3.2. */
struct SceneConstants
{
  /** \name The provisional model */
  ///@{
  /** Pixels to which a model is fitted, of all or of a part of the frame, at least. Set by hand. */
  std::size_t fewestPixels{ 100 };
  /** Ratio of raw to modelled variance above which a pixel is not explained, beside chance [1]. Set by hand: weights
   * and masks need the model to some 10 %. */
  double largestRatio{ 2.5 };
  /** Ratio to the median of its bin from which a pixel is left out of the first fit [1]: of the smoother half, where
   * motion adds little, and of the rougher. Set by hand. */
  double startRatioSmooth{ 2.5 };
  double startRatioRough{ 30.0 };
  /** Part of the darkest levels' variance below which no variance is expected [1]. Set by hand: a fit may go below 0.
   */
  double leastShareOfDarkest{ 0.2 };
  /** The intercept is at least this part of that quantile of the raw variances [1]. Set by hand, for the same reason.
   */
  double leastIntercept{ 0.3 };
  double quantileOfIntercept{ 0.001 };
  /** Where the fit's slope is not positive, that part of the median variance over the mean light takes its place [1].
   * Set by hand. */
  double fallbackSlope{ 0.1 };
  ///@}

  /** \name Which pixels serve */
  ///@{
  /** Standard deviations of noise and motion by which a pixel must stay away from a clip level [1]. Set by hand: beyond
   * it is one of 3 10^5 values. */
  double guardBandSds{ 4.5 };
  /** Standard deviations of the flicker that a frame may have in any case, for the guard band [1]. Set by hand. */
  double typicalFlickerSds{ 1.5 };
  /** Share of the pixels whose noise the codes may hide [1]. Chosen: 8-bit frames have 4 to 10 %; with half, the gain
   * of codes of 2.3 standard deviations of the brightest pixels' noise was 5 to 8 % too high. */
  double largestCoarseShare{ 0.2 };
  ///@}

  /** \name What crosses the frame */
  ///@{
  /** Cells along either axis, at most: a band of a third of the frame is 8 cells wide. Set by hand: with 32 the medians
   * of 32 pixels scatter more, and still cells are lost; with 12 the neighbours of a region are half of such a band. */
  std::size_t mostCells{ 24 };
  /** Width of a cell, at least [pixels], and pixels of the sample without which it tells nothing. Set by hand. */
  std::size_t leastCellWidth{ 8 };
  std::size_t fewestPixelsOfCell{ 8 };
  /** A median that is off by this factor does not fit [1]. Set by hand: the noise of 60 frames and pixels moves it by 3
   * %, and light may differ over the frame. 1.2 gives the same where something crosses, but little room to light; 1.8
   * leaves more cells in which the crossing is faint. */
  double largestMedianRatio{ 1.4 };
  /** Nothing crosses a frame whose model has this score [1], see Candidate in CrossedRegion.cxx. Set by hand: static
   * scenes, rolling shutters and vibration give 0.98 to 1, a disk that crosses a quarter of the frame 0.75. At 0.7 that
   * disk is left to the later passes: the same gain from a tenth more pixels, but at strong vibration flicker and
   * offset are then off. At 0.92 things that cross a tenth of the frame are left out here. */
  double enoughScore{ 0.85 };
  /** What a share of cells below a model counts in units of a share that fits [1]. Below a model of what is still lies
   * nothing; a model of the thing itself may fit two thirds of the frame, and lie above the rest. Set by hand: half and
   * twice find the same regions; without a cost, light that differs over the frame is taken for a thing. */
  double costOfBelow{ 2.0 };
  /** Cells above the model are light if one flicker a cell explains this share of them, and it is at most so large, rms
   * and relative [1]. Set by hand: where half of the light bleaches by 20 % it is 1.0 and 0.06, for things on charts
   * and textures 0.35 to 0.95 and 0.2 to 0.6. With 0.2 for the size a faint thing is taken for a lamp, with 0.05 that
   * bleaching for a thing. */
  double leastLightShare{ 0.8 };
  double largestLight{ 0.1 };
  /** Share of the pixels that must be left [1]. Below, all of the frame moves, and the later passes must see what they
   * can. Set by hand. */
  double leastStill{ 0.05 };
  ///@}

  /** \name Masked borders */
  ///@{
  /** Sides of a frame [pixels], and part of its columns or rows that a strip may take [1]. Chosen empirically: sensors
   * have up to a tenth, and the middle of the frame must be left. */
  std::size_t leastBorderedSide{ 32 };
  double      largestBorder{ 0.25 };
  /** Pixels by which a column or row is judged, about, and at least: the medians of so many bound the time. */
  std::size_t pixelsOfBorderLine{ 128 };
  std::size_t leastPixelsOfBorderLine{ 8 };
  /** Part of the pixels beside a strip that must differ from it [1]: a scene may have its level in places. */
  double leastBorderShare{ 0.95 };
  /** Part of the step at the end of a strip by which pixels of the next lines may differ, as medians [1], and its last
   * line from its first one [1]. The image of an edge is not as sharp: a Gaussian of 0.4 pixels leaves 0.16 in the
   * pixel before. Chosen empirically for the former. */
  double largestBorderSlope{ 0.34 };
  double largestBlur{ 0.08 };
  /** Standard deviation of the levels beside a strip, in units of that in the strip, from which on the structure of the
   * scene ends with the strip [1]. Chosen empirically. */
  double leastStructure{ 8.0 };
  /** Quantile of the levels of the scene below which the strip is without light [1]. */
  double darkestOfScene{ 0.02 };
  ///@}
};

SENSORNOISE_CONSTANT SceneConstants InScene;

} // namespace sensornoise

#endif
