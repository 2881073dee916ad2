// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_moments_ExposureFit_h
#define sensornoise_moments_ExposureFit_h

#include "SensorNoiseExport.h"
#include "sensornoise/StepResults.h"
#include "moments/Exposures.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace sensornoise
{

struct StackMaps;

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
 * \a levels are in rising order of different exposures; \a codes holds the clip levels. */
SensorNoise_EXPORT ExposureFit
FitExposures(const std::vector<ExposureLevel> & levels, const CodeRange & codes);

/** Fits the levels of a stack with these \a maps, see FindExposureLevels(). Null: no exposures were given. */
SensorNoise_EXPORT std::optional<ExposureFit>
FitExposures(const std::vector<double> &      exposures,
             const FrameThumbnails &          thumbnails,
             const std::vector<std::size_t> & counted,
             const StackMaps &                maps);

} // namespace sensornoise

#endif
