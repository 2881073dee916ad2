// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_scene_Constants_h
#define sensornoise_scene_Constants_h

#include "base/Constants.h"

#include <cstddef>

namespace sensornoise
{

/** The numbers of the component `scene`. Estimator.md, 3.2. */
struct SceneConstants
{
  /** \name Initial noise model */
  ///@{
  /** Least number of pixels to which a model is fitted, in the whole frame or in a part of it. Chosen empirically. */
  std::size_t fewestPixels{ 100 };
  /** Ratio of raw to modelled variance above which the model does not explain a pixel, apart from chance [1]. The first
   * fit excludes pixels of the smoother half, where motion adds little, by the same ratio to the median of their
   * intensity bin. Chosen empirically: weights and masks need the model to some 10 %. */
  double largestRatio{ 2.5 };
  /** That ratio to the median for the rougher half of the pixels, where motion adds much [1]. Chosen empirically. */
  double startRatioRough{ 30.0 };
  /** Ratio of the squared derivatives along both axes from which the variance of a pixel shows the motion along one of
   * them [1]. Chosen empirically. */
  double energyAlongAxis{ 4.0 };
  /** Largest fraction of the squared derivatives of the mean that a model may leave out, and largest fraction of the
   * smoother half of the pixels, from which objects move and not the edges [1]. Chosen empirically: scenes with edges
   * sharper than a pixel leave out 0.3 to 0.75 of the derivatives and up to 0.035 of the smooth pixels, others 0.02 and
   * 0.003. */
  double largestRejectedEnergy{ 0.1 };
  double largestRejectedSmooth{ 0.05 };
  /** Size of a negative variance of motion along one axis, relative to that along the other, that is due to chance [1].
   * Chosen empirically: frames after a gamma curve have 0.8, and negative variances along both axes. */
  double negativeMotion{ 0.05 };
  /** The intercept is at least this fraction of this quantile of the raw variances [1]. Chosen empirically: a fit may
   * become negative. */
  double leastIntercept{ 0.3 };
  double quantileOfIntercept{ 0.001 };
  /** Where the slope of the fit is not positive, it is replaced by this fraction of the ratio of the median variance to
   * the mean signal [1]. Chosen empirically. */
  double fallbackSlope{ 0.1 };
  ///@}

  /** \name Usable pixels */
  ///@{
  /** Distance of a pixel from a clip level, in standard deviations of noise and motion [1]. Chosen empirically: one in
   * 3 10^5 values exceeds it. */
  double guardBandSds{ 4.5 };
  /** Flicker of the brightest and the darkest frame that the guard band allows for in any case, in standard deviations
   * of the flicker [1]. Chosen empirically. */
  double typicalFlickerSds{ 1.5 };
  /** Largest fraction of pixels whose noise is hidden by quantization [1]. Chosen empirically: 8-bit frames have 4 to
   * 10 %. With half, the gain was 5 to 8 % too high for a quantization step of 2.3 standard deviations of the noise of
   * the brightest pixels. */
  double largestCoarseFraction{ 0.2 };
  /** Ratio of the variance of saturated pixels to the variance of pixels a little darker, and how much darker these are
   * at most, as a fraction of the signal [1]. Full wells of 10^4 electrons have 1e-4 to 1e-2. Within that fraction, the
   * variance after a gamma curve falls to 0.55. Wells that differ by 2 % rms begin 6 % below their median. */
  double varianceOfFullWells{ 0.25 };
  double reachOfFullWells{ 0.4 };
  /** Quantile of the variances of the darker pixels that is compared [1]: where objects move, some pixels are quiet.
   * Chosen empirically. */
  double quantileBelowWells{ 0.1 };
  ///@}

  /** \name Moving objects that cross the frame */
  ///@{
  /** Least number of sampled pixels of a cell, or of a line of the border, whose median is used. Chosen empirically. */
  std::size_t fewestPixelsOfMedian{ 8 };
  /** Ratio of medians from which a cell does not fit a model [1]. Chosen empirically: the noise of 60 frames and pixels
   * changes a median by 3 %, and the illumination may change locally. With 1.2 the result for moving objects is the
   * same, but the margin for the illumination is small. With 1.8 more cells that an object crosses faintly are left. */
  double largestMedianRatio{ 1.4 };
  /** Score of the model, see Candidate in TransientRegion.cxx, from which no object is searched [1]. Chosen
   * empirically: static scenes, rolling shutters and vibration give 0.98 to 1, a disk that crosses a quarter of the
   * frame gives 0.75. With 0.7 that disk is left to the later passes. The gain is then the same, from a tenth more
   * pixels, but flicker and offset are wrong under strong vibration. With 0.92 objects that cross a tenth of the frame
   * are excluded here. */
  double enoughScore{ 0.85 };
  /** Cost in the score of a fraction of cells below a model, in units of a fraction that fits [1]. No cell is below a
   * model of the static scene. A model of the object itself may fit two thirds of the frame and exceed the variance of
   * the rest. Chosen empirically: half and twice find the same regions. Without a cost, local changes of the
   * illumination are taken for an object. */
  double penaltyOfBelow{ 2.0 };
  /** Cells above the model are due to the illumination if a separate flicker of every cell explains at least this
   * fraction of them [1]. The relative rms of the flicker must be at most the second number [1]. Chosen empirically:
   * where half of the signal bleaches by 20 % the two numbers are 1.0 and 0.06. For objects on charts and textures they
   * are 0.35 to 0.95 and 0.2 to 0.6. With 0.2 for the second number a faint object is taken for illumination, with 0.05
   * this bleaching is taken for an object. */
  double leastIlluminationFraction{ 0.8 };
  double largestModulation{ 0.1 };
  /** Number of neighbouring pixels that change together up to which a region is noise and no object [1]: the median
   * over its cells. Independent pixels have 1, and chance adds 0.3 in 10 cells of 20 frames. An object has as many as
   * it covers. */
  double mostPixelsTogether{ 2.0 };
  /** Least fraction of pixels outside of the region [1]. If fewer are left, the whole frame moves, and all pixels are
   * left to the later passes. Chosen empirically. */
  double leastStaticFraction{ 0.05 };
  ///@}

  /** \name Masked borders */
  ///@{
  /** Least width and height of a frame [pixels], and largest fraction of its columns or rows in a strip [1]. Chosen
   * empirically: strips of sensors have up to a tenth, and the middle of the frame must be left. */
  std::size_t leastBorderedSide{ 32 };
  double      largestBorder{ 0.25 };
  /** Approximate number of pixels sampled in a column or row. The medians of the samples bound the time. */
  std::size_t pixelsOfBorderLine{ 128 };
  /** Fraction of the pixels beside a strip that must differ from it [1]: parts of a scene may have the same level. */
  double leastBorderFraction{ 0.95 };
  /** Largest median difference between the pixels of the lines after a strip, and largest difference between the last
   * and the first line of the strip. Both are relative to the step at the end of the strip [1]. The image of an edge is
   * blurred more: with a Gaussian of 0.4 pixels, 0.16 of the step falls into the pixel before it. The first was chosen
   * empirically. */
  double largestBorderSlope{ 0.34 };
  double largestBlur{ 0.08 };
  /** Ratio of the standard deviation of the levels beside a strip to the standard deviation in the strip, above which
   * the structure of the scene ends at the strip [1]. Chosen empirically. */
  double leastStructure{ 8.0 };
  /** Quantile of the levels of the scene below which the level of a strip is dark [1]. */
  double darkestOfScene{ 0.02 };
  ///@}
};

SENSORNOISE_CONSTANT SceneConstants InScene;

} // namespace sensornoise

#endif
