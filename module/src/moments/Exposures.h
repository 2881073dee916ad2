// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_moments_Exposures_h
#define sensornoise_moments_Exposures_h

#include "SensorNoiseExport.h"
#include "sensornoise/StepResults.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace sensornoise
{

class FrameThumbnails;
struct StackMaps;

/** Throws std::invalid_argument unless all exposures are finite and 0 or more, and at least 3 of them differ. A line
 * passes through any two levels, so that two levels contain no information about linearity. An empty list, no
 * exposures, is allowed. */
SensorNoise_EXPORT void
ValidateExposures(const std::vector<double> & exposures);

/** Throws std::invalid_argument unless there is one exposure for each of the \a frames, or none at all. */
SensorNoise_EXPORT void
RequireExposuresOfFrames(const std::vector<double> & exposures, std::size_t frames);

/** The level of some pixels in all frames of one exposure. */
struct ExposureLevel
{
  double      exposure{ 0.0 };      ///< in the user's unit, 0: a dark frame
  std::size_t frames{ 0 };          ///< different frames of this exposure
  double      meanDn{ 0.0 };        ///< mean over pixels and frames
  double      squaresDn2{ 0.0 };    ///< sum over the frames of (level of the frame - meanDn)^2
  double      pixelNoiseDn2{ 0.0 }; ///< variance of the level of one frame due to the noise of its pixels
  double      patternDn2{ 0.0 };    ///< variance of the mean due to differences between cells, including noise
};

/** Returns the levels of the brightest cells of the frames by exposure, in rising order.
 *
 * The signal of a cell is the rise of its mean from the lowest to the highest exposure, so that it contains no offset.
 * The brightest cells are those near the quantile 0.95 of the signal (MomentsConstants): almost all cells of a flat
 * field, or the brightest places of a scene, where the levels cover the largest range. Cells with a clipped pixel (0
 * in \a valid, of a frame's size) are left out, unless the remaining cells have less than half of the signal. A flat
 * field driven into saturation is clipped everywhere, and its saturated levels are outside of the range of EMVA 1288.
 *
 * The noise of pixels moves each cell independently, the illumination moves all cells together. The scatter over time
 * of the cells about their common motion, divided by their number, is therefore \c pixelNoiseDn2. For an exposure with
 * a single frame it is estimated from the differences of neighbouring pixels, an upper bound.
 *
 * \a counted holds the frames that are counted, \a exposures the exposures of all frames. The result is empty if fewer
 * than two cells are finite. */
SensorNoise_EXPORT std::vector<ExposureLevel>
FindExposureLevels(const FrameThumbnails &           thumbnails,
                   const std::vector<std::size_t> &  counted,
                   const std::vector<double> &       exposures,
                   const std::vector<std::uint8_t> & valid);

/** Returns a mask of the frame: the valid pixels near the largest signal at which whole cells of \a thumbnails are
 * uniform.
 *
 * The mean level of pixels with different signals has a larger curvature than the response at their mean signal. For a
 * quadratic response the factor is 1 + (relative variance of the signals). In textured cells this is 10 %. The signal
 * S is therefore lowered step by step from the brightest cells, until 4 cells hold only pixels with signals from S /
 * 1.25 to 1.25 S. Where S falls below half of the brightest signal, all valid pixels are returned.
 *
 * The signal is the level minus the level at exposure 0, which follows from the mean levels of the cells at the lowest
 * and the highest exposure.
 * \param exposures exposures of all frames
 * \param counted numbers of the frames that are counted */
SensorNoise_EXPORT std::vector<std::uint8_t>
FindEvenPixels(const FrameThumbnails &          thumbnails,
               const std::vector<std::size_t> & counted,
               const std::vector<double> &      exposures,
               const StackMaps &                maps);

/** A number with its standard error. */
struct FittedNumber
{
  double value{ 0.0 };
  double standardError{ 0.0 };
};

/** The line level = offset + responsivity x exposure through the levels of frames of known exposures, and the
 * deviations of the levels from it. */
struct ExposureFit
{
  /** A level, and its relative deviation from the line [1]; null: the level is outside of the range of the fit. */
  struct Level
  {
    double                exposure{ 0.0 }; ///< in the user's unit
    std::size_t           frames{ 0 };     ///< number of different frames
    double                meanDn{ 0.0 };   ///< mean over pixels and frames [DN]
    std::optional<double> deviation;       ///< (level - line) / (line - dark offset) [1]
  };

  /** Square of the linearity error [1], without the contribution of noise, and its standard error. The linearity error
   * of EMVA 1288 is the mean of the absolute relative deviations, as a fraction. Null: not identifiable, see `reason`.
   */
  std::optional<FittedNumber> squaredError;
  double                      dof{ 0.0 }; ///< degrees of freedom of the scatter that its standard error is derived from
  std::string                 reason;     ///< reason why there is no linearity error, as a sentence; "": there is one

  /** Dark offset [DN]: the mean of the frames of exposure 0, else the line at exposure 0, with an error that allows for
   * a curved response. Null: there are too few levels. */
  std::optional<FittedNumber> offsetDn;
  bool                        isOffsetOfDarkFrames{ false };
  std::optional<FittedNumber> responsivity; ///< slope of the line [DN per unit of exposure]

  double      saturationDn{ 0.0 };        ///< level to which the range refers
  std::string saturationSource{ "none" }; ///< "given", "pile-up", "code range", or "largest level": nothing is clipped
  double      illuminationScatter{ 0.0 }; ///< standard deviation of the illumination at equal exposure [1]
  std::vector<Level> levels;              ///< all levels, in the order of the exposures
};

/** Fits the line and measures the linearity error, by EMVA Standard 1288, Release 4.0 Linear, 6.7 (equations 62, 63).
 *
 * Let y be the level minus the dark offset. The line minimises the sum of ((level - line) / y)^2 over the levels with
 * y from 5 % to 95 % of its value at saturation. The deviations are (level - line) / (line - dark offset), and the
 * linearity error is the mean of their absolute values. Without frames of exposure 0 the dark offset is the line's
 * intercept. Where no clip level is known, the largest level is taken for the saturation, and belongs to the range.
 *
 * A level has the noise of its pixels and the scatter of the illumination, which moves levels in proportion to y. The
 * scatter is estimated from frames of equal exposure; where no exposure has two frames, from the deviations from a
 * parabola. Noise makes a mean of absolute values larger. The value is corrected by the mean square that the noise
 * adds. Estimator.md, 3.8, has the derivation.
 *
 * \a levels are in rising order of different exposures; \a dnRange holds the clip levels. */
SensorNoise_EXPORT ExposureFit
FitExposures(const std::vector<ExposureLevel> & levels, const DnRange & dnRange);

/** Fits the levels of a stack with these \a maps, see FindExposureLevels(). Null: no exposures were given. */
SensorNoise_EXPORT std::optional<ExposureFit>
FitExposures(const std::vector<double> &      exposures,
             const FrameThumbnails &          thumbnails,
             const std::vector<std::size_t> & counted,
             const StackMaps &                maps);

} // namespace sensornoise

#endif
